// A configuration as settings and as TOML: what is written reads back to the same.
#include "schema_support.hpp"

#include <rapidcheck/gtest.h>
#include <stdlib.h>

namespace zlg::config::schema_text_of_settings_test {

using core::RelockMethod;
using twin::FaultKind;

// Properties are tried on the same cases in every run.
const int fixed_seed = ::setenv("RC_PARAMS", "seed=1", 0);

rc::Gen<double> any_double(double min, double max) {
    return rc::gen::map(rc::gen::inRange<std::int64_t>(0, std::int64_t{1} << 53),
                        [=](std::int64_t k) { return min + (max - min) * std::ldexp(static_cast<double>(k), -53); });
}

// A configuration in which every kind of key differs from its default.
Config any_config() {
    Config c;
    if (*rc::gen::arbitrary<bool>()) c.run.duration_s = *any_double(1.0, 1e9);
    c.run.seed = *rc::gen::inRange<std::uint64_t>(0, std::uint64_t{1} << 63);
    c.gyro.scale_arcsec = *any_double(1e-6, 1e6);
    c.gyro.bias_hz = *any_double(1.0, 1e12);
    c.gyro.reference_temperature_c = *rc::gen::element(-0.0, 0.0, -999999.9, 5e-324, 0.1, 1e5);
    c.gyro.first_bias_sign = *rc::gen::element(-1, 1);
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
    c.motion.time_column = *rc::gen::element<std::string>("", "0", "7", "Zeit [s]");
    c.motion.path = *rc::gen::element<std::string>("", "a b.txt", "\"quoted\"", "back\\slash", "\xCE\xA9.txt", "#");
    return c;
}

std::string text_of(const Config& config, std::string_view dotted_key) {
    for (const auto& [key, value] : to_settings(config)) {
        if (key == dotted_key) return value;
    }
    return "unset";
}

RC_GTEST_PROP(Schema, SettingsAndTomlReadBackToTheSameConfiguration, ()) {
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
        RC_ASSERT(read.motion.time_column == config.motion.time_column);
        RC_ASSERT(read.faults.kind == config.faults.kind);
        RC_ASSERT(read.faults.random_kinds == config.faults.random_kinds);
    }
}

RC_GTEST_PROP(Schema, AnyTextIsAConfigurationOrAOneLineError, ()) {
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

TEST(Schema, SettingsAreShortAndOmitWhatIsUnset) {
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

TEST(Schema, AnUnsetListIsNotWritten) {
    for (const auto& [key, value] : to_settings(Config{})) EXPECT_EQ(key.find("discriminator_s"), std::string::npos);
}

}  // namespace zlg::config::schema_text_of_settings_test
