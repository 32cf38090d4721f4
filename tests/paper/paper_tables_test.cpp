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
    const auto figure = paper_table_2({}, {}).section.figures.at(0);
    const auto* left = series(figure, "(11) on the fitted loop");
    ASSERT_NE(left, nullptr);
    const double known[] = {4142.0, 525.0, 457.0, 67.0};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(left->y.at(i), known[i], 1.0);
    const auto* printed = series(figure, "table 1, by frequency");
    ASSERT_NE(printed, nullptr);
    EXPECT_EQ(printed->y, (std::vector<double>{4056.0, 557.0, 809.0, 29.0}));
}

TEST(PaperTables, the_figure_shows_measured_fitted_and_twin) {
    const auto figure = paper_table_1({}, relock_run()).section.figures.at(0);
    ASSERT_EQ(figure.series.size(), 6u);
    EXPECT_EQ(figure.series.front().y, (std::vector<double>{4056.0, 2956.0, 1306.0, 207.0}));
    EXPECT_EQ(figure.series.back().y, (std::vector<double>{4000.0, 3000.0, 1200.0, 200.0}));
    for (const auto& s : figure.series)
        for (const double y : s.y) EXPECT_TRUE(std::isfinite(y)) << s.name;
}

}  // namespace zlg::test::paper_tables_test
