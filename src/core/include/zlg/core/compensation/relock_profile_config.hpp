#pragma once
// What is presumed of the light from which the detuning after a gap is read.

#include <zlg/core/common/discriminator_curve.hpp>

namespace zlg::core {

struct RelockProfileConfig {
    double discriminator_per_lambda = 0.332;  // of (A - B)/(A + B); size 1e-6..1e6, either sign
    DiscriminatorCurve curve{};               // of the light; none: the linear law
};

enum class RelockProfileFault : unsigned char { none, discriminator, curve };

[[nodiscard]] RelockProfileFault check(const RelockProfileConfig& config) noexcept;

}  // namespace zlg::core
