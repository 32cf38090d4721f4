#pragma once
// How a number depends on a parameter: rank correlation.

#include <cstddef>
#include <optional>
#include <span>

namespace zlg::sweep {

// Spearman's rank correlation of two columns; equal values share the mean of their ranks. Nothing with fewer than three
// rows, or where a column does not vary.
[[nodiscard]] std::optional<double> rank_correlation(std::span<const double> x, std::span<const double> y);

// |rank correlation| beyond which two independent columns of n rows lie with a probability of 5 %, by the normal
// law: 1.96/sqrt(n - 1).
[[nodiscard]] double chance_correlation(std::size_t n);

}  // namespace zlg::sweep
