#include "laser_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace zlg::twin {
namespace {

// Weights of the nodes -1, 0, 1, 2 for the cubic through them, at x in 0..1.
std::array<double, 4> cubic_weights(double x) {
    const double left = x + 1.0;
    const double right = 1.0 - x;
    const double far_right = 2.0 - x;
    return {-x * right * far_right * (1.0 / 6.0), left * right * far_right * 0.5, left * x * far_right * 0.5,
            -left * x * right * (1.0 / 6.0)};
}

// All sets between any two: whatever lies on a path from one to the other may appear on it.
unsigned with_sets_between(unsigned sets) {
    unsigned result = sets;
    for (unsigned s = 0; s < 16; ++s) {
        for (unsigned t = 0; t < s; ++t) {
            if (!(sets >> s & 1U) || !(sets >> t & 1U)) continue;
            for (unsigned u = 0; u < 16; ++u) {
                if ((u & s & t) == (s & t) && (u | s | t) == (s | t)) result |= 1U << u;
            }
        }
    }
    return result;
}

FrameLight light_of(unsigned lit, const double* value, double near_bias_hz, double far_bias_hz) {
    FrameLight light{{}, near_bias_hz, far_bias_hz};
    for (unsigned i = 0; i < n_waves; ++i) {
        if (lit >> i & 1U) light.intensity[i] = std::max(value[i], 0.0);
    }
    return light;
}

// The far mode of a near one at sign * detuning.
double far_of(double sign, double detuning_lambda) { return sign * (detuning_lambda - 0.5); }

}  // namespace

LaserGrid::LaserGrid(const Gas& gas, double max_shift, std::size_t n_detuning, std::size_t n_shift)
    : n_detuning_{n_detuning},
      n_shift_{n_shift},
      shift_nodes_{n_shift + 3},
      cells_per_lambda_{static_cast<double>(n_detuning) / max_near_lambda},
      cells_per_shift_{static_cast<double>(n_shift) / max_shift} {
    fill(half_[0], 1.0, gas);
    fill(half_[1], -1.0, gas);
}

void LaserGrid::fill(Half& half, double sign, const Gas& gas) const {
    std::vector<GasPoint> point;
    std::vector<unsigned> lit;
    for (std::size_t i = 0; i < n_detuning_ + 3; ++i) {
        const double detuning = (static_cast<double>(i) - 1.0) / cells_per_lambda_;
        for (std::size_t j = 0; j < shift_nodes_; ++j) {
            const double shift = (static_cast<double>(j) - 1.0) / cells_per_shift_;
            point.push_back(gas.at(sign * detuning, far_of(sign, detuning), shift));
            lit.push_back(steady_state(point.back().competition).lit);
        }
    }
    half.candidates = candidates(lit);
    unsigned met = 0;
    for (const SetsOfWaves sets : half.candidates) met |= sets;
    for (unsigned set = 0; set < 16; ++set) {
        if (!(met >> set & 1U)) continue;
        half.grid[set].reserve(point.size());
        for (const GasPoint& p : point) {
            // Not-a-number loses every comparison, so a set without a balance is never chosen.
            Balance balance;
            if (!balance_of(p.competition, set, balance)) balance.value.fill(std::numeric_limits<double>::quiet_NaN());
            const FrameLight light = p.light(balance);
            half.grid[set].push_back({balance.value[0], balance.value[1], balance.value[2], balance.value[3],
                                      light.near_bias_hz, light.far_bias_hz});
        }
    }
}

// A zone edge may cross a cell without leaving one of its corners alone, so the nodes around are asked as well.
std::vector<LaserGrid::SetsOfWaves> LaserGrid::candidates(const std::vector<unsigned>& lit) const {
    std::vector<SetsOfWaves> result;
    result.reserve(n_detuning_ * n_shift_);
    for (std::size_t i = 0; i < n_detuning_; ++i) {
        for (std::size_t j = 0; j < n_shift_; ++j) {
            unsigned sets = 0;
            for (std::size_t a = 0; a < 4; ++a) {
                for (std::size_t b = 0; b < 4; ++b) sets |= 1U << lit[(i + a) * shift_nodes_ + j + b];
            }
            result.push_back(static_cast<SetsOfWaves>(with_sets_between(sets)));
        }
    }
    return result;
}

LaserGrid::Place LaserGrid::place(double detuning_lambda, double shift) const {
    const double along_detuning = detuning_lambda * cells_per_lambda_;
    const double along_shift = shift * cells_per_shift_;
    const std::size_t i = std::min(static_cast<std::size_t>(along_detuning), n_detuning_ - 1);
    const std::size_t j = std::min(static_cast<std::size_t>(along_shift), n_shift_ - 1);
    return {i * n_shift_ + j, i * shift_nodes_ + j, cubic_weights(along_detuning - static_cast<double>(i)),
            cubic_weights(along_shift - static_cast<double>(j))};
}

LaserGrid::Node LaserGrid::read(const std::vector<Node>& grid, const Place& place) const {
    Node sum{};
    const Node* row = grid.data() + place.first_node;
    for (const double detuning_weight : place.detuning_weight) {
        for (std::size_t b = 0; b < 4; ++b) {
            const double weight = detuning_weight * place.shift_weight[b];
            for (std::size_t v = 0; v < n_values; ++v) sum[v] += weight * row[b][v];
        }
        row += shift_nodes_;
    }
    return sum;
}

FrameLight LaserGrid::state(const Half& half, const Place& place) const {
    const unsigned sets = half.candidates[place.cell];
    auto best_set = static_cast<unsigned>(std::countr_zero(sets));
    Node best = read(half.grid[best_set], place);
    if (!std::has_single_bit(sets)) {
        double best_margin = margin(best_set, best.data());
        for (unsigned set = best_set + 1; sets >> set != 0 && !(best_margin >= 0.0); ++set) {
            if (!(sets >> set & 1U)) continue;
            const Node node = read(half.grid[set], place);
            const double set_margin = margin(set, node.data());
            // Written so that any number is better than none.
            if (!(set_margin <= best_margin) && !std::isnan(set_margin)) {
                best_set = set;
                best = node;
                best_margin = set_margin;
            }
        }
    }
    return light_of(best_set, best.data(), best[n_waves], best[n_waves + 1]);
}

FrameLight LaserGrid::at(double near_lambda, double shift) const {
    const FrameLight light = state(half_[near_lambda < 0.0 ? 1 : 0], place(std::abs(near_lambda), std::abs(shift)));
    return shift < 0.0 ? light.reversed() : light;
}

LaserGrid::Error LaserGrid::error(const Gas& gas) const {
    Error worst;
    const auto grow = [](double& largest, double difference) {
        largest =
            std::isnan(difference) ? std::numeric_limits<double>::infinity() : std::max(largest, std::abs(difference));
    };
    const auto compare = [&](double sign, double detuning, double shift) {
        const GasPoint point = gas.at(sign * detuning, far_of(sign, detuning), shift);
        const FrameLight exact = point.light(steady_state(point.competition));
        const FrameLight read = state(half_[sign < 0.0 ? 1 : 0], place(detuning, shift));
        for (std::size_t i = 0; i < n_waves; ++i) {
            grow(worst.intensity, read.intensity[i] - exact.intensity[i]);
        }
        grow(worst.bias_hz, read.near_bias_hz - exact.near_bias_hz);
        grow(worst.bias_hz, read.far_bias_hz - exact.far_bias_hz);
    };
    for (std::size_t i = 0; i < n_detuning_; ++i) {
        for (std::size_t j = 0; j < n_shift_; ++j) {
            // The middle, and a place that walks through the cell as the cells are passed, by the golden ratio.
            const double walk = 0.6180339887498949 * static_cast<double>(i * n_shift_ + j);
            for (const double sign : {1.0, -1.0}) {
                for (const double x : {0.5, walk - std::floor(walk)}) {
                    compare(sign, (static_cast<double>(i) + x) / cells_per_lambda_,
                            (static_cast<double>(j) + 1.0 - x) / cells_per_shift_);
                }
            }
        }
    }
    return worst;
}

}  // namespace zlg::twin
