
#include <zlg/study/run_page.hpp>

#include "test.hpp"

namespace zlg::run_page_test {

study::RunResult run_of(double duration_s) {
    study::RunTask task;
    task.config.run.duration_s = duration_s;
    task.config.switching.interval_s = 5.0;
    return study::run(task);
}

const report::Figure* figure(const report::Page& page, const std::string& id) {
    for (const auto& section : page.sections)
        for (const auto& f : section.figures)
            if (f.id == id) return &f;
    return nullptr;
}

TEST(RunPage, shows_the_sawtooth_one_switch_and_the_errors_of_all) {
    const auto page = study::run_page({}, run_of(32.0));
    for (const char* id : {"angle-error", "sum-of-errors", "one-switch", "detuning", "errors-in-time"})
        EXPECT_NE(figure(page, id), nullptr) << id;
    const auto& variants = page.sections.front().tables.front().rows;
    EXPECT_EQ(variants.front()[0], "one_mode");
    EXPECT_EQ(variants.front()[1], "-");
    const auto& meanings = page.sections.front().tables.at(1).rows;
    EXPECT_EQ(meanings.front()[1], "the same gyro, never switched");
    EXPECT_EQ(meanings.back()[1], "as the configuration says");
    EXPECT_EQ(page.verdict.find("6 switches; a switch costs "), 0u) << page.verdict;
    EXPECT_NE(page.verdict.find(" without correction."), std::string::npos) << page.verdict;
}

TEST(RunPage, the_magnified_switch_holds_its_gap) {
    const auto page = study::run_page({}, run_of(12.0));
    const auto* f = figure(page, "one-switch");
    ASSERT_NE(f, nullptr);
    ASSERT_EQ(f->bands.size(), 1u);
    EXPECT_EQ(f->bands[0].x0, 40.0) << "eight ticks of 5 ms are shown before it";
    EXPECT_EQ(f->bands[0].x1, 55.0);
}

TEST(RunPage, of_a_run_without_a_switch_says_no_more_than_there_is) {
    const auto page = study::run_page({}, run_of(2.0));
    ASSERT_EQ(page.sections.size(), 2u) << "the result, and how it was made";
    EXPECT_EQ(page.verdict.find("No switch in this run of 2 s, for the interval is 90 s"), 0u) << page.verdict;
    const auto& rows = page.sections.front().tables.front().rows;
    ASSERT_EQ(rows.size(), 1u) << "with nothing to correct all are equal, the gyro that is never switched among them";
    EXPECT_EQ(rows[0][0].find("one_mode, switching, "), 0u) << rows[0][0];
    EXPECT_TRUE(rows[0][0].ends_with("configured, magnetic_estimate")) << rows[0][0];
    EXPECT_EQ(figure(page, "angle-error")->caption.find("sawtooth"), std::string::npos);
    EXPECT_EQ(figure(page, "sum-of-errors"), nullptr);
}

TEST(RunPage, of_a_run_with_a_fault_names_it_and_what_the_core_noticed) {
    study::RunTask task;
    task.config.run.duration_s = 4.0;
    task.config.faults = {.kind = {twin::FaultKind::laser_off}, .at_s = {2.0}, .duration_s = {0.5}, .size = {0.0}};
    const auto result = study::run(task);
    const auto page = study::run_page(task.config, result);
    EXPECT_EQ(page.verdict.find("With a fault (laser_off at 2 s for 0.5 s): "), 0u) << page.verdict;
    ASSERT_EQ(page.sections.at(1).heading, "Faults");
    const auto& noticed = page.sections[1].tables.at(1).rows;
    const auto lost = std::ranges::find(noticed, "light_lost", [](const auto& row) { return row.front(); });
    ASSERT_NE(lost, noticed.end());
    EXPECT_EQ((*lost)[1], "2");
    EXPECT_GE(std::stod((*lost)[2]), 0.4);
    EXPECT_EQ(figure(page, "angle-error")->bands.at(0).name, "laser_off");
}

TEST(RunPage, says_how_it_was_made) {
    study::RunTask task;
    task.config.run.duration_s = 2.0;
    task.config.run.seed = 7;
    const auto page = study::run_page(task.config, study::run(task));
    EXPECT_NE(page.sections.back().paragraphs.front().find("seed 7"), std::string::npos);
    EXPECT_EQ(page.sections.back().code, "run.duration_s = 2\nrun.seed = 7\n");
}

}  // namespace zlg::run_page_test
