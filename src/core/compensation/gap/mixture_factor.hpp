#pragma once
// The factor of C + E, with the roundings that C lacks, and what the models share in its coordinates (gap_mixture.hpp).

#include <zlg/core/compensation/gap_mixture.hpp>

namespace zlg::core {

// The first stage: the factor of the learnt C + E, and the model in which nothing is added.
void begin(const MotionCovariance& covariance, GapMixture& m) noexcept;

// The second, where C was learnt: the factor for all other models.
void add_rounding(const MotionCovariance& covariance, GapMixture& m) noexcept;

// Factor in the order of the present stages; H, z and k in its coordinates.
void factorize(const MotionCovariance& covariance, GapMixture& m) noexcept;

// Covariance of two ticks of the window where something is added, without that.
[[nodiscard]] double covariance_with(const MotionCovariance& covariance, const GapMixture& m, int a, int b) noexcept;

}  // namespace zlg::core
