// The estimates of switches beside the half-periods: whenever they are made in time, the angles are the same; and what happens where
// they are not.

#include <zlg/core/compensation/gap_bridge.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include "gap_bridge_support.hpp"

namespace gap_bridge_background_test {

using namespace gap_bridge_support;
using compensation_test::Random;
using zlg::core::BridgeMethod;
using zlg::core::flag_lower_order;
using zlg::core::ticks_to_correction;

const GapBridgeConfig automatic{.method = BridgeMethod::automatic};

// Counts of a tone of 20.06 Hz, with a gap of three ticks in every 150.
Log tone_with_gaps(int n_ticks) {
    const auto place = [](double edge) { return std::floor(95.2 * std::cos(0.63 * edge)); };
    Log log;
    for (int t = 0; t < n_ticks; ++t) {
        TickInput tick = measured_tick(place(t + 1) - place(t));
        tick.half[0] = {.read = true, .sign = 1, .angle_arcsec = place(t + 0.5) - place(t)};
        tick.half[1] = {.read = true, .sign = -1, .angle_arcsec = place(t + 1) - place(t + 0.5)};
        tick.measured = t % 150 < 147;
        log.push_back(tick);
    }
    return log;
}

// Worked in the background, after each tick for which `works` is true.
template <class Works>
Delivered run_apart(const Log& log, GapBridgeState& state, Works&& works) {
    state.background.worker.is_background = true;
    Delivered result;
    for (std::size_t t = 0; t < log.size(); ++t) {
        step_into(automatic, state, log[t], result);
        if (works(t)) work({}, automatic, state);
    }
    drain_into(automatic, state, result);
    return result;
}

void expect_same(const Delivered& a, const Delivered& b) {
    EXPECT_EQ(a.rows, b.rows);
    EXPECT_EQ(a.gaps, b.gaps);
    for (std::size_t k = 0; k < a.samples.size(); ++k)
        ASSERT_EQ(a.samples[k].dtheta_arcsec, b.samples[k].dtheta_arcsec) << k;
}

TEST(BackgroundWork, TheTimeAtWhichItIsDoneIsOfNoAccount) {
    const Log log = tone_with_gaps(6000);
    const Delivered at_once = run(automatic, log);
    Random random{7};
    std::size_t next = 0;
    GapBridgeState state;
    const Delivered later = run_apart(log, state, [&](std::size_t t) {
        if (t < next) return false;
        next = t + static_cast<std::size_t>(random.index(1, 16));
        return true;
    });
    EXPECT_EQ(state.background.n_late, 0u);
    expect_same(at_once, later);
}

TEST(BackgroundWork, AnEstimateThatIsNotReadyIsCountedAndThePolynomialStandsIn) {
    const Log log = tone_with_gaps(3000);
    GapBridgeState state;
    // Not in the second half of the log.
    const Delivered got = run_apart(log, state, [](std::size_t t) { return t < 1500; });
    EXPECT_EQ(state.background.n_late, 10u);
    for (const GapReport& gap : got.gaps) {
        const bool by_polynomial = (got.rows[static_cast<std::size_t>(gap.first_tick)].flags & flag_lower_order) != 0;
        EXPECT_EQ(by_polynomial, gap.first_tick > 1450) << gap.first_tick;
    }
}

TEST(BackgroundWork, ARecordOfALateEstimateIsObeyed) {
    Log log = tone_with_gaps(3000);
    GapBridgeState state;
    // The background is away for a while: one gap, at tick 1497, misses its estimate.
    const Delivered live = run_apart(log, state, [](std::size_t t) { return t < 1500 || t > 1530; });
    EXPECT_EQ(state.background.n_late, 1u);
    log[static_cast<std::size_t>(1500 + ticks_to_correction({}, automatic))].late = true;
    expect_same(live, run(automatic, log));
}

// Two gaps miss theirs, one after the other; what comes later is estimated as if nothing had been.
TEST(BackgroundWork, ALateEstimateLeavesItsPlace) {
    Log log = tone_with_gaps(6000);
    GapBridgeState state;
    const Delivered live =
        run_apart(log, state, [](std::size_t t) { return (t <= 1500 || t >= 1530) && (t <= 1650 || t >= 1680); });
    EXPECT_EQ(state.background.n_late, 2u);
    for (const int closed : {1500, 1650})
        log[static_cast<std::size_t>(closed + ticks_to_correction({}, automatic))].late = true;
    expect_same(live, run(automatic, log));
}

}  // namespace gap_bridge_background_test
