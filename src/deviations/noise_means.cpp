#include "noise_means.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace zlg::deviations {

void LagOne::add(double value) {
    if (std::isfinite(value)) return add_to(0, value);
    for (auto& level : level_) level.has_previous = false;
}

void LagOne::add_to(std::size_t order, double value) {
    auto& level = level_[order];
    // Moments about the first value: a large constant would drown what varies.
    if (level.n == 0) level.origin = value;
    const double x = value - level.origin, before = level.previous - level.origin;
    const double difference = value - level.previous;
    const bool pair = level.has_previous;
    ++level.n;
    level.sum += x;
    level.square += x * x;
    if (pair) {
        ++level.pairs;
        level.product += x * before;
        level.head += before;
        level.tail += x;
    }
    level.previous = value;
    level.has_previous = true;
    if (pair && order + 1 < level_.size()) add_to(order + 1, difference);
}

std::optional<double> LagOne::exponent() const {
    for (std::size_t d = 0; d < level_.size(); ++d) {
        const auto& level = level_[d];
        if (level.n + static_cast<std::int64_t>(d) < min_means || level.pairs < 1) return std::nullopt;
        const auto n = static_cast<double>(level.n), pairs = static_cast<double>(level.pairs);
        const double mean = level.sum / n;
        const double variance = level.square - n * mean * mean;
        const double covariance = level.product - mean * (level.head + level.tail) + pairs * mean * mean;
        if (!(variance > 0.0)) return std::nullopt;
        const double r1 = covariance / variance * (n / (pairs + 1.0));
        const double delta = r1 / (1.0 + r1);
        if (!(delta >= 0.25) || d + 1 == level_.size()) return -2.0 * (delta + static_cast<double>(d));
    }
    return std::nullopt;
}

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t max_angles = 32;   // of a mean angle: enough to tell white from flicker
constexpr double angle_noise_from = 0.6;  // half way between white rate and flicker angle noise

struct Node {
    double found, noise;
};

// What the lag-1 exponent of mean rates is for each law: of -1 to -4 from r1 = 9 ln 3/(8 ln 2) - 2 and its kin, the
// ratio of the autocovariances of differences of a mean; above 0 of the sampled laws.
constexpr std::array<Node, 7> of_rates{
    {{-4.565, -4.0}, {-3.927, -3.0}, {-2.400, -2.0}, {-1.446, -1.0}, {0.0, 0.0}, {1.45, 1.0}, {2.0, 2.0}}};
// And of mean angles, 2 added; there is no closed form. Chosen so that 0, 1 and 2 come out as what they are.
constexpr std::array<Node, 3> of_angles{{{-0.45, 0.0}, {0.60, 1.0}, {1.90, 2.0}}};

template <std::size_t n> double straight(const std::array<Node, n>& nodes, double found) {
    if (found <= nodes.front().found) return nodes.front().noise;
    for (std::size_t k = 1; k < n; ++k)
        if (found <= nodes[k].found) {
            const auto& a = nodes[k - 1];
            const auto& b = nodes[k];
            return a.noise + (b.noise - a.noise) * (found - a.found) / (b.found - a.found);
        }
    return nodes.back().noise;
}

}  // namespace

void NoiseMeans::interrupt() {
    rate_.add(missing);
    angle_.add(missing);
}

void NoiseMeans::add(const RecordView& view, std::int64_t i) {
    has_gaps_ = view.known != nullptr;
    const double known = static_cast<double>(has_gaps_ ? view.known[i + m_] - view.known[i] : m_);
    rate_.add(known >= min_known(m_, view.least_known_ratio) ? (view.angle[i + m_] - view.angle[i]) / known : missing);
    if (has_gaps_) return;
    const std::int64_t n = std::min(m_, max_angles);
    double sum = 0.0;
    for (std::int64_t k = 0; k < n; ++k) sum += view.angle[i + k * m_ / n];
    angle_.add(sum / static_cast<double>(n));
}

std::optional<double> NoiseMeans::exponent() const {
    const auto rate = rate_.exponent();
    if (!rate) return std::nullopt;
    double noise = straight(of_rates, *rate);
    if (const auto angle = has_gaps_ || m_ == 1 ? std::nullopt : angle_.exponent(); angle && noise > angle_noise_from)
        noise = straight(of_angles, *angle + 2.0);
    return noise;
}

}  // namespace zlg::deviations
