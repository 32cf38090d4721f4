#pragma once
// How much of the spread of a number comes from which parameter: rank correlation, and Sobol's indices of variance.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace zlg::sweep {

// Spearman's rank correlation of two columns; equal values share the mean of their ranks. Nothing with fewer than three
// rows, or where a column does not vary.
[[nodiscard]] std::optional<double> rank_correlation(std::span<const double> x, std::span<const double> y);

// As many independent gyros as the rows of Saltelli's design are worth where the rank correlation with one parameter is
// sought. In a row that parameter has its value of A in d gyros, and that of B in two; its correlation with the sum of
// a function of each other parameter has a variance of ((d - 1)^2 + 3)/((d + 2)^2 n_rows).
[[nodiscard]] std::size_t independent_gyros(std::size_t n_rows, std::size_t n_parameters);

// |rank correlation| beyond which two independent columns of n rows lie with a probability of 5 %, by the normal
// law: 1.96/sqrt(n - 1).
[[nodiscard]] double chance_correlation(std::size_t n);

// The values of a function on Saltelli's design of N rows and d inputs: of the points A, of the points B, and by input
// of A with the one column from B.
struct SobolDesign {
    std::vector<double> a;
    std::vector<double> b;
    std::vector<std::vector<double>> mixed;
};

struct SobolIndex {
    double first = 0.0;  // part of the variance from this input alone
    double first_low = 0.0, first_high = 0.0;
    double total = 0.0;  // from this input with all its interactions
    double total_low = 0.0, total_high = 0.0;
};

struct SobolIndices {
    std::vector<SobolIndex> inputs;
    std::size_t n_rows = 0;  // that were used
    std::size_t n_dropped =
        0;  // in which a value is not finite: a whole row of the design, so that the others stay a design
    double variance = 0.0;
};

// M. J. W. Jansen's estimators (Comput. Phys. Commun. 117, 1999, 35):
//
//   S_i = 1 - sum (f(B) - f(A_B^i))^2 / (c V)        T_i = sum (f(A) - f(A_B^i))^2 / (c V)
//
// with c = 2 N - 1 and V the variance of f(A), as OpenTURNS has them. The intervals are those of 95 % by percentiles of
// n_resamples draws of rows with replacement, each with the V of its own rows.
//
// seed    of the draws, which depend on nothing else.
// errors  std::invalid_argument: columns of different lengths, or no input. With fewer than two whole rows, or no
// variance,
//         every index is NaN.
[[nodiscard]] SobolIndices sobol_indices(const SobolDesign& design, int n_resamples = 1000, std::uint64_t seed = 1);

// Values on rows of points, in either order in use: the block A, the block B and the blocks A_B^1 ... A_B^d
// (OpenTURNS), or for each row A, A_B^1 ... A_B^d, B (SALib; also a sweep with `sensitivity`). Which, the points
// themselves say.
//
// points  row by row, n_inputs numbers each.
// errors  std::invalid_argument: they are no such design.
[[nodiscard]] SobolDesign as_design(std::span<const double> points, std::span<const double> values,
                                    std::size_t n_inputs);

}  // namespace zlg::sweep
