#include <zlg/design/substitution.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "range_check.hpp"

namespace zlg::design {
namespace {

constexpr int max_order = 4;
constexpr int max_count = 64;
constexpr std::string_view where = "substitution";

void check(const Substitution& s) {
    require(s.n >= 1 && s.n <= max_count, where, "n", s.n, "1..64 ticks");
    require(s.order >= 0 && s.order <= max_order, where, "order", s.order, "0..4");
    require_positive(where, "tick_s", s.tick_s);
    const auto& p = s.points;
    if (s.fit == Fit::extrapolation) {
        require(p.extrapolation > s.order && p.extrapolation <= max_count, where, "points.extrapolation",
                p.extrapolation, fmt::format("{}..64 for order {}", s.order + 1, s.order));
        return;
    }
    require(p.before >= 0 && p.before <= max_count, where, "points.before", p.before, "0..64");
    require(p.after >= 0 && p.after <= max_count, where, "points.after", p.after, "0..64");
    require(p.before + p.after > s.order, where, "points.before + points.after", p.before + p.after,
            fmt::format("at least {} for order {}", s.order + 1, s.order));
}

std::vector<int> range(int first, int last) {
    std::vector<int> ticks(static_cast<std::size_t>(std::max(0, last - first + 1)));
    std::iota(ticks.begin(), ticks.end(), first);
    return ticks;
}

// Polynomials that are orthogonal over the points (Forsythe, J. SIAM 5, 1957), so that no system of equations is
// solved: p_0 = 1, p_(m+1) = (x - a_m) p_m - b_m p_(m-1).
class Orthogonal {
public:
    Orthogonal(const std::vector<int>& points, int order) {
        for (int m = 0; m <= order; ++m) {
            long double square = 0.0L;
            long double moment = 0.0L;
            for (const int x : points) {
                const long double p = value(m, x);
                square += p * p;
                moment += static_cast<long double>(x) * p * p;
            }
            a_.push_back(moment / square);
            b_.push_back(m == 0 ? 0.0L : square / square_.back());
            square_.push_back(square);
        }
    }

    // p_m(x); needs the coefficients below m only.
    [[nodiscard]] long double value(int m, int x) const {
        long double previous = 0.0L;
        long double p = 1.0L;
        for (std::size_t k = 0; k < static_cast<std::size_t>(m); ++k) {
            const long double next = (static_cast<long double>(x) - a_[k]) * p - b_[k] * previous;
            previous = p;
            p = next;
        }
        return p;
    }

    [[nodiscard]] long double square(int m) const { return square_[static_cast<std::size_t>(m)]; }

private:
    std::vector<long double> a_, b_, square_;
};

// Weights of the sum of the fit over `targets`: sum_m p_m(x_k) / |p_m|^2 * sum_j p_m(j).
std::vector<double> weights_of_sum(const std::vector<int>& points, int order, const std::vector<int>& targets) {
    const Orthogonal basis{points, order};
    std::vector<long double> weight(points.size(), 0.0L);
    for (int m = 0; m <= order; ++m) {
        long double target = 0.0L;
        for (const int j : targets) target += basis.value(m, j);
        for (std::size_t k = 0; k < points.size(); ++k) {
            weight[k] += basis.value(m, points[k]) * target / basis.square(m);
        }
    }
    std::vector<double> rounded;
    for (const long double w : weight) rounded.push_back(static_cast<double>(w));
    return rounded;
}

void check(const Tone& tone) {
    require_finite("tone", "amplitude_arcsec_s", tone.amplitude_arcsec_s);
    require_not_negative("tone", "frequency_hz", tone.frequency_hz);
}

}  // namespace

std::vector<int> positions(const Substitution& s) {
    check(s);
    if (s.fit == Fit::extrapolation) return range(1 - s.points.extrapolation, 0);
    auto points = range(1 - s.points.before, 0);
    const auto after = range(s.n + 1, s.n + s.points.after);
    points.insert(points.end(), after.begin(), after.end());
    return points;
}

std::vector<double> sum_weights(const Substitution& s) { return weights_of_sum(positions(s), s.order, range(1, s.n)); }

ErrorResponse::ErrorResponse(const Substitution& s) : tick_s_{s.tick_s}, middle_ticks_{0.5 * (s.n + 1)} {
    add(sum_weights(s), positions(s));
    add(std::vector<double>(static_cast<std::size_t>(s.n), -1.0), range(1, s.n));
}

void ErrorResponse::add(const std::vector<double>& weights, const std::vector<int>& at) {
    weight_.insert(weight_.end(), weights.begin(), weights.end());
    for (const int x : at) offset_ticks_.push_back(x - middle_ticks_);
}

std::complex<double> ErrorResponse::operator()(double frequency_hz) const {
    require_not_negative("response of the substitution", "frequency_hz", frequency_hz);
    const double half = std::numbers::pi * frequency_hz * tick_s_;  // half of the phase over a tick
    const double mean = half == 0.0 ? 1.0 : std::sin(half) / half;
    std::complex<double> sum{};
    for (std::size_t k = 0; k < weight_.size(); ++k) sum += std::polar(1.0, 2.0 * half * offset_ticks_[k]) * weight_[k];
    return tick_s_ * mean * sum;
}

double ErrorResponse::span_ticks() const {
    const auto [low, high] = std::minmax_element(offset_ticks_.begin(), offset_ticks_.end());
    return *high - *low + 1.0;
}

WorstPhase worst(const ErrorResponse& response, const Tone& tone) {
    check(tone);
    const auto answer = tone.amplitude_arcsec_s * response(tone.frequency_hz);
    double phase = 0.5 * std::numbers::pi - std::arg(answer);
    if (phase > std::numbers::pi) phase -= 2.0 * std::numbers::pi;
    return {std::abs(answer), phase};
}

double rms_arcsec(const ErrorResponse& response, const Tone& tone) {
    return worst(response, tone).error_arcsec / std::numbers::sqrt2;
}

double worst_bound_arcsec(const ErrorResponse& response, std::span<const Tone> tones) {
    double sum = 0.0;
    for (const Tone& tone : tones) sum += worst(response, tone).error_arcsec;
    return sum;
}

double rms_arcsec(const ErrorResponse& response, std::span<const Tone> tones) {
    double square = 0.0;
    for (const Tone& tone : tones) square = std::hypot(square, rms_arcsec(response, tone));
    return square;
}

}  // namespace zlg::design
