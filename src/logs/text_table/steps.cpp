#include "steps.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace zlg::logs {

double usual_step(std::span<const double> values, double share, double (*of)(double)) {
    constexpr std::uint64_t most = std::uint64_t{1} << 20;
    constexpr std::uint64_t stride = 2654435761;  // a prime: no pattern of the rows is met again and again
    const std::uint64_t n = values.size() < 2 ? 0 : values.size() - 1;
    std::vector<double> steps;
    for (std::uint64_t i = 0; i < std::min(n, most); ++i) {
        const auto k = static_cast<std::size_t>(n <= most ? i : i * stride % n);
        if (const double step = of(values[k + 1] - values[k]); !std::isnan(step)) steps.push_back(step);
    }
    if (steps.empty()) return std::numeric_limits<double>::quiet_NaN();
    const auto at = steps.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(steps.size()));
    std::ranges::nth_element(steps, at);
    return *at;
}

}  // namespace zlg::logs
