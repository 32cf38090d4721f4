// Values: read by their kind, or refused with the place, the value and what is allowed.
#include "schema_support.hpp"

namespace zlg::config::schema_values_test {

using core::BridgeMethod;
using core::RelockMethod;

TEST(Schema, ReadsEachKindOfValue) {
    const Config c = from_toml(
        "[run]\nduration_s = 600\nseed = 9223372036854775807\n[gyro]\ntick_s = 1\nbias_hz = 6e4\nfirst_bias_sign = -1\n"
        "[perimeter]\nloop = \"digital\"\n[switching]\ninterval_s = \"optimal\"\nfirst_segment = \"half\"\n"
        "[compensation]\nrelock = \"frequency\"\nbridge = \"constant\"\n"
        "[motion]\nkind = \"sum\"\namplitude_arcsec_s = [1, 2.5]\nfrequency_hz = 3\npath = \"a.txt\"\n"
        "column_holds = \"rate\"\n");
    EXPECT_EQ(c.run.duration_s, 600.0);
    EXPECT_EQ(c.run.seed, (std::uint64_t{1} << 63) - 1);
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

TEST(Schema, ANumberAfterOptimalIsANumberAgain) {
    Config c = with({"switching.interval_s=optimal", "switching.interval_s=30"});
    EXPECT_FALSE(c.switching.interval_optimal);
    EXPECT_EQ(c.switching.interval_s, 30.0);
}

TEST(Schema, ASetValueIsTomlOrAString) {
    EXPECT_EQ(with({"motion.path=data/a file.txt"}).motion.path, "data/a file.txt");
    EXPECT_EQ(with({"motion.path=\"a.txt\""}).motion.path, "a.txt");
    EXPECT_EQ(with({"motion.path=a=b"}).motion.path, "a=b");
    EXPECT_EQ(with({"motion.path="}).motion.path, "");
    EXPECT_EQ(with({"motion.comment=#"}).motion.comment, "#");
    EXPECT_EQ(with({" gyro.tick_s = 1e-3 "}).gyro.tick_s, 0.001);
    EXPECT_EQ(with({"motion.phase_deg=[1, 2]"}).motion.phase_deg, (std::vector<double>{1.0, 2.0}));
    EXPECT_EQ(with({"motion.path=1\ngyro.tick_s = 2"}).motion.path, "1\ngyro.tick_s = 2");
}

TEST(Schema, AnUnknownKeyIsToldTheNearestKnownOne) {
    EXPECT_EQ(toml_complaint("[switching]\ngap_ticks = 3\nintervall_s = 90\n"),
              "lab.toml:3: unknown key [switching] intervall_s; did you mean interval_s?");
    const auto expect_nearest = [](const std::string& text, std::string_view place, std::string_view nearest) {
        expect_contains(text, place);
        expect_contains(text, "did you mean " + std::string{nearest} + "?");
    };
    expect_nearest(toml_complaint("[drift]\ntick_s = 1\n"), "lab.toml:2: unknown key [drift] tick_s", "[gyro] tick_s");
    // Both [gyro] and [motion] have a scale_arcsec; the one of the same section is meant.
    expect_nearest(set_complaint("motion.scale_arcsecs=1"), "unknown key [motion] scale_arcsecs", "scale_arcsec");
    expect_nearest(toml_complaint("[swiching]\n"), "lab.toml:1: unknown section [swiching]", "[switching]");
    expect_nearest(toml_complaint("tick_s = 1\n"), "lab.toml:1: tick_s stands in no section", "[gyro] tick_s");
    expect_nearest(set_complaint("gyro.tick=1"), "unknown key [gyro] tick", "tick_s");
    expect_nearest(set_complaint("giro.tick_s=1"), "unknown section [giro]", "[gyro]");
    expect_contains(set_complaint("tick_s=1"), "did you mean [gyro] tick_s?");
    expect_contains(set_complaint("gyro.tick_s"), "an equals sign is missing");
    expect_contains(toml_complaint("gyro = 1\n"), "gyro is a section");
    expect_contains(toml_complaint("[[gyro]]\ntick_s = 1\n"), "gyro is a section");
    expect_contains(toml_complaint("[gyro.tick_s]\nx = 1\n"), "a number is wanted, this is a table");
}

TEST(Schema, ASyntaxErrorIsToldWithLineAndColumn) {
    expect_contains(toml_complaint("[gyro]\ntick_s = = 1\n"), "lab.toml:2:10: ");
    expect_contains(toml_complaint("[gyro]\ntick_s = 1\ntick_s = 2\n"), "lab.toml:3:");
    expect_contains(toml_complaint("[gyro\n"), "lab.toml:1:");
}

TEST(Schema, AWrongTypeIsToldWithTheWantedOne) {
    EXPECT_EQ(toml_complaint("[switching]\ngap_ticks = 3.0\n"),
              "lab.toml:2: switching.gap_ticks = 3.0: an integer is wanted, this is a real number; allowed is 1..40");
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

TEST(Schema, AValueOfAWrongTypeIsShownAsItCouldBeWritten) {
    const auto shown = [](const std::string& value) {
        const std::string complaint = set_complaint("run.seed=" + value);
        const auto begin = complaint.find("= ") + 2;
        return complaint.substr(begin, complaint.find(": an integer is wanted") - begin);
    };
    EXPECT_EQ(shown("0.1"), "0.1");
    EXPECT_EQ(shown("1.0"), "1.0");
    EXPECT_EQ(shown("-0.0"), "-0.0");
    EXPECT_EQ(shown("1e22"), "1e+22");
    EXPECT_EQ(shown("-inf"), "-inf");
    EXPECT_EQ(shown("word"), "'word'");
    EXPECT_EQ(shown("\"it's\""), "\"it's\"");
    EXPECT_EQ(shown("\"a\\nb\""), "\"a\\u000Ab\"");
    EXPECT_EQ(shown("[]"), "[]");
    EXPECT_EQ(shown("[1, [2.5, 'x']]"), "[ 1, [ 2.5, 'x' ] ]");
    // What the value is follows: "this is a table".
    EXPECT_EQ(shown("{ a = 1 }"), "...");
    EXPECT_EQ(shown("2024-02-03"), "...");
    EXPECT_EQ(shown("'" + std::string(70, 'x') + "'"), "'" + std::string(59, 'x') + "...");
}

TEST(Schema, AValueOutOfRangeIsToldWhatIsAllowed) {
    EXPECT_EQ(set_complaint("switching.gap_ticks=99"), "--set: switching.gap_ticks = 99: allowed is 1..40");
    expect_refused(toml_complaint("[gyro]\n\ntick_s = 0\n"), "lab.toml:3: gyro.tick_s", "0", "1e-6..10");
    expect_refused(set_complaint("perimeter.miss_lambda=0.24"), "perimeter.miss_lambda", "0.24",
                   "from 0 to below 0.24");
    expect_refused(set_complaint("gyro.bias_hz=0"), "gyro.bias_hz", "0", "above 0 up to 1e12");
    expect_refused(set_complaint("motion.scale_arcsec=0"), "motion.scale_arcsec", "0", "any finite number but 0");
    expect_refused(set_complaint("gyro.first_bias_sign=0"), "gyro.first_bias_sign", "0", "-1 or 1");
    expect_refused(set_complaint("run.seed=-1"), "run.seed", "-1", "0..9223372036854775807");
    expect_contains(set_complaint("run.seed=18446744073709551615"), "allowed is 0..9223372036854775807");
    expect_refused(set_complaint("motion.frequency_hz=[1, -1]"), "motion.frequency_hz", "[1, -1]", "one number");
    expect_refused(set_complaint("design.run_lengths_s=[]"), "design.run_lengths_s", "[]", "one number or an array");
}

}  // namespace zlg::config::schema_values_test
