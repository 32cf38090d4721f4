#pragma once
// Which order of the substituting polynomial leaves the smallest error, by motion and noise.
//
//   rms^2 = (A |H|)^2 / 2 + (g sigma)^2       motion of random phase, white noise of rms sigma a tick through the gain
//   g
//
// With points symmetric about the gap orders 2m and 2m + 1 give the same sum; the lower of equals is chosen.

#include <optional>
#include <vector>

#include <zlg/design/substitution_noise.hpp>

namespace zlg::design {

inline constexpr int n_orders = 5;

// What to compare: the order in it is ignored. Orders from 0 to `highest_order` that its points allow, at most 4.
struct OrderQuestion {
    Substitution substitution{};
    int highest_order = 2;  // 0..4, lowered to the number of points less 1
};

// The ratio of amplitude to noise, A T/sigma, from which `high` beats `low` at this frequency:
//
//   A T/sigma = T sqrt( 2 (g_high^2 - g_low^2) / (|H_low|^2 - |H_high|^2) )
//
// Nothing where the higher order never wins. 0 where it always does.
[[nodiscard]] std::optional<double> crossing_ratio(const OrderQuestion& question, int low, int high,
                                                   double frequency_hz);

// Best orders over a grid: frequencies by rows, ratios A T/sigma (> 0) by columns.
[[nodiscard]] std::vector<std::vector<int>> order_map(const OrderQuestion& question,
                                                      const std::vector<double>& frequencies_hz,
                                                      const std::vector<double>& ratios);

}  // namespace zlg::design
