#include <zlg/core/compensation/relock_profile_config.hpp>

namespace zlg::core {

RelockProfileFault check(const RelockProfileConfig& c) noexcept {
    const double k = c.discriminator_per_lambda;
    if (!((k >= 1e-6 && k <= 1e6) || (k <= -1e-6 && k >= -1e6))) return RelockProfileFault::discriminator;
    if (check(c.curve) != CurveFault::none) return RelockProfileFault::curve;
    return RelockProfileFault::none;
}

}  // namespace zlg::core
