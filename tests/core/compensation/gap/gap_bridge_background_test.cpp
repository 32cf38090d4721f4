// The estimates of switches beside the half-periods: whenever they are made in time, the angles are the same; and what
// happens where they are not.
#include "gap_bridge_support.hpp"

namespace zlg::core::gap_bridge_support::background_test {

const GapBridgeConfig automatic{.method = BridgeMethod::automatic};

// Worked in the background, after each tick for which `works` is true.
template <class Works> Delivered run_apart(const Log& log, GapBridgeState& state, Works&& works) {
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
    const Log log = counted(6000, 3, tone);
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
    const Log log = counted(3000, 3, tone);
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
    Log log = counted(3000, 3, tone);
    GapBridgeState state;
    // The background is away for a while: one gap, at tick 1497, misses its estimate.
    const Delivered live = run_apart(log, state, [](std::size_t t) { return t < 1500 || t > 1530; });
    EXPECT_EQ(state.background.n_late, 1u);
    log[static_cast<std::size_t>(1500 + ticks_to_correction({}, automatic))].late = true;
    expect_same(live, run(automatic, log));
}

// Two gaps miss theirs, one after the other; what comes later is estimated as if nothing had been.
TEST(BackgroundWork, ALateEstimateLeavesItsPlace) {
    Log log = counted(6000, 3, tone);
    GapBridgeState state;
    const Delivered live =
        run_apart(log, state, [](std::size_t t) { return (t <= 1500 || t >= 1530) && (t <= 1650 || t >= 1680); });
    EXPECT_EQ(state.background.n_late, 2u);
    for (const int closed : {1500, 1650})
        log[static_cast<std::size_t>(closed + ticks_to_correction({}, automatic))].late = true;
    expect_same(live, run(automatic, log));
}

}  // namespace zlg::core::gap_bridge_support::background_test
