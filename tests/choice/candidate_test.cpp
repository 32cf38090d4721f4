#include <zlg/choice/candidate.hpp>
#include <zlg/config/schema.hpp>

#include <algorithm>

#include <fmt/format.h>

#include "temporary_folder.hpp"
#include "test.hpp"

namespace zlg::candidate_test {

using namespace choice;

Requirement required(const std::string& more = "") {
    return parse_requirement("[require]\nrun_s = 600\nangle_error_arcsec = 10\n" + more, "r.toml");
}

TEST(Candidates, the_papers_methods_come_before_all_additions) {
    const std::vector<Method> all = methods(required()).all;
    // 9 corrections with their bridges, 3 readings, 2 schedules, with the magnetic estimate or without.
    ASSERT_EQ(all.size(), 9u * 3u * 2u * 2u);
    EXPECT_TRUE(std::ranges::is_sorted(all, {}, &Method::additions));
    EXPECT_EQ(std::ranges::count(all, 0, &Method::additions), 8);
    const auto first_with = [&](auto is_so) { return std::ranges::find_if(all, is_so) - all.begin(); };
    const auto joint = first_with([](const Method& m) { return m.relock == core::RelockMethod::joint; });
    const auto x4 = first_with([](const Method& m) { return m.reading == Reading::x4; });
    const auto measured = first_with([](const Method& m) { return m.schedule == config::Schedule::measured; });
    const auto magnetic = first_with([](const Method& m) { return m.magnetic == core::MagneticMethod::estimate; });
    const auto phase = first_with([](const Method& m) { return m.reading == Reading::phase; });
    EXPECT_EQ(joint, 8);
    EXPECT_LT(joint, x4);
    EXPECT_LT(x4, measured);
    EXPECT_LT(measured, magnetic);
    EXPECT_LT(magnetic, phase) << "two additions";
}

TEST(Candidates, a_key_that_is_given_is_kept) {
    const Requirement r = required(
        "[compensation]\nrelock = \"mean_square\"\nbridge = \"quadratic\"\n[gyro]\nreadout = "
        "\"count\"\n[laser]\nquadrature = \"x1\"\n[switching]\ninterval_s = 50\n");
    const std::vector<Method> all = methods(r).all;
    ASSERT_EQ(all.size(), 2u) << "with the magnetic estimate or without";
    EXPECT_EQ(all[0].relock, core::RelockMethod::mean_square);
    EXPECT_EQ(all[0].reading, Reading::x1);
    const std::vector<Candidate> found = candidates(r, all[0]);
    ASSERT_EQ(found.size(), 2u) << "full and half first segment";
    EXPECT_EQ(found[0].interval_s, 50.0);
    EXPECT_EQ(found[0].first_segment, config::FirstSegment::full);
}

TEST(Candidates, longer_intervals_come_first_and_end_with_the_run) {
    const Requirement r = required();
    const std::vector<Candidate> all = candidates(r, methods(r).all.front());
    EXPECT_EQ(all.front().interval_s, 600.0);
    for (std::size_t k = 1; k < all.size(); ++k) EXPECT_LE(all[k].interval_s, all[k - 1].interval_s);
    for (const double wanted_s : {300.0, 150.0, 100.0, 90.0, 60.0, 20.0, 1.0})
        EXPECT_NE(std::ranges::find(all, wanted_s, &Candidate::interval_s), all.end()) << wanted_s;
}

// What is not known of a switch is not taken for 0.
TEST(Candidates, a_motion_file_too_short_to_learn_the_error_of_a_switch_leaves_nothing_to_choose) {
    const test::TemporaryFolder folder;
    const auto excluded = [&](std::size_t rows) {
        std::string text;
        for (std::size_t k = 0; k < rows; ++k) text += fmt::format("{}\n", k % 7);
        const std::string path = folder.write(fmt::format("{}.txt", rows), text);
        const Requirement r = parse_requirement(
            fmt::format("[require]\nrun_s = 6\nangle_error_arcsec = 10\n[motion]\nkind = \"file\"\nrate_hz = 10\n"
                        "path = \"{}\"\n",
                        path),
            "r.toml");
        const Methods found = methods(r);
        EXPECT_EQ(found.all.empty(), !found.excluded.empty());
        return found.excluded.empty() ? "" : found.excluded.front();
    };
    // Five intervals but half of one, of 1.07 times 2.5 s: 12.04 s.
    EXPECT_NE(excluded(120).find("the motion file lasts 12 s; to learn the error of a switch takes 12.0"),
              std::string::npos);
    EXPECT_EQ(excluded(125), "");
}

TEST(Candidates, four_counts_a_fringe_are_the_same_gyro) {
    const config::Config x4 = with({}, {.method = {.reading = Reading::x4}});
    EXPECT_EQ(x4.gyro.scale_arcsec, config::Config{}.gyro.scale_arcsec / 4.0);
    EXPECT_EQ(x4.gyro.bias_hz, config::Config{}.gyro.bias_hz * 4.0);
    EXPECT_EQ(with(x4, {.method = {.reading = Reading::x4}}).gyro.bias_hz, x4.gyro.bias_hz) << "once";
}

TEST(Candidates, another_tick_has_the_same_gap_and_the_walk_of_lock_in) {
    const config::Config gyro = with({}, {.method = {.tick_s = 0.00125}});
    EXPECT_EQ(gyro.switching.gap_ticks, 12);
    EXPECT_DOUBLE_EQ(gyro.drift.random_walk_arcsec_sqrt_s, 2.0 * config::Config{}.drift.random_walk_arcsec_sqrt_s);
}

TEST(Candidates, a_delay_leaves_what_is_final_in_time) {
    // Polynomials: the longest gap and the points, 16 + 4 ticks; `auto`: 16 + 20 + 80 ms + 1.
    EXPECT_DOUBLE_EQ(final_delay_s(with({}, {})), 20 * 0.005);
    const Method joint{.relock = core::RelockMethod::joint, .bridge = core::BridgeMethod::automatic};
    EXPECT_DOUBLE_EQ(final_delay_s(with({}, {.method = joint})), 53 * 0.005);
    const std::vector<Method> quick = methods(required("delay_s = 0.2\n")).all;
    ASSERT_FALSE(quick.empty());
    for (const Method& m : quick) EXPECT_NE(m.relock, core::RelockMethod::joint);
    EXPECT_TRUE(methods(required("delay_s = 0.01\n")).all.empty());
}

TEST(Candidates, a_tick_that_the_loop_forbids_is_excluded_with_the_reason) {
    const Methods found = methods(required("tick_s = { min = 0.0005, max = 0.005 }\n"));
    ASSERT_EQ(found.excluded.size(), 1u);
    EXPECT_NE(found.excluded[0].find("0.5 ms"), std::string::npos) << found.excluded[0];
    for (const Method& m : found.all) EXPECT_EQ(m.tick_s, 0.005);
}

TEST(Candidates, what_is_chosen_makes_a_configuration) {
    config::Config read;
    for (const auto& [key, value] : chosen_keys({}, {.interval_s = 45.0})) config::apply_pair(read, key, value, "test");
    EXPECT_EQ(read.switching.interval_s, 45.0);
    EXPECT_EQ(read.compensation.bridge, core::BridgeMethod::quadratic);
    EXPECT_NE(in_words({.interval_s = 45.0}).find("relock mean_square, bridge quadratic"), std::string::npos);
}

}  // namespace zlg::candidate_test
