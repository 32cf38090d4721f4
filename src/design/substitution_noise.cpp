#include <zlg/design/substitution_noise.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "range_check.hpp"

namespace zlg::design {
namespace {

constexpr std::string_view where = "substitution noise";

// Roundings by the edge at which the count was read: tick x is edge x less edge x - 1.
using EdgeWeights = std::map<int, double>;

EdgeWeights edges_of(const std::vector<int>& ticks, const std::vector<double>& weights) {
    EdgeWeights edges;
    for (std::size_t k = 0; k < ticks.size(); ++k) {
        edges[ticks[k]] += weights[k];
        edges[ticks[k] - 1] -= weights[k];
    }
    return edges;
}

// Over the sigma of a tick, which has two edges.
double edge_gain(const EdgeWeights& edges) {
    double square = 0.0;
    for (const auto& [edge, weight] : edges) square += 0.5 * weight * weight;
    return std::sqrt(square);
}

double gain(const Substitution& s, const std::vector<double>& weights, TickNoise noise) {
    if (noise == TickNoise::counter) return edge_gain(edges_of(positions(s), weights));
    double square = 0.0;
    for (const double w : weights) square += w * w;
    return std::sqrt(square);
}

void check_constant(double noise_arcsec, int n) {
    require_not_negative(where, "noise_arcsec", noise_arcsec);
    require(n >= 1, where, "n", n, "1 or more ticks");
}

}  // namespace

double sum_gain(const Substitution& s, TickNoise noise) { return gain(s, sum_weights(s), noise); }

double counter_tick_sigma_arcsec(double lsb_arcsec) {
    require_not_negative(where, "lsb_arcsec", lsb_arcsec);
    return lsb_arcsec / std::sqrt(6.0);
}

double sigma_ratio_to_constant(const Substitution& s) {
    Substitution constant = s;
    constant.order = 0;
    return sum_gain(s, TickNoise::white) / sum_gain(constant, TickNoise::white);
}

std::optional<double> crossing_ratio(Substitution substitution, int low, int high, double frequency_hz) {
    // Orders 2m and 2m + 1 of symmetric points are equal within this, relative: far above the rounding of the sums and
    // far below any difference of interest.
    constexpr double equal_within = 1e-9;
    const auto of_order = [&](int order) {
        substitution.order = order;
        const double gain = sum_gain(substitution, TickNoise::white);
        return std::pair{std::norm(ErrorResponse(substitution)(frequency_hz)), gain * gain};
    };
    const auto [low_motion, low_noise] = of_order(low);
    const auto [high_motion, high_noise] = of_order(high);
    const double motion = low_motion - high_motion;
    if (!(motion > equal_within * low_motion)) return std::nullopt;
    return substitution.tick_s * std::sqrt(std::max(0.0, 2.0 * (high_noise - low_noise) / motion));
}

double constant_noise_as_printed_arcsec(double noise_arcsec, int n) {
    check_constant(noise_arcsec, n);
    return 0.5 * noise_arcsec * std::sqrt(n);
}

double constant_noise_arcsec(double noise_arcsec, int n) {
    check_constant(noise_arcsec, n);
    return 0.5 * noise_arcsec * n;
}

double relock_through_fit_arcsec(const Substitution& s, std::span<const double> residual_arcsec) {
    const auto ticks = positions(s);
    const auto weights = sum_weights(s);
    double sum = 0.0;
    for (std::size_t i = 0; i < residual_arcsec.size(); ++i) {
        require_finite(where, "residual_arcsec", residual_arcsec[i]);
        for (std::size_t k = 0; k < ticks.size(); ++k) {
            if (ticks[k] == s.n + 1 + static_cast<int>(i)) sum += weights[k] * residual_arcsec[i];
        }
    }
    return sum;
}

double relock_residual_arcsec(const Substitution& s, std::span<const double> residual_arcsec) {
    double sum = relock_through_fit_arcsec(s, residual_arcsec);
    for (const double r : residual_arcsec) sum += r;
    return sum;
}

double switch_error_as_printed_arcsec(double motion_arcsec, double noise_arcsec) {
    return switch_error_arcsec(motion_arcsec, noise_arcsec, 0.0);
}

double switch_error_arcsec(double motion_arcsec, double noise_arcsec, double relock_arcsec) {
    require_not_negative(where, "motion_arcsec", motion_arcsec);
    require_not_negative(where, "noise_arcsec", noise_arcsec);
    require_not_negative(where, "relock_arcsec", relock_arcsec);
    return std::hypot(motion_arcsec, noise_arcsec, relock_arcsec);
}

}  // namespace zlg::design
