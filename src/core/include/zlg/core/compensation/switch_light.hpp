#pragma once
// The light of a switch: the samples of the halves from the first one in which both beams are lit, or the loop is
// closed, gathered for the fit of the detuning (light_spline.hpp); and what the record of a half says of its detuning.

#include <cstdint>

#include <zlg/core/compensation/compensation_constants.hpp>
#include <zlg/core/compensation/light_spline.hpp>
#include <zlg/core/records.hpp>

namespace zlg::core {

// What is presumed of the light from which the detuning after a gap is read.
struct RelockProfileConfig {
    double discriminator_per_lambda = 0.332;  // of (A - B)/(A + B); size 1e-6..1e6, either sign
    DiscriminatorCurve curve{};               // of the light; none: the linear law
};

[[nodiscard]] constexpr bool is_allowed(const RelockProfileConfig& c) noexcept {
    const double size = c.discriminator_per_lambda < 0.0 ? -c.discriminator_per_lambda : c.discriminator_per_lambda;
    return size >= 1e-6 && size <= 1e6 && check(c.curve) == CurveFault::none;
}

struct SwitchLight {
    bool armed = false;            // the next half that counts is the first one
    std::int64_t first_half = -1;  // its index; -1: of none
    int n_halves = 0;
    int n_samples = 0;  // a half
    LightSums sums{};

    friend bool operator==(const SwitchLight&, const SwitchLight&) = default;
};

// Add one half, in order of time.
//
//   both beams   dl = sign F((A - w B)/(A + w B)/K),  w = mean(A)/mean(B) (1 - sign K x)/(1 + sign K x)
//   beam A       dl = sign F((A/level - 1)/K),        level = mean(A)/(1 + sign K x)
//
// with F the inverse of the discriminator and the recorded mean x of the half, apparent: what the control has balanced
// the photodiodes by is in it. Damage, and light of another mode, is not used: a sample that is not finite or not
// positive, a beam whose samples are all the same although there is noise, detunings beyond the curve or beyond any
// perimeter.
//
// counts  its light is that of the new mode: measured, or lit in an open loop.
// index   of the half.
// halves  that are gathered.
void step(const CompensationConstants& gyro, const RelockProfileConfig& config, SwitchLight& state,
          const HalfRecord& half, LightSamples light, bool counts, std::int64_t index, int halves) noexcept;

// All halves are there, and every one could be read.
[[nodiscard]] constexpr bool is_complete(const SwitchLight& light) noexcept {
    return light.n_samples > 0 && light.n_halves == light.sums.basis.halves;
}

// No perimeter is detuned by a thousand wavelengths: such a number is damage, and would overflow further on.
inline constexpr double max_detuning_lambda = 1e3;

// Of a half as the curve sees it. NaN for the mean square stands for no motion.
[[nodiscard]] TrueMoments moments_of(const CompensationConstants& gyro, const HalfRecord& half) noexcept;

// Mean square of a half and its variance, from the record.
struct RecordedSquare {
    bool known = false;
    double mean_sq_lambda2 = 0.0;  // without that of the noise; with what the loss of the bias has beyond it
    double variance_lambda4 = 0.0;
    // What it has more than the mean weighed by the trapezoid of the bias, of a detuning that changes evenly.
    double over_trapezoid_lambda2 = 0.0;
};

[[nodiscard]] RecordedSquare recorded_square(const CompensationConstants& gyro, const HalfRecord& half) noexcept;

}  // namespace zlg::core
