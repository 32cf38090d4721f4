#pragma once
// The converters of the light: whether what they say can be the light of this gyro.
//
// The counts do not go through them. Where the beat proves that both waves are there, a half is good without their
// consent; but a detuning that rests on them must not move the perimeter.

#include <cstdint>
#include <span>

#include <zlg/core/common/discriminator_curve.hpp>
#include <zlg/core/units.hpp>

namespace zlg::core {

struct LightMonitorConfig {
    Wavelengths noise{0.0};  // of one sample, white, as detuning, 0..10; below `min_noise` none is known
    double bias_chi = 0.0;   // what a detuning takes from the bias: chi dl^2, 0..1e6; 0: not compared
    double max_gain = 1.0;   // of a reading over its detuning, far from the centre: 1 where the curve is known; 1..100
};

// Less noise than this could be none at all: steady light then is no fault, and nothing is called noisy.
inline constexpr Wavelengths min_noise{1e-4};

enum class LightMonitorFault : unsigned char { none, noise, bias_chi, max_gain };

[[nodiscard]] constexpr LightMonitorFault check(const LightMonitorConfig& c) noexcept {
    if (!(c.noise >= Wavelengths{0.0} && c.noise <= Wavelengths{10.0})) return LightMonitorFault::noise;
    if (!(c.bias_chi >= 0.0 && c.bias_chi <= 1e6)) return LightMonitorFault::bias_chi;
    if (!(c.max_gain >= 1.0 && c.max_gain <= 100.0)) return LightMonitorFault::max_gain;
    return LightMonitorFault::none;
}

struct LightMonitorState {
    float last_a = 0.0f;  // first sample of the half before
    float last_b = 0.0f;
    double last_lambda = 0.0;  // detuning of the half before, and its mean square,
    double last_lambda2 = 0.0;
    bool has_last = false;     // if there were
    bool was_dark = false;     // it had none, in a settled gyro
    std::int32_t n_stuck = 0;  // halves in a row, up to those that are enough; so are the others
    std::int32_t n_noisy = 0;
    std::int32_t n_contradicted = 0;
    std::int8_t side = 0;  // 1: beam A was too bright for B in the last half; -1: B for A
    std::int32_t n_side = 0;
    bool is_unbalanced = false;
    double end_lambda = 0.0;   // where the half before ended, by its last samples,
    bool has_end = false;      // if it was closed and good
    double jump_lambda = 0.0;  // from half to half, smoothed: what changes its sign with the bias

    friend constexpr bool operator==(const LightMonitorState&, const LightMonitorState&) = default;
};

struct LightMonitorInput {
    std::span<const float> light_a{};  // as they were given to the detector
    std::span<const float> light_b{};
    int sign = 1;                // bias_sign * polarity in force during the half: +1 or -1
    bool closed = false;         // the loop; the light is that of one mode
    bool settled = false;        // and locked
    bool beats = false;          // the counts show the bias: there is light in both directions
    double deficit_ratio = 0.0;  // what of the bias they lack in this half and the one before
    bool two_way = false;        // as the detector saw it, and so are the next
    bool dark = false;
    double light = 0.0;
    double signal_per_lambda = 0.332;           // of the detector, at the centre,
    const DiscriminatorCurve* curve = nullptr;  // and away from it; none: linear
    bool usable = false;
    Wavelengths detuning{};
    double mean_sq_lambda2 = 0.0;
};

struct LightMonitorOutput {
    bool stuck = false;         // all samples of a beam are the same, also of the half before
    bool noisy = false;         // six times the noise of a sample
    bool unbalanced = false;    // one beam has faded against the other
    bool contradicted = false;  // the beat was there, half after half, where light is too little for it
    bool withheld = false;      // there is light both ways, but this half's mean square is not to be trusted
    bool returns = false;  // the first light after a dark half of a settled gyro: what moved meanwhile is not known
    bool usable = false;   // the detuning is that of the gyro, and may steer it
    bool has_mean_square = false;
    Wavelengths detuning{};
    double mean_sq_lambda2 = 0.0;
};

// Advance by one half-period whose frame was received.
//
// A detuning beyond the next mode is that of no gyro. A beam that has faded adds to the signal what does not change its sign with the bias: the mean of two halves is free of
// it, and stands for the detuning of the second.
// Noise is judged by what no smooth change of the detuning leaves, however fast, and through the curve.
// In a settled gyro the first half after a dark one is taken for such, too.
// On the way to a lock the detuning at the end of a half is that at the beginning of the next one, or a beam has faded.
// So does one whose detuning should have taken much more from the bias than is missing.
//
// config   passed `check`.
// latency  stuck and noisy: two halves; unbalanced and contradicted: eight.
[[nodiscard]] LightMonitorOutput step(const LightMonitorConfig& config, LightMonitorState& state,
                                      const LightMonitorInput& input) noexcept;

}  // namespace zlg::core
