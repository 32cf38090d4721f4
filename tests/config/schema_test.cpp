// The table of keys: each key is a member of its own, with its kind, its choices and its place in the reference.
#include "schema_support.hpp"

namespace zlg::config::schema_test {

using core::BridgeMethod;
using core::DitherMethod;
using core::RelockMethod;

// A setting of this key that the table allows and that is not the default: another choice, or the first of a few
// values.
std::string sample_of(const KeyInfo& key) {
    const std::string dotted = key.section + "." + key.name;
    std::vector<std::string> values = key.choices;
    for (const char* value : {"7", "0.125", "0.01", "125", "7e6", "1e-6", "-1", "a.txt", "%"})
        values.emplace_back(value);
    const Settings defaults = to_settings(Config{});
    for (const std::string& value : values) {
        Config config;
        try {
            apply_pair(config, dotted, value, "sample");
        } catch (const ConfigError&) {
            continue;
        }
        if (to_settings(config) != defaults) return dotted + " = " + value;
    }
    return {};
}

// Guards against a row of the table that names the member of another key.
TEST(Schema, EveryKeySetsItselfAndNothingElse) {
    const Settings before = to_settings(Config{});
    for (const KeyInfo& key : describe_keys()) {
        const std::string dotted = key.section + "." + key.name;
        const std::string setting = sample_of(key);
        ASSERT_FALSE(setting.empty()) << dotted << ": no sample is allowed";
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

TEST(Schema, KnowsEveryKeyOfTheSections) {
    const std::set<std::string> sections{"run",    "gyro",     "drift",       "perimeter",    "light",  "photodiodes",
                                         "piezo",  "motion",   "switching",   "compensation", "design", "laser",
                                         "faults", "analysis", "temperature", "field"};
    std::set<std::string> found;
    std::set<std::string> names;
    for (const KeyInfo& key : describe_keys()) {
        found.insert(key.section);
        EXPECT_TRUE(names.insert(key.section + "." + key.name).second) << key.name;
        EXPECT_FALSE(key.meaning.empty()) << key.name;
        EXPECT_FALSE(key.allowed.empty()) << key.name;
    }
    EXPECT_EQ(found, sections);
    // The members of the sixteen structs, interval_optimal apart: 2 + 16 + 15 + 5 + 9 + 11 + 5 + 6 + 7 + 14 + 15 +
    // 7 + 2 + 7 + 3 + 6
    EXPECT_EQ(names.size(), 131u);
    EXPECT_TRUE(is_known_section("gyro"));
    EXPECT_FALSE(is_known_section("gyr"));
}

TEST(Schema, KindsAndChoicesAreThoseOfTheMembers) {
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

TEST(Schema, EveryNameOfAnEnumerationIsItsEnumerator) {
    EXPECT_EQ(with({"perimeter.loop=analog"}).perimeter.loop, Loop::analog);
    EXPECT_EQ(with({"perimeter.loop=exponential"}).perimeter.loop, Loop::exponential);
    EXPECT_EQ(with({"switching.first_segment=full"}).switching.first_segment, FirstSegment::full);
    EXPECT_EQ(with({"compensation.relock=none"}).compensation.relock, RelockMethod::none);
    EXPECT_EQ(with({"compensation.relock=detuning"}).compensation.relock, RelockMethod::detuning);
    EXPECT_EQ(with({"compensation.relock=mean_square"}).compensation.relock, RelockMethod::mean_square);
    EXPECT_EQ(with({"compensation.bridge=none"}).compensation.bridge, BridgeMethod::none);
    EXPECT_EQ(with({"compensation.bridge=linear"}).compensation.bridge, BridgeMethod::linear);
    EXPECT_EQ(with({"compensation.bridge=quadratic"}).compensation.bridge, BridgeMethod::quadratic);
    EXPECT_EQ(with({"compensation.bridge=auto"}).compensation.bridge, BridgeMethod::automatic);
    EXPECT_EQ(with({"switching.schedule=fixed"}).switching.schedule, Schedule::fixed);
    EXPECT_EQ(with({"switching.schedule=measured"}).switching.schedule, Schedule::measured);
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

TEST(Schema, ASectionIsMisspeltByALetterOrItsCase) {
    EXPECT_EQ(misspelt_section("Gyro"), "gyro");
    EXPECT_EQ(misspelt_section("gyr"), "gyro");
    EXPECT_EQ(misspelt_section("gyrro"), "gyro");
    EXPECT_EQ(misspelt_section("gyro"), std::nullopt);
    EXPECT_EQ(misspelt_section("lab"), std::nullopt);
    EXPECT_EQ(misspelt_section(std::string(1 << 20, 'g')), std::nullopt);
}

TEST(Schema, TheReferenceDocumentsEveryKeyWithItsDefault) {
    const std::string text = reference_markdown();
    for (const KeyInfo& key : describe_keys()) expect_contains(text, "| `" + key.name + "` |");
    expect_contains(text, "## [gyro]");
    expect_contains(text, "| `tick_s` | s | `0.005` | 1e-6..10 | length of a tick");
    expect_contains(text, "| `duration_s` | s | unset | above 0 up to 1e9 |");
}

}  // namespace zlg::config::schema_test
