#include "paper_parts.hpp"
#include "read_section.hpp"

namespace zlg::test::paper_tables_test {

using paper::paper_table_1;
using paper::paper_table_2;

study::RunResult relock_run() {
    study::RunResult run;
    run.relock_false_drift_deg_h = {4000.0, 3000.0, 1200.0, 200.0, 10.0};
    return run;
}

TEST(PaperTables, the_rows_are_those_of_the_print_with_the_twin_beside_them) {
    const auto rows = paper_table_1({}, relock_run()).section.tables.at(0).rows;
    using Row = std::vector<std::string>;
    EXPECT_EQ(rows.at(0), (Row{"1", "4056", "not corrected", "4056", "4000"}));
    EXPECT_EQ(rows.at(1), (Row{"2", "2956", "2399", "557", "3000"}));
    EXPECT_EQ(rows.at(2), (Row{"3", "1306", "497", "809", "1200"}));
    EXPECT_EQ(rows.at(3), (Row{"4", "207", "178", "29", "200"}));
    // (4056 + 557 + 809 + 29)/4, and the angles at 5 ms a tick.
    EXPECT_EQ(rows.at(4), (Row{"mean", "2131.25 (printed 2131)", "", "1362.75 (printed 1362)", "2100.00"}));
    EXPECT_EQ(rows.at(5)[3], "27.25 (printed 27)");
    EXPECT_EQ(rows.at(5)[4], "42.00");
    EXPECT_EQ(rows.at(6)[4], "22.00");

    const auto second = paper_table_2({}, relock_run()).section.tables.at(0).rows;
    EXPECT_EQ(second.at(0), (Row{"1", "4056", "3720", "336", "4000"}));
    EXPECT_EQ(second.at(2), (Row{"3", "1306", "1480", "-174", "1200"}));
    EXPECT_EQ(second.at(3), (Row{"4", "207", "278", "-71", "200"}));
    EXPECT_EQ(second.at(4)[3], "165.50 (printed 166)");
    EXPECT_EQ(second.at(5)[3], "3.31 (printed 3.3)");
}

TEST(PaperTables, a_run_without_a_switch_leaves_the_column_of_the_twin_empty) {
    for (const auto& item : {paper_table_1({}, {}), paper_table_2({}, {})})
        for (const auto& row : item.section.tables.at(0).rows) EXPECT_EQ(row.back(), "-");
}

TEST(PaperTables, the_text_tells_how_badly_each_loop_fits) {
    const std::string text = text_of(paper_table_1({}, relock_run()).section);
    for (const char* known : {"exponential 406", "slew 117", "tail 95", "order 151", "31.6, 12.2 and 5.4 ms"})
        EXPECT_TRUE(holds(text, known)) << known;
    EXPECT_TRUE(holds(text_of(paper_table_2({}, {}).section), "344 deg/h"));
}

TEST(PaperTables, an_exponential_loop_would_be_corrected_by_both_formulas) {
    for (const auto& item : {paper_table_1({}, {}), paper_table_2({}, {})}) {
        const auto& rows = item.section.tables.at(1).rows;
        ASSERT_EQ(rows.size(), 12u) << "four loops: drift, corrected, left";
        for (std::size_t tick = 1; tick <= 4; ++tick) EXPECT_EQ(rows[2][tick], "0");
        EXPECT_EQ(rows[2][5], "0.00");
        for (const std::size_t left : {5u, 8u, 11u}) EXPECT_NE(rows[left][5], "0.00") << rows[left - 2][0];
    }
}

TEST(PaperTables, the_fitted_loop_fails_as_the_table_does) {
    const auto& rows = paper_table_1({}, {}).section.tables.at(1).rows;
    const std::vector<std::string> known{"525", "457", "67"};
    EXPECT_EQ((std::vector<std::string>{rows.at(8).begin() + 2, rows.at(8).begin() + 5}), known) << "slew and tail";
}

}  // namespace zlg::test::paper_tables_test
