#include <rapidcheck/gtest.h>

#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/error.hpp>

#include "any_rows.hpp"
#include "temporary_folder.hpp"

using namespace zlg::logs;
using namespace zlg::test;
using zlg::core::AngleRow;

namespace {

const std::string names = "tick,t_s,dtheta_arcsec,dtheta_final_arcsec,sigma_arcsec,mode,flags\n";

std::string complaint(const std::string& rows) {
    const TemporaryFolder folder;
    const std::string path = folder.write("angles.csv", names + rows);
    return message_of<FormatError>([&] {
        AngleReader reader{path};
        for (TimedAngle angle; reader.next(angle);) continue;
    });
}

}  // namespace

TEST(AngleWriter, writes_settings_legend_tick_names_and_shortest_numbers) {
    const TemporaryFolder folder;
    AngleWriter writer{folder.file("angles.csv"), 0.005, {{"run.seed", "1"}}, false};
    writer.write({.tick = 0, .dtheta_arcsec = 0.1, .dtheta_final_arcsec = -3.0, .sigma_arcsec = 0.5, .mode = -1});
    writer.write({.tick = 1,
                  .dtheta_arcsec = 1e-7,
                  .dtheta_final_arcsec = 1e22,
                  .sigma_arcsec = std::numeric_limits<double>::infinity(),
                  .mode = 1,
                  .flags = zlg::core::flag_switching | zlg::core::flag_unrepaired});
    writer.close();
    EXPECT_EQ(content_of(folder.file("angles.csv")),
              "# format_version = 3\n# run.seed = 1\n"
              "# flags = switching:1 extrapolated:2 interpolated:4 correction:8 relock_corrected:16 "
              "relock_uncorrected:32 lower_order:64 unrepaired:128 loop_unlocked:256 invalid:512 mode_mixed:1024\n"
              "# tick_s = 0.005\n"
              "tick,t_s,dtheta_arcsec,dtheta_final_arcsec,sigma_arcsec,mode,flags\n"
              "0,0.005,0.1,-3,0.5,-1,0\n"
              "1,0.01,1e-07,1e+22,inf,1,129\n");
}

RC_GTEST_PROP(AngleLog, what_is_written_reads_back_the_same, ()) {
    const TemporaryFolder folder;
    std::vector<AngleRow> rows(*rc::gen::inRange<std::size_t>(1, 40));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].tick = static_cast<std::int64_t>(i);
        rows[i].dtheta_arcsec = *any_finite_double();
        rows[i].dtheta_final_arcsec = *any_finite_double();
        rows[i].sigma_arcsec =
            *rc::gen::arbitrary<bool>() ? std::numeric_limits<double>::infinity() : std::abs(*any_finite_double());
        rows[i].mode = *rc::gen::element<std::int8_t>(-1, 1);
        rows[i].flags = *rc::gen::arbitrary<std::uint32_t>();
    }
    AngleWriter writer{folder.file("angles.csv"), 0.25, {}, false};
    for (const AngleRow& row : rows) writer.write(row);
    writer.close();

    AngleReader reader{folder.file("angles.csv")};
    TimedAngle angle;
    for (const AngleRow& row : rows) {
        RC_ASSERT(reader.next(angle));
        RC_ASSERT(angle.row == row);
        // A quarter of a second is exact, so the time has no rounding.
        RC_ASSERT(angle.t_s == 0.25 * static_cast<double>(row.tick + 1));
    }
    RC_ASSERT(!reader.next(angle));
}

TEST(AngleReader, hands_out_the_settings_with_the_legend_of_the_flags) {
    const TemporaryFolder folder;
    const AngleReader reader{
        folder.write("angles.csv", "# flags = switching:1\n# tick_s = 0.005\n" + names + "0,0.005,0,0,0,1,0\n")};
    ASSERT_EQ(reader.header().settings.size(), 2u);
    EXPECT_EQ(reader.header().settings[0].second, "switching:1");
    EXPECT_EQ(reader.header().settings[1].first, "tick_s");
    EXPECT_TRUE(reader.header().warnings.empty());
}

TEST(AngleReader, refuses_rows_that_no_compensation_writes) {
    expect_contains(complaint("1,0.005,0,0,0,1,0\n"), "column 'tick': '1' leaves a hole; expected 0");
    expect_contains(complaint("0,0.005,0,0,0,1,0\n0,0.01,0,0,0,1,0\n"), "row 2, column 'tick': '0' is a repetition");
    expect_contains(complaint("0,0.005,inf,0,0,1,0\n"), "column 'dtheta_arcsec': 'inf' is not finite");
    expect_contains(complaint("0,0.005,0,nan,0,1,0\n"), "column 'dtheta_final_arcsec': 'nan' is not finite");
    expect_contains(complaint("0,0.005,0,0,-1,1,0\n"), "column 'sigma_arcsec': '-1' is negative");
    expect_contains(complaint("0,0.005,0,0,nan,1,0\n"), "column 'sigma_arcsec': 'nan' is not a number");
    expect_contains(complaint("0,0.005,0,0,0,2,0\n"), "column 'mode': '2' is out of range");
    expect_contains(complaint("0,0.005,0,0,0,1,-1\n"),
                    "column 'flags': '-1' is out of range; allowed is 0..4294967295");
    expect_contains(complaint(""), "is empty");
}

TEST(AngleReader, misses_a_column_that_is_not_there) {
    const TemporaryFolder folder;
    const std::string path =
        folder.write("angles.csv", "tick,t_s,dtheta_arcsec,sigma_arcsec,mode,flags\n0,0,0,0,1,0\n");
    expect_contains(message_of<FormatError>([&] { AngleReader{path}; }), "'dtheta_final_arcsec' is missing");
}

TEST(AngleWriter, has_room_for_the_longest_row) {
    const TemporaryFolder folder;
    AngleWriter writer{folder.file("angles.csv"), -2.2250738585072014e-308, {}, false};
    const double longest = -2.2250738585072014e-308;
    writer.write({.tick = 0,
                  .dtheta_arcsec = longest,
                  .dtheta_final_arcsec = longest,
                  .sigma_arcsec = -longest,
                  .mode = -1,
                  .flags = 4294967295u});
    writer.close();
    const std::string text = content_of(folder.file("angles.csv"));
    expect_contains(text,
                    "\n0,-2.2250738585072014e-308,-2.2250738585072014e-308,-2.2250738585072014e-308,"
                    "2.2250738585072014e-308,-1,4294967295\n");
}
