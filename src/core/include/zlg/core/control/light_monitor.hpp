#pragma once
// Fault detection for the converters of the light: residual tests with thresholds from the noise, each debounced.
//
// The counts do not go through these converters. Where the beat shows that both waves are there, a half is valid
// whatever the light says; but a detuning from faulty light must not move the perimeter.
//
//   test          residual                                                     threshold             debounce
//   stuck         first, middle and last sample of a beam equal, and equal
//                 to the first one of the half before                          -                     2 halves
//   noisy         second difference of samples, d = x_(k+1) - 2 x_k + x_(k-1)
//                 (white noise: E d^2 = 6 sigma^2); then fourth differences
//                 of the detuning, free of smooth motion (70 sigma^2)          6 sigma               2 halves
//   unbalanced    (dl_h - dl_(h-1))/2 times the sign of the bias: a faded beam
//                 adds to A - B a part that keeps its sign as the bias turns   2 sigma, at least .02 8 halves
//                 chi <dl^2> less the deficit of the bias: the detuning that
//                 is read should weaken the bias                               0.03                  -
//                 on the way to a lock: jump of the detuning where the bias
//                 is reversed; loss of light, at least 0.5 %                   8 sigma               -
//   contradicted  the bias beats although the light is too little for it       -                     8 halves
//
// sigma: light noise of one sample, as detuning. Method: Gertler, Fault Detection and Diagnosis in Engineering Systems,
// 1998.

#include <cstdint>

#include <zlg/core/control/monitor_limits.hpp>
#include <zlg/core/control/sync_detector.hpp>
#include <zlg/core/units.hpp>

namespace zlg::core {

// Of the detuning where the bias is reversed, on the way to a lock.
struct DetuningJump {
    double lambda = 0.0;            // times the sign of the bias behind it
    double variance_lambda2 = 0.0;  // by the noise of the light, and by the bend of the way
    double slope_sq = 1.0;          // of the curve

    friend constexpr bool operator==(const DetuningJump&, const DetuningJump&) = default;
};

struct LightMonitorState {
    float last_a = 0.0f;  // first sample of the half before
    float last_b = 0.0f;
    double last_lambda = 0.0;         // detuning of the half before, if `has_last`
    double last_lambda2 = 0.0;        // its mean square, if `has_last`
    bool has_last = false;            // the half before had a detuning
    bool was_dark = false;            // the half before had no light both ways, in a settled gyro
    std::int32_t n_stuck = 0;         // stuck halves in a row, up to the debounce limit
    std::int32_t n_noisy = 0;         // noisy halves in a row, up to the debounce limit
    double noise_lambda2 = 0.0;       // of a sample, since it is noisy
    std::int32_t n_contradicted = 0;  // contradicted halves in a row, up to the debounce limit
    std::int8_t side = 0;             // 1: beam A was too bright for B in the last half; -1: B for A
    std::int8_t last_side = 0;        // 1 or -1, whichever was seen last
    std::int32_t n_side = 0;          // halves in a row on this side, up to the debounce limit
    bool is_unbalanced = false;
    double end_lambda = 0.0;     // detuning at the end of the half before, by its last samples, if `has_end`
    bool has_end = false;        // the half before was closed and good
    float change_lambda = 0.0f;  // size of the detuning's change in it
    double jump_lambda = 0.0;    // from half to half where the bias is reversed, smoothed
    DetuningJump jump{};         // the last one

    friend constexpr bool operator==(const LightMonitorState&, const LightMonitorState&) = default;
};

struct LightMonitorInput {
    const SyncDetectorConfig& detector;
    const SyncDetectorInput& light;  // as it was given to the detector,
    SyncDetectorOutput& read;        // and what that made of it: where it is not to be trusted, that is changed here
    bool closed = false;             // the loop; the light is that of one mode
    bool settled = false;            // and locked
    double deficit_ratio = 0.0;      // of the bias, in this half and the one before
    double unknown_lambda2 = 0.0;    // variance of a jump, by what is not known of the photodiodes; at the centre
};

struct LightMonitorOutput {
    bool has_jump = false;      // from the half before to this one, and
    bool jumps = false;         // it, or its smoothed value, exceeds 8 sigma
    bool stuck = false;         // all samples of a beam are the same, also of the half before
    bool noisy = false;         // six times the noise of a sample
    bool unbalanced = false;    // one beam has faded against the other
    bool contradicted = false;  // the beat was there, half after half, where light is too little for it
    bool withheld = false;      // there is light both ways, but this half's mean square is not to be trusted
    bool returns = false;  // the first light after a dark half of a settled gyro: what moved meanwhile is not known
    bool has_mean_square = false;
};

// Advance by one half-period whose frame was received.
//
// While the beams are unbalanced, and in the first half after a dark one of a settled gyro, the mean of two halves,
// which is free of the imbalance, replaces the detuning of the second, and no mean square is given. Noise is judged by
// differences that no smooth change of the detuning affects, however fast, and through the curve of the discriminator.
// A detuning beyond the next mode is not used at all.
//
// latency  stuck and noisy: two halves; contradicted: eight; unbalanced: eight by the difference of two halves, at once
// by
//          the bias or on the way to a lock.
[[nodiscard]] LightMonitorOutput step(const MonitorLimits& limits, LightMonitorState& state,
                                      const LightMonitorInput& input) noexcept;

}  // namespace zlg::core
