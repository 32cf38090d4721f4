#include <gtest/gtest.h>

#include <zlg/study/run_page.hpp>

namespace {

using namespace zlg;

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
    const auto page = study::run_page({}, run_of(30.0));
    for (const char* id :
         {"angle-error", "compensations", "one-switch", "detuning", "piezo", "switch-errors", "errors-in-time"})
        EXPECT_NE(figure(page, id), nullptr) << id;
    const auto& variants = page.sections.front().tables.front().rows;
    ASSERT_EQ(variants.size(), 9u);
    EXPECT_EQ(variants.front()[1], "the same gyro, never switched");
    EXPECT_EQ(variants.back()[1], "as the configuration says");
}

TEST(RunPage, the_magnified_switch_holds_its_gap) {
    const auto page = study::run_page({}, run_of(12.0));
    const auto* f = figure(page, "one-switch");
    ASSERT_NE(f, nullptr);
    ASSERT_EQ(f->bands.size(), 1u);
    EXPECT_EQ(f->bands[0].x0, 1000.0);
    EXPECT_EQ(f->bands[0].x1, 1003.0);
}

TEST(RunPage, of_a_run_without_a_switch_says_no_more_than_there_is) {
    const auto page = study::run_page({}, run_of(2.0));
    EXPECT_EQ(page.sections.size(), 1u);
}

}  // namespace
