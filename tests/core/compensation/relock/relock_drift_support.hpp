#pragma once
// The re-lock correction, with the constants that it is given.

#include <zlg/core/compensation/relock_drift.hpp>

#include "compensation/compensation_support.hpp"

namespace zlg::core::relock_drift_support {

using namespace compensation_test;

inline constexpr RelockMethod all_methods[] = {RelockMethod::frequency, RelockMethod::detuning,
                                               RelockMethod::mean_square};

struct Configured {
    CompensationConstants gyro{};
    RelockDriftConfig relock{};
};

inline Configured configured(RelockMethod method, std::int64_t ticks = 20) {
    return {.relock = {.method = method, .ticks = ticks}};
}

struct Tick {
    int sign = 1;
    std::int64_t counts_first = 0, counts_second = 0;
    double known_excess_counts = 0.0;
    double detuning_first_lambda = 0.0, detuning_second_lambda = 0.0;
    double detuning_sq_first_lambda2 = 0.0, detuning_sq_second_lambda2 = 0.0;
    double temperature_c = 0.0;
    bool with_phase = false;
};

inline RelockDriftOutput step(const Configured& c, RelockDriftState& state, const Tick& t) {
    const HalfRecord first{.counts = t.counts_first,
                           .detuning_lambda = t.detuning_first_lambda,
                           .detuning_sq_lambda2 = t.detuning_sq_first_lambda2,
                           .temperature_c = t.temperature_c,
                           .mode = static_cast<std::int8_t>(t.sign)};
    const HalfRecord second{.counts = t.counts_second,
                            .detuning_lambda = t.detuning_second_lambda,
                            .detuning_sq_lambda2 = t.detuning_sq_second_lambda2};
    return step(c.gyro, c.relock, state, {first, second, t.known_excess_counts, t.with_phase});
}

}  // namespace zlg::core::relock_drift_support
