#include <zlg/numeric/estimate.hpp>

#include <cmath>
#include <limits>

namespace zlg::numeric {

Estimate estimated(double value, double sigma) {
    if (!(std::isfinite(value) && std::isfinite(sigma) && sigma >= 0.0))
        return refused("the data leave it open: no finite standard error");
    return {.determined = true, .value = value, .sigma = sigma};
}

double widened(double sigma, double dof) {
    if (!(dof > 2.0)) return std::numeric_limits<double>::infinity();
    return sigma * std::sqrt(dof / (dof - 2.0));
}

}  // namespace zlg::numeric
