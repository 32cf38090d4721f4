#include <zlg/choice/requirement.hpp>
#include <zlg/config/schema.hpp>

#include "test.hpp"

namespace zlg::requirement_test {

using choice::parse_requirement;
using choice::Requirement;

std::string refusal(const std::string& text) {
    try {
        (void)parse_requirement(text, "r.toml");
    } catch (const config::ConfigError& error) {
        return error.what();
    }
    return "";
}

TEST(Requirement, holds_what_is_asked_and_of_which_gyros) {
    const Requirement r = parse_requirement(R"([require]
run_s = 600
angle_error_arcsec = 30
drift_arcsec_s = 0.04
confidence = 0.9
tick_s = { min = 0.004, max = 0.006 }
angular_acceleration_arcsec_s2 = 100
delay_s = 0.5
gyros = 200
[gyro]
scale_arcsec = 2.0
[run]
seed = 7
[[tolerance]]
keys = ["perimeter.miss_lambda"]
draw = "uniform"
min = 0.1
max = 0.2
)",
                                            "r.toml", {"drift.magnetic_arcsec_s=0.5"});
    EXPECT_EQ(r.limit_arcsec(), 24.0) << "the smaller of 30 and 0.04 over 600 s";
    EXPECT_EQ(r.confidence, 0.9);
    EXPECT_EQ(r.tick_min_s, 0.004);
    EXPECT_EQ(r.tick_max_s, 0.006);
    EXPECT_EQ(r.gyros, 200);
    EXPECT_EQ(r.base.gyro.scale_arcsec, 2.0);
    EXPECT_EQ(r.base.run.seed, 7u);
    EXPECT_EQ(r.base.drift.magnetic_arcsec_s, 0.5);
    ASSERT_EQ(r.tolerance.size(), 1u);
    EXPECT_EQ(r.tolerance[0].max, 0.2);
}

TEST(Requirement, one_tolerance_may_be_a_table) {
    const Requirement r = parse_requirement(
        "[require]\nrun_s = 60\nangle_error_arcsec = 5\n[tolerance]\nkeys = [\"drift.magnetic_arcsec_s\"]\n"
        "draw = \"normal\"\nmean = 0.7\nsd = 0.1\n",
        "r.toml");
    ASSERT_EQ(r.tolerance.size(), 1u);
    EXPECT_EQ(r.tick_min_s, 0.005) << "the gyro's tick";
    EXPECT_EQ(r.tick_max_s, 0.005);
}

TEST(Requirement, says_in_one_line_what_cannot_be_required) {
    const std::string head = "[require]\n";
    const std::vector<std::pair<std::string, std::string>> cases{
        {head + "angle_error_arcsec = 5\n", "run_s is missing"},
        {head + "run_s = 60\n", "give one at least"},
        {head + "run_s = 0\nangle_error_arcsec = 5\n", "run_s = 0: allowed is a number above 0"},
        {head + "run_s = 60\nangle_error_arcsec = -1\n", "angle_error_arcsec = -1: allowed is a number above 0"},
        {head + "run_s = 60\ndrift_arcsec_s = nan\n", "allowed is a finite number"},
        {head + "run_s = 60\nangle_error_arcsec = 5\nconfidence = 1\n", "a number between 0 and 1"},
        {head + "run_s = 60\nangle_error_arcsec = 5\ntick_s = { min = 0.01 }\n", "min <= max"},
        {head + "run_s = 60\nangle_error_arcsec = 5\ntick_s = 0.01\n", "{ min = , max = }"},
        {head + "run_s = 60\nangle_error_arcsec = 5\nangular_acceleration_arcsec_s2 = -2\n", "0 or more"},
        {head + "run_s = 60\nangle_error_arcsec = 5\nangular_acceleration_arcsec_s2 = 2e6\n",
         "the counter does not follow"},
        {head + "run_s = 60\nangle_error_arcsec = 5\ngyros = 0\n", "an integer 1.."},
        {head + "run_s = 60\nangle_error_arcsec = 5\n[switching]\ninterval_s = 90\n", "shorter than"},
        {head + "run_s = 0.02\nangle_error_arcsec = 5\n", "ten ticks"},
        {head + "run_s = 60\nangle_error_arcsec = 5\n[run]\nduration_s = 60\n", "is require.run_s here"},
        {head + "run_s = 60\nangle_error_arcsec = 5\nwish = 1\n", "unknown key [require] wish"},
        {head + "run_s = 60\nangle_error_arcsec = 5\n[gyros]\ntick_s = 1\n", "gyro"},
        {head + "run_s = 60\nangle_error_arcsec = 5\n[[tolerance]]\nkeys = [\"switching.interval_s\"]\n"
                "draw = \"uniform\"\nmin = 1\nmax = 2\n",
         "that is chosen"},
        {"[gyro]\n", "require is missing"}};
    for (const auto& [text, part] : cases) {
        const std::string line = refusal(text);
        EXPECT_NE(line.find(part), std::string::npos) << text << "\n" << line;
        EXPECT_EQ(line.find('\n'), std::string::npos) << line;
        EXPECT_EQ(line.find("r.toml"), 0u) << line;
    }
}

}  // namespace zlg::requirement_test
