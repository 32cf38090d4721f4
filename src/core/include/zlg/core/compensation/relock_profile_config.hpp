#pragma once
// What is presumed of the light from which the detuning after a gap is read.

#include <zlg/core/common/discriminator_curve.hpp>

namespace zlg::core {

struct RelockProfileConfig {
    double discriminator_per_lambda = 0.332;  // of (A - B)/(A + B); size 1e-6..1e6, either sign
    DiscriminatorCurve curve{};               // of the light; none: the linear law
};

enum class RelockProfileFault : unsigned char { none, discriminator, curve };

[[nodiscard]] constexpr RelockProfileFault check(const RelockProfileConfig& c) noexcept {
    const double size = c.discriminator_per_lambda < 0.0 ? -c.discriminator_per_lambda : c.discriminator_per_lambda;
    if (!(size >= 1e-6 && size <= 1e6)) return RelockProfileFault::discriminator;
    return check(c.curve) == CurveFault::none ? RelockProfileFault::none : RelockProfileFault::curve;
}

}  // namespace zlg::core
