// Standard deviations in the gaps of closed loops, against the truth of the twin: of each tick, by its place in the
// gap, and of the whole switch.

#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/study/run.hpp>

#include "test.hpp"

namespace zlg::gap_sigma_test {

struct Case {
    std::vector<double> amplitude_arcsec_s, frequency_hz;
    int counts_per_fringe, gap_ticks;
    core::RelockMethod relock;
};

config::Config config_of(const Case& c) {
    config::Config made;
    made.run.duration_s = 500.0;
    made.switching.interval_s = 1.37;
    made.switching.gap_ticks = c.gap_ticks;
    made.gyro.scale_arcsec /= c.counts_per_fringe;
    made.gyro.bias_hz *= c.counts_per_fringe;
    made.motion.kind = config::MotionKind::sum;
    made.motion.amplitude_arcsec_s = c.amplitude_arcsec_s;
    made.motion.frequency_hz = c.frequency_hz;
    made.compensation.relock = c.relock;
    return made;
}

// Mean of (error/sigma)^2 of the ticks of the gaps, by place.
std::vector<double> by_place(const config::Config& config) {
    const twin::Motion motion = rig::motion(config);
    const std::int64_t ticks = rig::run_ticks(config, motion);
    rig::ClosedLoop loop{config, motion};
    rig::Replay replay{rig::asked_compensation(config)};
    std::vector<double> truth;
    std::vector<core::AngleRow> rows;
    const auto keep = [&](const core::AngleRow& row) { rows.push_back(row); };
    for (std::int64_t tick = 0; tick < ticks; ++tick) {
        truth.push_back(0.0);
        for (int h = 0; h < 2; ++h) {
            const rig::LoopHalf half = loop.advance();
            truth.back() += half.truth.dtheta_arcsec;
            replay.take(half.record, loop.light(), keep);
        }
    }
    replay.end(keep);
    // The first switches come before the motion is learnt.
    constexpr int unlearnt = 15;
    const auto n = static_cast<std::size_t>(config.switching.gap_ticks);
    std::vector<double> sum(n);
    int gaps = 0;
    for (std::size_t t = 1; t + n < rows.size(); ++t) {
        const auto is_open = [&](std::size_t at) { return (rows[at].flags & core::flag_loop_unlocked) != 0; };
        if (!is_open(t) || is_open(t - 1) || ++gaps <= unlearnt) continue;
        for (std::size_t j = 0; j < n; ++j) {
            const double off = (rows[t + j].dtheta_final_arcsec - truth[t + j]) / rows[t + j].sigma_arcsec;
            sum[j] += off * off;
        }
    }
    for (double& x : sum) x /= gaps - unlearnt;
    return sum;
}

TEST(GapSigma, is_that_of_each_tick_about_the_truth) {
    using core::RelockMethod;
    const std::vector<double> tone{12000.0}, tone_hz{20.06}, two{8000.0, 5000.0}, two_hz{7.03, 23.71};
    for (const int counts : {1, 4})
        for (const int gap_ticks : {2, 3, 5})
            for (const RelockMethod relock : {RelockMethod::joint, RelockMethod::mean_square})
                for (const bool is_two : {false, true}) {
                    const Case c{is_two ? two : tone, is_two ? two_hz : tone_hz, counts, gap_ticks, relock};
                    const std::vector<double> nse = by_place(config_of(c));
                    for (std::size_t j = 0; j < nse.size(); ++j) {
                        SCOPED_TRACE(testing::Message()
                                     << counts << " " << gap_ticks << " " << is_two << " tick " << j);
                        // In a tick with lit halves sigma holds what the law of a real bias is off by, and the twin's
                        // is not.
                        const bool is_dark = j == 0 && gap_ticks > 2;
                        EXPECT_GT(nse[j], is_dark ? 0.25 : 0.0);
                        EXPECT_LT(nse[j], 1.4);
                    }
                }
}

// A constant rotation is of the order of a constant, so that its sigma must be right: rounding, and light noise that is
// in the points and stays behind the gap. With the variance of the gap alone the mean square is 2.8.
TEST(GapSigma, of_a_polynomial_holds_the_re_lock_behind_the_gap) {
    config::Config config = config_of({{0.0}, {1.0}, 1, 3, core::RelockMethod::mean_square});
    config.compensation.bridge = core::BridgeMethod::constant;
    double sum = 0.0;
    int n = 0;
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
        config.run.seed = seed;
        study::RunTask task;
        task.config = config;
        for (const study::SwitchLine& line : study::run(task).switches) {
            if (std::isnan(line.true_error_arcsec)) continue;
            sum += line.true_error_arcsec * line.true_error_arcsec / (line.sigma_arcsec * line.sigma_arcsec);
            ++n;
        }
    }
    ASSERT_GT(n, 1200);
    // A standard error of 0.03. Sigma is known to be a fifth too large here: 0.70 and 0.67 of 2900 switches each, of
    // the random numbers before 0.2 and of those now. Smaller than the error by a tenth, or larger by a quarter, it
    // must not be.
    EXPECT_GT(sum / n, 1.0 / (1.25 * 1.25));
    EXPECT_LT(sum / n, 1.1 * 1.1);
}

}  // namespace zlg::gap_sigma_test
