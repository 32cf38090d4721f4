#include <zlg/acceptance/plan.hpp>
#include <zlg/config/schema.hpp>
#include <zlg/logs/error.hpp>

#include "test.hpp"

namespace zlg::plan_test {

using namespace acceptance;

const std::string unit = "[unit]\nserial = 17\n";
const std::string run = "[[run]]\nfiles = ['a.csv']\nkind = 'static'\n";

std::string path() { return testing::TempDir() + "plan_test.toml"; }

Plan read(const std::string& text) {
    std::ofstream{path()} << text;
    return read_plan(path());
}

void expect_refused(const std::string& text, const std::string& part) {
    test::expect_contains(test::message_of<std::runtime_error>([&] { (void)read(text); }), part);
}

TEST(Plan, is_read_whole) {
    const Plan plan = read(
        "[unit]\nserial = 'A1'\ntype = 'Z'\noperator = 'me'\nequipment = 'table 3'\ndate = 2026-11-02\nscale_arcsec = "
        "3.263\nlatitude_deg = 30\n" +
        run +
        "axis = 'up'\n[[run]]\nfiles = ['b.csv', 'c.csv']\nkind = 'rate_table'\ncolumn = 'wz'\nunit = 'counts'\n"
        "stages = [{ from_s = 0, to_s = 10, rate_deg_s = -2 }, { from_s = 10, to_s = 20, rate_deg_s = 2 }]\n"
        "[limits]\n'bias.deg_h' = { max = 2 }\n[accept]\nrisk = 0.01\n");
    EXPECT_EQ(plan.unit.serial, "A1");
    EXPECT_EQ(plan.unit.date, "2026-11-02");
    ASSERT_EQ(plan.runs.size(), 2u);
    EXPECT_EQ(plan.runs[0].axis, "up");
    EXPECT_FALSE(plan.runs[0].mapping.has("axis"));
    EXPECT_EQ(plan.runs[1].mapping.axes(), std::vector<std::string>{"wz"});
    EXPECT_EQ(plan.runs[1].mapping.text("scale_arcsec"), "3.263");
    EXPECT_EQ(plan.runs[1].stages[0].rate_arcsec_s, -7200.0);
    EXPECT_EQ(plan.limits[0].max, 2.0);
    EXPECT_FALSE(plan.limits[0].min);
    EXPECT_EQ(plan.risk, 0.01);
}

TEST(Plan, a_serial_of_digits_and_an_axis_that_is_a_column_are_taken) {
    const Plan plan = read(unit + run + "axis = 3\n");
    EXPECT_EQ(plan.unit.serial, "17");
    EXPECT_EQ(plan.runs[0].mapping.axes(), std::vector<std::string>{"3"});
}

TEST(Plan, what_is_wrong_is_named) {
    expect_refused("", "[unit] is missing");
    expect_refused("[unit]\ntype = 'x'\n" + run, "serial is missing");
    expect_refused(unit, "[[run]] is missing");
    expect_refused(unit + "[[run]]\nkind = 'static'\n", "files is missing");
    expect_refused(unit + "[[run]]\nfiles = []\nkind = 'static'\n", "names of files");
    expect_refused(unit + "[[run]]\nfiles = ['a']\nkind = 'still'\n", "'still'; allowed is static, rate_table");
    expect_refused(unit + run + "colour = 'red'\n", "colour");
    expect_refused(unit + run + "axis = 'up'\n", "needs latitude_deg");
    expect_refused(unit + run + "[limit]\n", "unknown section");
    expect_refused(unit + run + "[limits]\n'bias.deg_s' = { max = 1 }\n", "given in deg/h");
    expect_refused(unit + run + "[limits]\n'bias.deg_h' = { max = 1, min = 2 }\n", "is above max");
    expect_refused(unit + run + "[limits]\n'bias.deg_h' = { }\n", "allowed is { min");
    expect_refused(unit + run + "[limits]\n'bias.deg_h' = { max = nan }\n", "allowed is a number");
    expect_refused(
        "[unit]\nserial = 1\n[[run]]\nfiles = ['a']\nkind = 'switching'\n[limits]\n'switch_error.arcsec' = { max = 1 "
        "}\n",
        "no run of the plan gives it; it needs a run of kind static");
    expect_refused(unit + run + "[accept]\nrisk = 0.5\n", "allowed is a number");
    expect_refused(unit + run + "stages = [{ from_s = 5, to_s = 5, rate_deg_s = 1 }]\n", "allowed is above from_s");
    expect_refused(
        unit + run + "stages = [{ from_s = 0, to_s = 5, rate_deg_s = 1 }, { from_s = 4, to_s = 6, rate_deg_s = 1 }]\n",
        "before the one before it has ended");
    expect_refused("[unit\n", "allowed is TOML");
    expect_refused(std::string(10'000'000, '#'), "plan_test.toml");
}

TEST(Plan, a_file_that_is_not_there_is_an_error_of_input) {
    EXPECT_NE(test::message_of<logs::IoError>([] { (void)read_plan(testing::TempDir() + "no_such_plan.toml"); }), "");
}

// 15.041067 sin 30 = 7.5205, cos 30: 13.0260
TEST(Plan, the_earth_turns_about_axes_that_say_where_they_point) {
    const Unit at{.latitude_deg = 30.0};
    EXPECT_NEAR(*earth_about(at, "up"), 7.5205335, 1e-6);
    EXPECT_NEAR(*earth_about(at, "south"), -13.0259461, 1e-6);
    EXPECT_EQ(*earth_about(at, "east"), 0.0);
    EXPECT_FALSE(earth_about(at, "x"));
    EXPECT_FALSE(earth_about({}, "up"));
}

TEST(Plan, the_plan_that_is_written_can_be_read) {
    const std::string log = testing::TempDir() + "plan_test.csv";
    {
        std::ofstream out{log};
        out << "t [s],rate [deg/h]\n";
        for (int k = 0; k < 100; ++k) out << 0.01 * k << ',' << (k * 37 % 11) << '\n';
    }
    const Plan plan = read(plan_for({log}));
    ASSERT_EQ(plan.runs.size(), 1u);
    EXPECT_EQ(plan.runs[0].kind, RunKind::at_rest);
    EXPECT_EQ(plan.runs[0].files, std::vector<std::string>{log});
    std::filesystem::remove(log);
}

}  // namespace zlg::plan_test
