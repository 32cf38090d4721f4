#pragma once
// The light samples of one half-period as detunings: inverse of the discriminator F.

#include <array>
#include <cstdint>

#include <zlg/core/compensation/compensation_constants.hpp>
#include <zlg/core/compensation/relock_profile_config.hpp>
#include <zlg/core/records.hpp>

namespace zlg::core {

// No perimeter is detuned by a thousand wavelengths: such a number is damage, and would overflow further on.
inline constexpr double max_detuning_lambda = 1e3;

// Of one sample of both beams. What is larger is no measurement, and its powers would overflow.
[[nodiscard]] constexpr double light_noise_lambda(const CompensationConstants& gyro) noexcept {
    const double noise_lambda = gyro.light_noise.value();
    return noise_lambda < 1e3 ? noise_lambda : 1e3;
}

struct DetuningSamples {
    std::int32_t n = 0;                            // 0: the light cannot be used
    std::array<double, max_light_samples> lambda;  // the first n
};

//   both beams   dl = sign F((A - w B)/(A + w B)/K),  w = mean(A)/mean(B) (1 - sign K x)/(1 + sign K x)
//   beam A       dl = sign F((A/level - 1)/K),        level = mean(A)/(1 + sign K x)
//
// with the recorded mean x of the half, apparent: what the control has balanced the photodiodes by is in it.
//
// Damage, and light of another mode: a sample that is not finite or not positive, a beam whose samples are all the same
// although there is noise, detunings beyond the curve or beyond any perimeter.
void read_samples(const CompensationConstants& gyro, const RelockProfileConfig& config, const HalfRecord& half,
                  LightSamples light, DetuningSamples& out) noexcept;

// Of the variance of a sample's noise: by the slope of the curve that the detuning has come through, here or in the
// control.
[[nodiscard]] double noise_gain(const CompensationConstants& gyro, const TrueMoments& seen) noexcept;

// By the control, which records 0: neither the square nor the light is usable.
[[nodiscard]] constexpr bool is_refused(const CompensationConstants& gyro, const HalfRecord& half) noexcept {
    return gyro.light_noise.value() > 0.0 && half.detuning_sq_lambda2 <= 0.0;
}

// Mean square of a half and its variance, from the record.
struct RecordedSquare {
    bool known = false;
    double mean_sq_lambda2 = 0.0;  // without that of the noise
    double variance_lambda4 = 0.0;
};

[[nodiscard]] RecordedSquare recorded_square(const CompensationConstants& gyro, const HalfRecord& half) noexcept;

}  // namespace zlg::core
