#pragma once
// Logs for the tests of the gap bridge: how they are made, and how they are run through it.

#include <zlg/core/compensation/gap_bridge.hpp>

#include <cstdint>
#include <vector>

#include "compensation/compensation_support.hpp"

namespace gap_bridge_support {

using zlg::core::AngleRow;
using zlg::core::AngleSample;
using zlg::core::CompensationConstants;
using zlg::core::GapBridgeConfig;
using zlg::core::GapBridgeFault;
using zlg::core::GapBridgeState;
using zlg::core::GapReport;
using zlg::core::TickInput;

using Log = std::vector<TickInput>;

struct Delivered {
    std::vector<AngleSample> samples;
    std::vector<AngleRow> rows;
    std::vector<GapReport> gaps;
};

inline void drain_into(const GapBridgeConfig& config, GapBridgeState& state, Delivered& result,
                       const CompensationConstants& gyro = {}) {
    for (;;) {
        const zlg::core::DrainOutput out = drain(gyro, config, state);
        if (out.has_gap) result.gaps.push_back(out.gap);
        if (out.has_row) result.rows.push_back(out.row);
        if (!out.has_gap && !out.has_row) return;
    }
}

inline void step_into(const GapBridgeConfig& config, GapBridgeState& state, const TickInput& tick, Delivered& result,
                      const CompensationConstants& gyro = {}) {
    const AngleSample sample = step(gyro, config, state, tick);
    result.samples.push_back(sample);
    if (sample.has_final) result.rows.push_back(sample.final_row);
    if (sample.has_gap) result.gaps.push_back(sample.gap);
}

inline Delivered run(const GapBridgeConfig& config, const Log& log, const CompensationConstants& gyro = {}) {
    GapBridgeState state;
    Delivered result;
    for (const TickInput& tick : log) step_into(config, state, tick, result, gyro);
    drain_into(config, state, result, gyro);
    return result;
}

// What the counter reads in a gap means nothing: it must show nowhere.
inline constexpr double junk_arcsec = 1e6;

inline TickInput measured_tick(double value_arcsec) { return {.value_arcsec = value_arcsec, .variance_arcsec2 = 1.8}; }

inline TickInput gap_tick(std::int8_t mode = 1) {
    return {.measured = false, .value_arcsec = junk_arcsec, .variance_arcsec2 = 1.8, .mode = mode};
}

inline GapBridgeConfig random_config(compensation_test::Random& random) {
    for (;;) {
        GapBridgeConfig config;
        config.method = static_cast<zlg::core::BridgeMethod>(random.index(0, 3));
        config.extrapolation_points = random.index(1, 8);
        config.points_before = random.index(1, 8);
        config.points_after = random.index(1, 8);
        if (check(config) == GapBridgeFault::none) return config;
    }
}

// Rough motion with gaps of all lengths at all distances; some first ticks after a gap are amended one tick later.
inline Log random_log(compensation_test::Random& random, int n_ticks) {
    Log log;
    const double gap_chance = random.uniform(0.005, 0.6);
    const int longest = random.chance(0.3) ? 150 : random.index(1, 16);
    std::int8_t mode = 1;
    bool after_gap = false;
    bool in_gap = random.chance(0.3);
    while (static_cast<int>(log.size()) < n_ticks) {
        if (in_gap) {
            mode = static_cast<std::int8_t>(random.chance(0.7) ? -mode : mode);
            for (int k = random.index(1, longest); k > 0; --k) log.push_back(gap_tick(mode));
        }
        TickInput tick = measured_tick(random.uniform(-60.0, 60.0));
        tick.mode = mode;
        tick.sign = static_cast<std::int8_t>(-mode);
        tick.variance_arcsec2 = random.uniform(1.8, 9.0);
        if (after_gap && !in_gap && random.chance(0.5)) {
            tick.amend_previous = true;
            tick.amend_arcsec = random.uniform(-30.0, 30.0);
            tick.amend_variance_arcsec2 = random.uniform(0.0, 2.0);
        }
        log.push_back(tick);
        after_gap = in_gap;
        in_gap = random.chance(gap_chance);
    }
    log.resize(static_cast<std::size_t>(n_ticks));  // some logs end in a gap
    return log;
}

}  // namespace gap_bridge_support
