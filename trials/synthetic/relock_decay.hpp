#pragma once
// The decay of the detuning after the loop is closed, by formula.

#include <vector>

#include "laws.hpp"

namespace zlg::trials {

// Detuning over that at the moment of closing, a time after it; time in ticks.
//
//   exponential   exp(-t/3.5)
//   slew          d(dl)/dt = -min(0.28, dl/1.1)
//   second_order  critically damped, time constant 1.05
//   underdamped   damping 0.6, natural frequency 1.0 rad
//   dead_time     nothing for 0.6, then as slew
[[nodiscard]] double detuning_ratio(LoopShape shape, double t_ticks);

[[nodiscard]] const char* loop_name(LoopShape shape);

// One half-period after closing, for a miss of 1.
struct DecayHalf {
    double mean_sq = 0.0;         // of the detuning over the half
    std::vector<double> samples;  // at the middles of n equal intervals
};

// The first halves after closing; what is left afterwards is below 1e-4 of the miss.
[[nodiscard]] std::vector<DecayHalf> relock_decay(LoopShape shape, int n_samples);

}  // namespace zlg::trials
