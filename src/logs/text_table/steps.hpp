#pragma once
// From row to row of a column.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace zlg::logs {

[[nodiscard]] inline double as_it_is(double step) { return step; }

// Of these steps the one below which lies that share of them; those that are no number do not count, and NaN: there is
// none. Of very many a part is looked at, taken all over the column, so that no copy of it is needed.
//
// of  of each step what is looked at, such as its size.
template <class Values>
[[nodiscard]] double usual_step(const Values& values, double share = 0.5, double (*of)(double) = as_it_is) {
    constexpr std::size_t most = std::size_t{1} << 20;
    constexpr std::uint64_t stride = 2654435761;  // a prime: no pattern of the rows is met again and again
    const std::size_t n = values.size() < 2 ? 0 : values.size() - 1;
    std::vector<bool> is_taken(n, n <= most);
    for (std::uint64_t i = 0; i < most && n > most; ++i) is_taken[static_cast<std::size_t>(i * stride % n)] = true;
    std::vector<double> steps;
    steps.reserve(std::min(n, most));
    for (std::size_t k = 0; k < n; ++k)
        if (is_taken[k])
            if (const double step = of(values[k + 1] - values[k]); !std::isnan(step)) steps.push_back(step);
    if (steps.empty()) return std::numeric_limits<double>::quiet_NaN();
    const auto at = steps.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(steps.size()));
    std::nth_element(steps.begin(), at, steps.end());
    return *at;
}

}  // namespace zlg::logs
