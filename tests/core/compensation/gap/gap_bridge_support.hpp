#pragma once
// Logs for the tests of the gap bridge: how they are made, and how they are run through it.

#include <zlg/core/compensation/gap_bridge.hpp>

#include "compensation/compensation_support.hpp"

namespace zlg::core::gap_bridge_support {

using namespace compensation_test;

using Log = std::vector<TickInput>;

struct Delivered {
    std::vector<AngleSample> samples;
    std::vector<AngleRow> rows;
    std::vector<GapReport> gaps;
};

inline void drain_into(const GapBridgeConfig& config, GapBridgeState& state, Delivered& result,
                       const CompensationConstants& gyro = {}) {
    for (;;) {
        const DrainOutput out = drain(gyro, config, state);
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

inline TickInput measured_tick(double value_arcsec) { return {{.variance_arcsec2 = 1.8}, value_arcsec}; }

inline TickInput gap_tick(std::int8_t mode = 1) {
    TickInput tick{{.measured = false, .variance_arcsec2 = 1.8}, junk_arcsec};
    tick.mode = mode;
    return tick;
}

inline bool has(std::uint32_t flags, AngleFlag flag) { return (flags & flag) != 0; }

inline Log measured(int n, double value_arcsec = 10.0) {
    return Log(static_cast<std::size_t>(n), measured_tick(value_arcsec));
}

inline Log joined(std::initializer_list<Log> parts) {
    Log log;
    for (const Log& part : parts) log.insert(log.end(), part.begin(), part.end());
    return log;
}

inline Log gap(int n) { return Log(static_cast<std::size_t>(n), gap_tick()); }

// The angle at the edges of the ticks as a counter reads it, with a gap of n ticks in every 150.
inline Log counted(int n_ticks, int n_gap, const std::function<double(double)>& angle) {
    Log log;
    for (int t = 0; t < n_ticks; ++t) {
        const double middle = std::floor(angle(t + 0.5));
        TickInput tick = measured_tick(std::floor(angle(t + 1)) - std::floor(angle(t)));
        tick.half[0] = {.read = true, .sign = 1, .angle_arcsec = middle - std::floor(angle(t))};
        tick.half[1] = {.read = true, .sign = -1, .angle_arcsec = std::floor(angle(t + 1)) - middle};
        tick.variance_arcsec2 = 1.0 / 6.0;
        if (t % 150 >= 150 - n_gap) tick.measured = false;
        log.push_back(tick);
    }
    return log;
}

// 20.06 Hz.
inline double tone(double edge) { return 95.2 * std::cos(2.0 * 3.141592653589793 * 20.06 * 0.005 * edge); }

inline GapBridgeConfig random_config(Random& random) {
    for (;;) {
        GapBridgeConfig config;
        config.method = static_cast<BridgeMethod>(random.index(0, 3));
        config.extrapolation_points = random.index(1, 8);
        config.points_before = random.index(1, 8);
        config.points_after = random.index(1, 8);
        if (is_allowed(config)) return config;
    }
}

// Rough motion with gaps of all lengths at all distances; some first ticks after a gap are amended one tick later.
inline Log random_log(Random& random, int n_ticks) {
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

}  // namespace zlg::core::gap_bridge_support
