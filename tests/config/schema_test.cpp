#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <zlg/config/schema.hpp>

using namespace zlg::config;
using zlg::core::BridgeMethod;
using zlg::core::DitherMethod;
using zlg::core::RelockMethod;
using zlg::twin::FaultKind;

namespace {

// Properties are tried on the same cases in every run.
const int fixed_seed = ::setenv("RC_PARAMS", "seed=1", 0);

Config from_toml(std::string_view text) {
    Config config;
    apply_toml(config, text, "lab.toml");
    return config;
}

Config with(std::initializer_list<std::string_view> settings) {
    Config config;
    for (const auto setting : settings) apply_set(config, setting);
    return config;
}

template <class Action>
std::string complaint(Action action) {
    try {
        action();
    } catch (const ConfigError& error) {
        return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

std::string toml_complaint(std::string_view text) {
    return complaint([&] { static_cast<void>(from_toml(text)); });
}

std::string set_complaint(std::string_view setting) {
    return complaint([&] { static_cast<void>(with({setting})); });
}

std::string check_complaint(std::initializer_list<std::string_view> settings) {
    const Config config = with(settings);
    return complaint([&] { check(config); });
}

void expect_contains(const std::string& text, std::string_view part) {
    EXPECT_NE(text.find(part), std::string::npos) << "in: " << text << "\nmissing: " << part;
}

rc::Gen<double> any_double(double min, double max) {
    return rc::gen::map(rc::gen::inRange<std::int64_t>(0, std::int64_t{1} << 53),
                        [=](std::int64_t k) { return min + (max - min) * std::ldexp(static_cast<double>(k), -53); });
}

// A configuration in which every kind of key differs from its default.
Config any_config() {
    Config c;
    if (*rc::gen::arbitrary<bool>()) c.run.duration_s = *any_double(1.0, 1e9);
    c.run.seed = *rc::gen::inRange<std::int64_t>(0, std::numeric_limits<std::int64_t>::max());
    c.gyro.scale_arcsec = *any_double(1e-6, 1e6);
    c.gyro.bias_hz = *any_double(1.0, 1e12);
    c.gyro.reference_temperature_c = *rc::gen::element(-0.0, 0.0, -999999.9, 5e-324, 0.1, 1e5);
    c.gyro.first_bias_sign = *rc::gen::element<std::int64_t>(-1, 1);
    c.perimeter.loop = *rc::gen::element(Loop::analog, Loop::exponential, Loop::digital);
    c.switching.interval_optimal = *rc::gen::arbitrary<bool>();
    if (!c.switching.interval_optimal) c.switching.interval_s = *any_double(1.0, 1e4);
    if (*rc::gen::arbitrary<bool>())
        c.compensation.relock = *rc::gen::element(RelockMethod::none, RelockMethod::detuning);
    c.motion.amplitude_arcsec_s = *rc::gen::nonEmpty(rc::gen::container<std::vector<double>>(any_double(-1e6, 1e6)));
    c.faults.kind = *rc::gen::container<std::vector<FaultKind>>(
        rc::gen::element(FaultKind::laser_off, FaultKind::frame_late, FaultKind::overspeed));
    c.faults.random_kinds = *rc::gen::container<std::vector<FaultKind>>(
        rc::gen::element(FaultKind::beam_fades, FaultKind::counter_bit_stuck));
    c.motion.comment = *rc::gen::container<std::string>(rc::gen::inRange<char>(1, 127));
    c.motion.column = *rc::gen::element<std::string>("", "1", "12", "gyro z", "a,b");
    c.motion.separator = *rc::gen::element(TextSeparator::automatic, TextSeparator::tab, TextSeparator::comma);
    c.analysis.column =
        *rc::gen::container<std::vector<std::string>>(rc::gen::element<std::string>("3", "gyro_z", "\"x\""));
    c.analysis.time_column = *rc::gen::element<std::string>("", "0", "7", "Zeit [s]");
    c.motion.path = *rc::gen::element<std::string>("", "a b.txt", "\"quoted\"", "back\\slash", "\xCE\xA9.txt", "#");
    return c;
}

std::string text_of(const Config& config, std::string_view dotted_key) {
    for (const auto& [key, value] : to_settings(config)) {
        if (key == dotted_key) return value;
    }
    return "unset";
}

// Keys that take numbers are those whose default is no quoted text.
bool takes_numbers(const KeyInfo& key) { return key.default_text.find_first_of("\"") == std::string::npos; }

}  // namespace

RC_GTEST_PROP(Schema, settings_and_toml_read_back_to_the_same_configuration, ()) {
    const Config config = any_config();
    Config by_pairs;
    for (const auto& [key, value] : to_settings(config)) {
        RC_ASSERT(value.find('\n') == std::string::npos);
        apply_pair(by_pairs, key, value, "raw.csv");
    }
    const Config by_toml = from_toml(to_toml(config));
    for (const Config& read : {by_pairs, by_toml}) {
        RC_ASSERT(to_settings(read) == to_settings(config));
        RC_ASSERT(read.run.duration_s == config.run.duration_s);
        RC_ASSERT(read.run.seed == config.run.seed);
        RC_ASSERT(read.gyro.scale_arcsec == config.gyro.scale_arcsec);
        RC_ASSERT(read.gyro.bias_hz == config.gyro.bias_hz);
        RC_ASSERT(std::bit_cast<std::uint64_t>(read.gyro.reference_temperature_c) ==
                  std::bit_cast<std::uint64_t>(config.gyro.reference_temperature_c));
        RC_ASSERT(read.gyro.first_bias_sign == config.gyro.first_bias_sign);
        RC_ASSERT(read.perimeter.loop == config.perimeter.loop);
        RC_ASSERT(read.switching.interval_optimal == config.switching.interval_optimal);
        RC_ASSERT(read.switching.interval_s == config.switching.interval_s);
        RC_ASSERT(read.compensation.relock == config.compensation.relock);
        RC_ASSERT(read.motion.amplitude_arcsec_s == config.motion.amplitude_arcsec_s);
        RC_ASSERT(read.motion.comment == config.motion.comment);
        RC_ASSERT(read.motion.path == config.motion.path);
        RC_ASSERT(read.motion.column == config.motion.column);
        RC_ASSERT(read.motion.separator == config.motion.separator);
        RC_ASSERT(read.analysis.column == config.analysis.column);
        RC_ASSERT(read.analysis.time_column == config.analysis.time_column);
        RC_ASSERT(read.faults.kind == config.faults.kind);
        RC_ASSERT(read.faults.random_kinds == config.faults.random_kinds);
    }
}

RC_GTEST_PROP(Schema, any_text_is_a_configuration_or_a_one_line_error, ()) {
    std::string text = "[gyro]\ntick_s = 0.005\n[motion]\nkind = \"sum\"\namplitude_arcsec_s = [1, 2.0]\n";
    for (int i = 0; i < 3; ++i) {
        text[*rc::gen::inRange<std::size_t>(0, text.size())] =
            *rc::gen::oneOf(rc::gen::arbitrary<char>(), rc::gen::elementOf(std::string{"[]{}=\"'#\n.,-+e0123456789"}));
    }
    try {
        static_cast<void>(from_toml(text));
    } catch (const ConfigError& error) {
        RC_ASSERT(std::string{error.what()}.starts_with("lab.toml:"));
    }
}

// Guards against a row of the table that names the member of another key.
TEST(Schema, every_key_sets_itself_and_nothing_else) {
    const Settings before = to_settings(Config{});
    for (const KeyInfo& key : describe_keys()) {
        const std::string dotted = key.section + "." + key.name;
        const std::set<std::string> choices{"run.duration_s = 12.5",
                                            "gyro.bias_edge_s = 0.000001",
                                            "gyro.first_bias_sign = -1",
                                            "gyro.dither = auto",
                                            "perimeter.loop = digital",
                                            "switching.first_segment = half",
                                            "switching.last_segment = half",
                                            "switching.schedule = growing",
                                            "compensation.magnetic = estimate",
                                            "compensation.relock = detuning",
                                            "compensation.bridge = linear",
                                            "compensation.prior = flat",
                                            "motion.kind = file",
                                            "motion.column_holds = rate",
                                            "motion.path = a.txt",
                                            "motion.comment = %",
                                            "analysis.total_bias = published",
                                            "motion.separator = tab",
                                            "motion.decimal = comma",
                                            "perimeter.miss_lambda = 0.125",
                                            "perimeter.discriminator_centre_lambda = 0.125",
                                            "piezo.half_wave_error = 0.125",
                                            "piezo.mirror_hz = 125",
                                            "perimeter.sample_gain = 0.5",
                                            "piezo.hysteresis = 0.125",
                                            "piezo.creep_per_decade = 0.01",
                                            "piezo.mirror_damping = 0.5",
                                            "gyro.fidelity = laser",
                                            "laser.round_trip_loss_ratio = 0.25",
                                            "laser.doppler_half_width_hz = 7e6",
                                            "laser.homogeneous_half_width_hz = 7e6",
                                            "laser.upper_isotope_ratio = 0.25",
                                            "laser.opposite_sigma_coupling = 0.25",
                                            "laser.comparator_threshold = 0.125",
                                            "laser.quadrature = x4",
                                            "faults.kind = laser_off",
                                            "faults.random_kinds = shock",
                                            "analysis.deviations = mdev",
                                            "analysis.taus = all",
                                            "analysis.confidence = 0.5",
                                            "analysis.least_known_ratio = 0.5",
                                            "analysis.unit = rad/s",
                                            "analysis.angles = delivered",
                                            "analysis.column_holds = phase",
                                            "analysis.comment = %",
                                            "analysis.separator = semicolon",
                                            "analysis.decimal = point",
                                            "analysis.table_same_rate_ratio = 0.5"};
        std::string setting = dotted + " = 7";
        for (const std::string& choice : choices) {
            if (choice.starts_with(dotted + " ")) setting = choice;
        }
        const Config config = with({setting});
        int n_changed = 0;
        for (const auto& [name, value] : to_settings(config)) {
            const bool was_there = std::ranges::find(before, std::pair{name, value}) != before.end();
            if (was_there) continue;
            ++n_changed;
            EXPECT_EQ(name, dotted);
        }
        EXPECT_EQ(n_changed, 1) << setting;
    }
}

TEST(Schema, knows_every_key_of_the_sections) {
    const std::set<std::string> sections{"run",       "gyro",         "drift",  "perimeter", "piezo",  "motion",
                                         "switching", "compensation", "design", "laser",     "faults", "analysis"};
    std::set<std::string> found;
    std::set<std::string> names;
    for (const KeyInfo& key : describe_keys()) {
        found.insert(key.section);
        EXPECT_TRUE(names.insert(key.section + "." + key.name).second) << key.name;
        EXPECT_FALSE(key.meaning.empty()) << key.name;
        EXPECT_FALSE(key.allowed.empty()) << key.name;
    }
    EXPECT_EQ(found, sections);
    // The members of the twelve structs, interval_optimal apart: 2 + 15 + 15 + 5 + 12 + 15 + 10 + 17 + 15 + 8 + 2 + 24.
    EXPECT_EQ(names.size(), 140u);
    EXPECT_TRUE(is_known_section("gyro"));
    EXPECT_FALSE(is_known_section("gyr"));
}

TEST(Schema, reads_each_kind_of_value) {
    const Config c = from_toml(
        "[run]\nduration_s = 600\nseed = 9223372036854775807\n[gyro]\ntick_s = 1\nbias_hz = 6e4\nfirst_bias_sign = -1\n"
        "[perimeter]\nloop = \"digital\"\n[switching]\ninterval_s = \"optimal\"\nfirst_segment = \"half\"\n"
        "[compensation]\nrelock = \"frequency\"\nbridge = \"constant\"\n"
        "[motion]\nkind = \"sum\"\namplitude_arcsec_s = [1, 2.5]\nfrequency_hz = 3\npath = \"a.txt\"\n"
        "column_holds = \"rate\"\n");
    EXPECT_EQ(c.run.duration_s, 600.0);
    EXPECT_EQ(c.run.seed, std::numeric_limits<std::int64_t>::max());
    EXPECT_EQ(c.gyro.tick_s, 1.0);
    EXPECT_EQ(c.gyro.bias_hz, 60000.0);
    EXPECT_EQ(c.gyro.first_bias_sign, -1);
    EXPECT_EQ(c.perimeter.loop, Loop::digital);
    EXPECT_TRUE(c.switching.interval_optimal);
    EXPECT_EQ(c.switching.first_segment, FirstSegment::half);
    EXPECT_EQ(c.compensation.relock, RelockMethod::frequency);
    EXPECT_EQ(c.compensation.bridge, BridgeMethod::constant);
    EXPECT_EQ(c.motion.kind, MotionKind::sum);
    EXPECT_EQ(c.motion.amplitude_arcsec_s, (std::vector<double>{1.0, 2.5}));
    EXPECT_EQ(c.motion.frequency_hz, std::vector<double>{3.0});
    EXPECT_EQ(c.motion.path, "a.txt");
    EXPECT_EQ(c.motion.column_holds, ColumnHolds::rate);
}

TEST(Schema, a_layer_changes_only_the_keys_it_names) {
    Config c = from_toml("[gyro]\ntick_s = 0.01\nbias_chi = 2\n");
    apply_toml(c, "[gyro]\ntick_s = 0.02\n", "second.toml");
    EXPECT_EQ(c.gyro.tick_s, 0.02);
    EXPECT_EQ(c.gyro.bias_chi, 2.0);
    EXPECT_EQ(c.gyro.scale_arcsec, Config{}.gyro.scale_arcsec);
}

TEST(Schema, a_layer_with_an_error_changes_nothing) {
    Config c;
    EXPECT_THROW(apply_toml(c, "[gyro]\nbias_chi = 2\ntick_s = -1\n", "lab.toml"), ConfigError);
    EXPECT_EQ(to_settings(c), to_settings(Config{}));
}

TEST(Schema, a_number_after_optimal_is_a_number_again) {
    Config c = with({"switching.interval_s=optimal", "switching.interval_s=30"});
    EXPECT_FALSE(c.switching.interval_optimal);
    EXPECT_EQ(c.switching.interval_s, 30.0);
}

TEST(Schema, every_name_of_an_enumeration_is_its_enumerator) {
    EXPECT_EQ(with({"perimeter.loop=analog"}).perimeter.loop, Loop::analog);
    EXPECT_EQ(with({"perimeter.loop=exponential"}).perimeter.loop, Loop::exponential);
    EXPECT_EQ(with({"switching.first_segment=full"}).switching.first_segment, FirstSegment::full);
    EXPECT_EQ(with({"compensation.relock=none"}).compensation.relock, RelockMethod::none);
    EXPECT_EQ(with({"compensation.relock=detuning"}).compensation.relock, RelockMethod::detuning);
    EXPECT_EQ(with({"compensation.relock=mean_square"}).compensation.relock, RelockMethod::mean_square);
    EXPECT_EQ(with({"compensation.bridge=none"}).compensation.bridge, BridgeMethod::none);
    EXPECT_EQ(with({"compensation.bridge=linear"}).compensation.bridge, BridgeMethod::linear);
    EXPECT_EQ(with({"compensation.bridge=quadratic"}).compensation.bridge, BridgeMethod::quadratic);
    EXPECT_EQ(with({"gyro.dither=none"}).gyro.dither, DitherMethod::none);
    EXPECT_EQ(with({"gyro.dither=auto"}).gyro.dither, DitherMethod::automatic);
    EXPECT_EQ(with({"gyro.dither=paired"}).gyro.dither, DitherMethod::paired);
    EXPECT_EQ(with({"gyro.dither=random"}).gyro.dither, DitherMethod::random);
    EXPECT_EQ(with({"motion.kind=rest"}).motion.kind, MotionKind::rest);
    EXPECT_EQ(with({"motion.kind=constant"}).motion.kind, MotionKind::constant);
    EXPECT_EQ(with({"motion.kind=sine"}).motion.kind, MotionKind::sine);
    EXPECT_EQ(with({"motion.kind=file"}).motion.kind, MotionKind::file);
    EXPECT_EQ(with({"motion.column_holds=increment"}).motion.column_holds, ColumnHolds::increment);
    EXPECT_EQ(set_complaint("motion.kind=spin"),
              "--set: motion.kind = 'spin': allowed is \"rest\", \"constant\", \"sine\", \"sum\", \"file\"");
}

TEST(Schema, a_set_value_is_toml_or_a_string) {
    EXPECT_EQ(with({"motion.path=data/a file.txt"}).motion.path, "data/a file.txt");
    EXPECT_EQ(with({"motion.path=\"a.txt\""}).motion.path, "a.txt");
    EXPECT_EQ(with({"motion.path=a=b"}).motion.path, "a=b");
    EXPECT_EQ(with({"motion.path="}).motion.path, "");
    EXPECT_EQ(with({"motion.comment=#"}).motion.comment, "#");
    EXPECT_EQ(with({" gyro.tick_s = 1e-3 "}).gyro.tick_s, 0.001);
    EXPECT_EQ(with({"motion.phase_deg=[1, 2]"}).motion.phase_deg, (std::vector<double>{1.0, 2.0}));
    EXPECT_EQ(with({"motion.path=1\ngyro.tick_s = 2"}).motion.path, "1\ngyro.tick_s = 2");
}

TEST(Schema, an_unknown_key_is_told_the_nearest_known_one) {
    EXPECT_EQ(toml_complaint("[switching]\ngap_ticks = 3\nintervall_s = 90\n"),
              "lab.toml:3: unknown key [switching] intervall_s; did you mean interval_s?");
    EXPECT_EQ(toml_complaint("[drift]\ntick_s = 1\n"),
              "lab.toml:2: unknown key [drift] tick_s; did you mean [gyro] tick_s?");
    // Both [gyro] and [motion] have a scale_arcsec; the one of the same section is meant.
    EXPECT_EQ(set_complaint("motion.scale_arcsecs=1"),
              "--set: unknown key [motion] scale_arcsecs; did you mean scale_arcsec?");
    EXPECT_EQ(toml_complaint("[swiching]\n"), "lab.toml:1: unknown section [swiching]; did you mean [switching]?");
    EXPECT_EQ(toml_complaint("tick_s = 1\n"), "lab.toml:1: tick_s stands in no section; did you mean [gyro] tick_s?");
    EXPECT_EQ(set_complaint("gyro.tick=1"), "--set: unknown key [gyro] tick; did you mean tick_s?");
    EXPECT_EQ(set_complaint("giro.tick_s=1"), "--set: unknown section [giro]; did you mean [gyro]?");
    expect_contains(set_complaint("tick_s=1"), "did you mean [gyro] tick_s?");
    expect_contains(set_complaint("gyro.tick_s"), "an equals sign is missing");
    expect_contains(toml_complaint("gyro = 1\n"), "gyro is a section");
    expect_contains(toml_complaint("[[gyro]]\ntick_s = 1\n"), "gyro is a section");
    expect_contains(toml_complaint("[gyro.tick_s]\nx = 1\n"), "a number is wanted, this is a table");
}

TEST(Schema, a_syntax_error_is_told_with_line_and_column) {
    expect_contains(toml_complaint("[gyro]\ntick_s = = 1\n"), "lab.toml:2:10: ");
    expect_contains(toml_complaint("[gyro]\ntick_s = 1\ntick_s = 2\n"), "lab.toml:3:");
    expect_contains(toml_complaint("[gyro\n"), "lab.toml:1:");
}

TEST(Schema, a_wrong_type_is_told_with_the_wanted_one) {
    EXPECT_EQ(toml_complaint("[switching]\ngap_ticks = 3.0\n"),
              "lab.toml:2: switching.gap_ticks = 3.0: an integer is wanted, this is a real number; allowed is 1..16");
    expect_contains(set_complaint("gyro.tick_s=true"), "gyro.tick_s = true: a number is wanted, this is a boolean");
    expect_contains(set_complaint("gyro.tick_s=fast"), "a number is wanted, this is a string");
    expect_contains(set_complaint("gyro.tick_s=[1]"), "a number is wanted, this is an array");
    expect_contains(set_complaint("run.seed=true"), "an integer is wanted, this is a boolean");
    expect_contains(set_complaint("motion.path=7"), "a string is wanted, this is an integer");
    expect_contains(set_complaint("motion.kind=7"), "a string is wanted, this is an integer");
    expect_contains(set_complaint("motion.path=2024-01-01"), "this is a date or time");
    expect_contains(set_complaint("motion.phase_deg=[1, \"b\"]"), "a number is wanted, this is a string");
    expect_contains(set_complaint("switching.interval_s=best"), "or \"optimal\"");
}

TEST(Schema, a_value_out_of_range_is_told_what_is_allowed) {
    EXPECT_EQ(set_complaint("switching.gap_ticks=99"), "--set: switching.gap_ticks = 99: allowed is 1..16");
    EXPECT_EQ(toml_complaint("[gyro]\n\ntick_s = 0\n"), "lab.toml:3: gyro.tick_s = 0: allowed is 1e-6..10");
    EXPECT_EQ(set_complaint("perimeter.miss_lambda=0.24"),
              "--set: perimeter.miss_lambda = 0.24: allowed is from 0 to below 0.24");
    EXPECT_EQ(set_complaint("gyro.bias_hz=0"), "--set: gyro.bias_hz = 0: allowed is above 0 up to 1e12");
    EXPECT_EQ(set_complaint("motion.scale_arcsec=0"),
              "--set: motion.scale_arcsec = 0: allowed is any finite number but 0");
    EXPECT_EQ(set_complaint("gyro.first_bias_sign=0"), "--set: gyro.first_bias_sign = 0: allowed is -1 or 1");
    EXPECT_EQ(set_complaint("run.seed=-1"), "--set: run.seed = -1: allowed is 0..9223372036854775807");
    EXPECT_NE(set_complaint("run.seed=18446744073709551615").find("allowed is 0..9223372036854775807"),
              std::string::npos);
    expect_contains(set_complaint("motion.frequency_hz=[1, -1]"),
                    "motion.frequency_hz = [1, -1]: allowed is one number");
    expect_contains(set_complaint("design.run_lengths_s=[]"),
                    "design.run_lengths_s = []: allowed is one number or an array");
}

// The edges belong to the range or not as the texts above say.
TEST(Schema, the_ends_of_the_ranges_are_good) {
    for (const std::string_view good : {"gyro.tick_s=1e-6",
                                        "gyro.tick_s=10",
                                        "gyro.scale_arcsec=1e-6",
                                        "gyro.scale_arcsec=1e6",
                                        "gyro.bias_hz=1e12",
                                        "gyro.bias_chi=0",
                                        "gyro.light_samples=1",
                                        "gyro.light_samples=64",
                                        "switching.gap_ticks=1",
                                        "switching.gap_ticks=16",
                                        "compensation.relock_ticks=0",
                                        "compensation.relock_ticks=1000000",
                                        "compensation.points_before=8",
                                        "compensation.points_after=1",
                                        "run.seed=0",
                                        "run.duration_s=1e9",
                                        "perimeter.miss_lambda=0",
                                        "piezo.half_wave_error=-0.9",
                                        "piezo.dac_bits=24",
                                        "motion.column=1",
                                        "drift.magnetic_arcsec_s=-1e300",
                                        "motion.skip_lines=0",
                                        "motion.frequency_hz=0"}) {
        EXPECT_NO_THROW(with({good})) << good;
    }
}

TEST(Schema, beyond_the_ends_of_the_ranges_is_bad) {
    for (const std::string_view bad : {"gyro.tick_s=0.9e-6",
                                       "gyro.tick_s=10.1",
                                       "gyro.scale_arcsec=0.9e-6",
                                       "gyro.scale_arcsec=1.1e6",
                                       "gyro.bias_hz=1.1e12",
                                       "gyro.bias_chi=-0.1",
                                       "gyro.light_samples=0",
                                       "gyro.light_samples=65",
                                       "switching.gap_ticks=0",
                                       "switching.gap_ticks=17",
                                       "compensation.relock_ticks=-1",
                                       "compensation.relock_ticks=1000001",
                                       "compensation.points_before=9",
                                       "compensation.points_after=0",
                                       "compensation.extrapolation_points=0",
                                       "run.duration_s=0",
                                       "run.duration_s=1.1e9",
                                       "perimeter.tau_s=0",
                                       "perimeter.limit_lambda=0",
                                       "piezo.half_wave_v=0",
                                       "piezo.half_wave_error=0.91",
                                       "piezo.dac_bits=25",
                                       "piezo.adc_bits=0",
                                       "drift.thermal_time_s=0",
                                       "drift.random_walk_arcsec_sqrt_s=-1",
                                       "motion.column=0",
                                       "motion.skip_lines=-1",
                                       "motion.rate_hz=0",
                                       "switching.interval_s=0",
                                       "gyro.bias_edge_s=-1"}) {
        EXPECT_THROW(with({bad}), ConfigError) << bad;
    }
}

TEST(Schema, no_key_takes_nan_or_infinity) {
    for (const KeyInfo& key : describe_keys()) {
        if (!takes_numbers(key)) continue;
        for (const std::string value : {"nan", "inf", "-inf"}) {
            EXPECT_THROW(with({key.section + "." + key.name + "=" + value}), ConfigError) << key.name;
        }
    }
    Config c;
    c.gyro.bias_chi = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(complaint([&] { check(c); }), "gyro.bias_chi = nan: allowed is from 0");
}

TEST(Schema, kinds_and_choices_are_those_of_the_members) {
    std::map<std::string, const KeyInfo> known;
    for (const KeyInfo& key : describe_keys()) known.emplace(key.section + "." + key.name, key);
    using enum ValueKind;
    EXPECT_EQ(known.at("gyro.tick_s").kind, real);
    EXPECT_EQ(known.at("run.duration_s").kind, optional_real);
    EXPECT_EQ(known.at("run.seed").kind, integer);
    EXPECT_EQ(known.at("gyro.first_bias_sign").kind, integer);
    EXPECT_EQ(known.at("motion.path").kind, text);
    EXPECT_EQ(known.at("motion.frequency_hz").kind, reals);
    EXPECT_EQ(known.at("switching.interval_s").kind, interval);
    EXPECT_EQ(known.at("motion.kind").kind, choice);
    EXPECT_EQ(known.at("motion.kind").choices, (std::vector<std::string>{"rest", "constant", "sine", "sum", "file"}));
    EXPECT_EQ(known.at("compensation.relock").kind, optional_choice);
    EXPECT_EQ(known.at("faults.kind").kind, choices);
    EXPECT_EQ(known.at("faults.kind").choices.size(), zlg::twin::n_fault_kinds);
    EXPECT_TRUE(known.at("gyro.tick_s").choices.empty());
}

TEST(Schema, a_bridge_needs_one_point_more_than_its_order) {
    EXPECT_EQ(check_complaint({"compensation.bridge=quadratic", "compensation.extrapolation_points=2"}),
              "compensation.bridge = \"quadratic\": a bridge of order 2 needs 3 points, but "
              "compensation.extrapolation_points is 2");
    // Where nothing is known of the motion yet, "auto" is quadratic too.
    expect_contains(check_complaint({"compensation.bridge=auto", "compensation.extrapolation_points=2"}),
                    "compensation.bridge = \"auto\": a bridge of order 2 needs 3 points");
    expect_contains(check_complaint({"compensation.points_before=1", "compensation.points_after=1"}),
                    "order 2 needs 3 points, but compensation.points_before + points_after is 2");
    expect_contains(check_complaint({"compensation.bridge=linear", "compensation.extrapolation_points=1"}),
                    "needs 2 points");
    EXPECT_NO_THROW(check(with({"compensation.bridge=linear", "compensation.extrapolation_points=2"})));
    EXPECT_NO_THROW(check(with({"compensation.bridge=constant", "compensation.extrapolation_points=1",
                                "compensation.points_before=1", "compensation.points_after=1"})));
    EXPECT_NO_THROW(check(with({"compensation.points_before=1"})));
}

TEST(Schema, the_table_says_what_is_allowed_of_a_number_of_either_sign_and_of_zero_or_more) {
    Config c;
    for (const char* good : {"1e-6", "-1e-6", "1e6", "-1e6", "0.3"})
        EXPECT_NO_THROW(apply_pair(c, "gyro.discriminator_per_lambda", good, "test")) << good;
    for (const char* bad : {"0", "9e-7", "-9e-7", "1.1e6", "-1.1e6"})
        expect_contains(complaint([&] { apply_pair(c, "gyro.discriminator_per_lambda", bad, "test"); }),
                        "allowed is 1e-6..1e6 or -1e6..-1e-6");
    for (const char* good : {"0", "-0.0", "100", "1e6"})
        EXPECT_NO_THROW(apply_pair(c, "piezo.mirror_hz", good, "test")) << good;
    for (const char* bad : {"1e-300", "99.9", "-1", "1.1e6"})
        expect_contains(complaint([&] { apply_pair(c, "piezo.mirror_hz", bad, "test"); }), "allowed is 0 or 100..1e6");
}

TEST(Schema, a_section_is_misspelt_by_a_letter_or_its_case) {
    EXPECT_EQ(misspelt_section("Gyro"), "gyro");
    EXPECT_EQ(misspelt_section("gyr"), "gyro");
    EXPECT_EQ(misspelt_section("gyrro"), "gyro");
    EXPECT_EQ(misspelt_section("gyro"), std::nullopt);
    EXPECT_EQ(misspelt_section("lab"), std::nullopt);
    EXPECT_EQ(misspelt_section(std::string(1 << 20, 'g')), std::nullopt);
}

TEST(Schema, a_motion_has_as_many_frequencies_and_phases_as_amplitudes) {
    expect_contains(check_complaint({"motion.kind=sum", "motion.amplitude_arcsec_s=[1, 2, 3]"}),
                    "motion.amplitude_arcsec_s: 3 numbers, motion.frequency_hz: 1, motion.phase_deg: 1");
    EXPECT_NO_THROW(check(with({"motion.kind=sum", "motion.amplitude_arcsec_s=[1, 2]", "motion.frequency_hz=[1, 2]"})))
        << "one phase serves all";
    EXPECT_THROW(check(with({"motion.kind=sum", "motion.amplitude_arcsec_s=[1, 2, 3]", "motion.frequency_hz=[1, 2, 3]",
                             "motion.phase_deg=[0, 90]"})),
                 ConfigError);
    EXPECT_NO_THROW(check(with({"motion.kind=sum", "motion.amplitude_arcsec_s=[1, 2]", "motion.frequency_hz=[1, 2]",
                                "motion.phase_deg=[0, 90]"})));
    expect_contains(
        check_complaint({"motion.amplitude_arcsec_s=[1, 2]", "motion.frequency_hz=[1, 2]", "motion.phase_deg=[0, 90]"}),
        "motion.kind = \"sine\" has one");
    EXPECT_NO_THROW(check(with({"motion.kind=rest", "motion.amplitude_arcsec_s=[1, 2]"})));
}

TEST(Schema, a_motion_file_needs_a_path) {
    expect_contains(check_complaint({"motion.kind=file"}), "motion.path");
    EXPECT_NO_THROW(check(with({"motion.kind=file", "motion.path=a.txt"})));
}

TEST(Schema, an_interval_holds_its_gap_and_two_ticks_more) {
    expect_contains(check_complaint({"gyro.tick_s=1", "switching.interval_s=4.5"}), "gap_ticks + 2 = 5 ticks");
    EXPECT_NO_THROW(check(with({"gyro.tick_s=1", "switching.interval_s=5"})));
    EXPECT_NO_THROW(check(with({"gyro.tick_s=10", "switching.gap_ticks=16", "switching.interval_s=optimal"})));
}

TEST(Schema, a_reversal_ends_within_its_half) {
    expect_contains(check_complaint({"gyro.bias_edge_s=0.0025"}), "below half of gyro.tick_s = 0.005");
    EXPECT_NO_THROW(check(with({"gyro.bias_edge_s=0.0024"})));
    EXPECT_NO_THROW(check_compensation(with({"gyro.tick_s=1e-6"}))) << "no matter of a recorded log";
}

TEST(Schema, the_piezo_range_is_not_empty) {
    expect_contains(check_complaint({"piezo.range_min_v=300"}), "below piezo.range_max_v = 300");
}

TEST(Schema, a_log_gives_the_settings_of_our_sections_only) {
    Config c;
    apply_log(
        c,
        {{"gyro.tick_s", "0.01"}, {"flags", "switching:1"}, {"lab.operator", "Ann"}, {"compensation.bridge", "linear"}},
        "raw.csv");
    EXPECT_EQ(c.gyro.tick_s, 0.01);
    EXPECT_EQ(c.compensation.bridge, BridgeMethod::linear);
    EXPECT_EQ(complaint([&] {
                  apply_log(c, {{"gyro.tik_s", "1"}}, "raw.csv");
              }),
              "raw.csv: unknown key [gyro] tik_s; did you mean tick_s?");
}

TEST(Schema, only_tick_and_scale_conflict_with_a_log) {
    const Settings log{{"gyro.tick_s", "0.01"}, {"gyro.scale_arcsec", "2"}, {"gyro.bias_hz", "5e4"}};
    Config c;
    apply_log(c, log, "raw.csv");
    EXPECT_NO_THROW(check_against_log(c, log, "raw.csv"));
    apply_set(c, "gyro.bias_hz=7e4");
    apply_set(c, "gyro.tick_s=1e-2");
    EXPECT_NO_THROW(check_against_log(c, log, "raw.csv"));
    Config other_tick = c;
    apply_set(other_tick, "gyro.tick_s=0.005");
    expect_contains(complaint([&] { check_against_log(other_tick, log, "raw.csv"); }),
                    "gyro.tick_s = 0.005: raw.csv was recorded with 0.01");
    Config other_scale = c;
    apply_set(other_scale, "gyro.scale_arcsec=3");
    expect_contains(complaint([&] { check_against_log(other_scale, log, "raw.csv"); }), "gyro.scale_arcsec = 3");
    EXPECT_NO_THROW(check_against_log(other_scale, {}, "raw.csv")) << "a log without settings conflicts with nothing";
}

TEST(Schema, a_file_is_read_or_its_failure_told) {
    const auto path =
        std::filesystem::temp_directory_path() / ("zlg-schema-test-" + std::to_string(::getpid()) + ".toml");
    std::ofstream{path} << "[gyro]\ntick_s = 0.01\n";
    Config c;
    apply_file(c, path);
    EXPECT_EQ(c.gyro.tick_s, 0.01);
    std::ofstream{path} << "[gyro]\ntick_s = -1\n";
    expect_contains(complaint([&] { apply_file(c, path); }), path.string() + ":2: gyro.tick_s = -1");
    std::ofstream{path} << "";
    EXPECT_NO_THROW(apply_file(c, path));
    std::filesystem::remove(path);
    expect_contains(complaint([&] { apply_file(c, path); }), "No such file");
    expect_contains(complaint([&] { apply_file(c, path.parent_path()); }), "it is a folder");
}

TEST(Schema, settings_are_short_and_omit_what_is_unset) {
    const Config defaults;
    EXPECT_EQ(text_of(defaults, "run.duration_s"), "unset");
    EXPECT_EQ(text_of(defaults, "compensation.relock"), "unset");
    EXPECT_EQ(text_of(defaults, "gyro.tick_s"), "0.005");
    EXPECT_EQ(text_of(defaults, "gyro.bias_hz"), "60000");
    EXPECT_EQ(text_of(defaults, "motion.kind"), "\"sine\"");
    EXPECT_EQ(text_of(defaults, "motion.amplitude_arcsec_s"), "12000");
    EXPECT_EQ(text_of(defaults, "design.run_lengths_s"), "[600, 900, 3600, 36000]");
    EXPECT_EQ(text_of(with({"switching.interval_s=optimal"}), "switching.interval_s"), "\"optimal\"");
}

TEST(Schema, the_reference_documents_every_key_with_its_default) {
    const std::string text = reference_markdown();
    for (const KeyInfo& key : describe_keys()) expect_contains(text, "| `" + key.name + "` |");
    expect_contains(text, "## [gyro]");
    expect_contains(text, "| `tick_s` | s | `0.005` | 1e-6..10 | length of a tick");
    expect_contains(text, "| `duration_s` | s | unset | above 0 up to 1e9 |");
}

TEST(Schema, a_discriminator_is_as_many_detunings_as_signals_and_both_grow) {
    const Config c =
        from_toml("[perimeter]\ndiscriminator_detuning_lambda = [0.1, 0.2]\ndiscriminator_signal = [0.04, 0.13]\n");
    EXPECT_NO_THROW(check(c));
    EXPECT_EQ(c.perimeter.discriminator_signal, (std::vector<double>{0.04, 0.13}));
    Config again;
    apply_toml(again, to_toml(c), "again.toml");
    EXPECT_EQ(to_settings(again), to_settings(c));

    EXPECT_NO_THROW(check(with({"perimeter.discriminator_signal=[]"})));
    expect_contains(check_complaint({"perimeter.discriminator_signal=[0.1, 0.2]"}),
                    "perimeter.discriminator_detuning_lambda: 0 numbers, perimeter.discriminator_signal: 2");
    expect_contains(check_complaint({"perimeter.discriminator_detuning_lambda=[0.1, 0.1]",
                                     "perimeter.discriminator_signal=[0.1, 0.2]"}),
                    "perimeter.discriminator_detuning_lambda: 0.1 after 0.1; allowed is growth");
    expect_contains(check_complaint({"perimeter.discriminator_detuning_lambda=[0.1, 0.2]",
                                     "perimeter.discriminator_signal=[0.2, 0.1]"}),
                    "perimeter.discriminator_signal: 0.1 after 0.2");
    expect_contains(set_complaint("perimeter.discriminator_signal=[0.1, 2000]"), "[] included, each -1000..1000");
    expect_contains(
        check_complaint(
            {"perimeter.discriminator_detuning_lambda=[0, 0.2]", "perimeter.discriminator_signal=[0.1, 0.2]"}),
        "discriminator_signal is 0.1 at discriminator_detuning_lambda 0; allowed is the same sign, and not 0");
    std::string many = "[1";
    for (int k = 2; k <= 32; ++k) many += ", " + std::to_string(k);
    const std::string detunings = "perimeter.discriminator_detuning_lambda=" + many + "]";
    const std::string signals = "perimeter.discriminator_signal=" + many + "]";
    expect_contains(check_complaint({detunings, signals}), "31 at most");
}

TEST(Schema, a_discriminator_may_have_two_sides) {
    EXPECT_NO_THROW(check(with({"perimeter.discriminator_detuning_lambda=[-0.2, -0.1, 0.1]",
                                "perimeter.discriminator_signal=[-0.3, -0.1, 0.2]"})));
    expect_contains(check_complaint({"perimeter.discriminator_detuning_lambda=[-0.2, 0.1]",
                                     "perimeter.discriminator_signal=[0.1, 0.2]"}),
                    "discriminator_signal is 0.1 at discriminator_detuning_lambda -0.2; allowed is the same sign");
    expect_contains(check_complaint({"perimeter.discriminator_detuning_lambda=[-0.2, -0.1]",
                                     "perimeter.discriminator_signal=[-0.2, -0.1]"}),
                    "2 points below 0 and none above");
    expect_contains(set_complaint("perimeter.discriminator_centre_lambda=0.3"), "-0.2..0.2");
}

TEST(Schema, an_unset_list_is_not_written) {
    for (const auto& [key, value] : to_settings(Config{})) EXPECT_EQ(key.find("discriminator_s"), std::string::npos);
}

TEST(Schema, faults_are_lists_of_equal_length) {
    const Config c = from_toml(
        "[faults]\nkind = [\"laser_off\", \"frame_late\"]\nat_s = [1, 2.5]\nduration_s = [0.1, 0]\nsize = [0, 0]\n");
    EXPECT_NO_THROW(check(c));
    EXPECT_EQ(c.faults.kind, (std::vector<FaultKind>{FaultKind::laser_off, FaultKind::frame_late}));
    EXPECT_EQ(c.faults.at_s, (std::vector<double>{1.0, 2.5}));
    EXPECT_NO_THROW(check(with({"faults.kind=shock", "faults.at_s=1", "faults.duration_s=0.011", "faults.size=-0.2"})));
    expect_contains(check_complaint({"faults.kind=[\"shock\", \"shock\"]", "faults.at_s=1"}),
                    "faults.kind: 2, faults.at_s: 1, faults.duration_s: 0, faults.size: 0; allowed is as many of each");
    expect_contains(set_complaint("faults.kind=[\"shock\", \"quake\"]"), "faults.kind = 'quake': allowed is one or an");
    expect_contains(set_complaint("faults.kind=[1]"), "a string is wanted, this is an integer");
    expect_contains(set_complaint("faults.at_s=[1, -1]"), "faults.at_s = [1, -1]: allowed is");
    expect_contains(set_complaint("faults.random_per_hour=-1"), "allowed is 0..1e6");
    EXPECT_EQ(with({"faults.kind=[]"}).faults.kind.size(), 0u);
}

TEST(Schema, edges_are_shifted_only_in_a_gyro_that_obeys) {
    expect_contains(check_complaint({"gyro.dither=auto"}), "gyro.dither = \"auto\": the averaged gyro");
    EXPECT_NO_THROW(check(with({"gyro.dither=auto", "gyro.fidelity=laser"})));
    // A log of a real gyro says nothing of fidelity.
    EXPECT_NO_THROW(check_compensation(with({"gyro.dither=auto"})));
}
