#include <zlg/design/order_choice.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "range_check.hpp"

namespace zlg::design {
namespace {

// Far above the rounding of the sums and far below any difference of interest. Orders 2m and 2m + 1 of symmetric points
// are equal within the first, relative; errors of no motion and no noise are below the second, as a part of the
// amplitude of a tick.
constexpr double equal_within = 1e-9;
constexpr double nothing = 1e-13;

struct Candidate {
    ErrorResponse response;
    double gain;
};

Candidate candidate(const OrderQuestion& question, int order) {
    Substitution s = question.substitution;
    s.order = order;
    return {ErrorResponse(s), sum_gain(s, TickNoise::white)};
}

int highest_order(const OrderQuestion& question) {
    require(question.highest_order >= 0 && question.highest_order < n_orders, "choice of order", "highest_order",
            question.highest_order, "0..4");
    const auto& s = question.substitution;
    const int n_points = s.fit == Fit::extrapolation ? s.points.extrapolation : s.points.before + s.points.after;
    return std::clamp(n_points - 1, 0, question.highest_order);
}

std::vector<Candidate> candidates(const OrderQuestion& question) {
    std::vector<Candidate> all;
    for (int order = 0; order <= highest_order(question); ++order) all.push_back(candidate(question, order));
    return all;
}

// sigma_arcsec of one tick.
int best_order(const std::vector<Candidate>& all, const Tone& tone, double sigma_arcsec) {
    int choice = 0;
    double best = std::numeric_limits<double>::infinity();
    const double floor = nothing * std::abs(tone.amplitude_arcsec_s) * all.front().response.tick_s();
    for (std::size_t order = 0; order < all.size(); ++order) {
        const auto& [response, gain] = all[order];
        const double rms = std::hypot(rms_arcsec(response, tone), gain * sigma_arcsec);
        if (rms < best * (1.0 - equal_within) - floor) {
            best = rms;
            choice = static_cast<int>(order);
        }
    }
    return choice;
}

}  // namespace

std::optional<double> crossing_ratio(const OrderQuestion& question, int low, int high, double frequency_hz) {
    const Candidate a = candidate(question, low);
    const Candidate b = candidate(question, high);
    const double motion = std::norm(a.response(frequency_hz)) - std::norm(b.response(frequency_hz));
    const double noise = b.gain * b.gain - a.gain * a.gain;
    if (!(motion > equal_within * std::norm(a.response(frequency_hz)))) return std::nullopt;
    return question.substitution.tick_s * std::sqrt(std::max(0.0, 2.0 * noise / motion));
}

std::vector<std::vector<int>> order_map(const OrderQuestion& question, const std::vector<double>& frequencies_hz,
                                        const std::vector<double>& ratios) {
    for (const double ratio : ratios) require_positive("map of orders", "ratio", ratio);
    const auto all = candidates(question);
    std::vector<std::vector<int>> map;
    for (const double f : frequencies_hz) {
        auto& row = map.emplace_back();
        for (const double ratio : ratios) {
            row.push_back(best_order(all, {ratio / question.substitution.tick_s, f}, 1.0));
        }
    }
    return map;
}

}  // namespace zlg::design
