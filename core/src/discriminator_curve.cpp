#include <zlg/core/discriminator_curve.hpp>

#include <zlg/core/maths.hpp>

namespace zlg::core {
namespace {

constexpr double most_slope = 3.0;  // of a step: a cubic between such slopes has no turn

double lesser(double a, double b) noexcept { return a < b ? a : b; }

double limited_slope(double slope, double step_before, double step_after) noexcept {
    const double most = most_slope * lesser(step_before, step_after);
    if (!(slope > 0.0 && most > 0.0)) return 0.0;
    return slope < most ? slope : most;
}

struct Piece {
    double width;
    double step;  // rise over width
};

Piece piece(const DiscriminatorCurve& c, std::size_t k) noexcept {
    const double width = c.apparent_lambda[k + 1] - c.apparent_lambda[k];
    return {width, (c.detuning_lambda[k + 1] - c.detuning_lambda[k]) / width};
}

// a of a x + b x^3 through two nodes.
double slope_at_origin(const DiscriminatorCurve& c, std::size_t last) noexcept {
    const double step = piece(c, 0).step;
    if (last < 2) return step;
    const double x1 = c.apparent_lambda[1] * c.apparent_lambda[1];
    const double x2 = c.apparent_lambda[2] * c.apparent_lambda[2];
    const double chord = c.detuning_lambda[2] / c.apparent_lambda[2];
    return limited_slope((step * x2 - chord * x1) / (x2 - x1), step, step);
}

void set_slopes(DiscriminatorCurve& c) noexcept {
    const auto last = static_cast<std::size_t>(c.n_nodes - 1);
    c.slope[0] = slope_at_origin(c, last);
    for (std::size_t k = 1; k < last; ++k) {
        const Piece before = piece(c, k - 1);
        const Piece after = piece(c, k);
        const double parabola = (after.width * before.step + before.width * after.step) / (before.width + after.width);
        c.slope[k] = limited_slope(parabola, before.step, after.step);
    }
    const Piece end = piece(c, last - 1);
    const double before = last < 2 ? c.slope[0] : piece(c, last - 2).step;
    const double before_width = last < 2 ? end.width : piece(c, last - 2).width;
    const double parabola = end.step + (end.step - before) * end.width / (end.width + before_width);
    c.slope[last] = limited_slope(parabola, end.step, end.step);
}

// Node k with apparent_lambda[k] <= x < apparent_lambda[k + 1], for x below the last node.
std::size_t place(const DiscriminatorCurve& c, double x) noexcept {
    std::size_t low = 0;
    auto high = static_cast<std::size_t>(c.n_nodes - 1);
    while (high - low > 1) {
        const std::size_t middle = (low + high) / 2;
        (x < c.apparent_lambda[middle] ? high : low) = middle;
    }
    return low;
}

// Cubic of Hermite on piece k.
CurvePoint within(const DiscriminatorCurve& c, std::size_t k, double x) noexcept {
    const Piece p = piece(c, k);
    const double t = (x - c.apparent_lambda[k]) / p.width;
    const double bend = c.slope[k] + c.slope[k + 1] - 2.0 * p.step;
    const double start = p.step - c.slope[k];
    // F = y_k + h (m_k t + (step - m_k - bend) t^2 + bend t^3)
    const double square = start - bend;
    return {.detuning_lambda = c.detuning_lambda[k] + p.width * t * (c.slope[k] + t * (square + t * bend)),
            .slope = c.slope[k] + t * (2.0 * square + 3.0 * t * bend)};
}

}  // namespace

DiscriminatorCurve discriminator_curve(std::span<const double> apparent_lambda,
                                       std::span<const double> detuning_lambda) noexcept {
    DiscriminatorCurve c;
    const std::size_t n = apparent_lambda.size();
    if (n == 0 && detuning_lambda.empty()) return c;
    c.n_nodes = -1;
    if (n != detuning_lambda.size() || n >= max_curve_nodes) return c;
    c.n_nodes = static_cast<std::int32_t>(n) + 1;
    for (std::size_t k = 0; k < n; ++k) {
        c.apparent_lambda[k + 1] = apparent_lambda[k];
        c.detuning_lambda[k + 1] = detuning_lambda[k];
    }
    set_slopes(c);
    return c;
}

DiscriminatorCurve curve_from_deficit(std::span<const double> apparent_lambda, std::span<const double> deficit_ratio,
                                      double chi) noexcept {
    std::array<double, max_curve_nodes> detuning_lambda{};
    const std::size_t n = deficit_ratio.size() < detuning_lambda.size() ? deficit_ratio.size() : detuning_lambda.size();
    for (std::size_t k = 0; k < n; ++k) detuning_lambda[k] = square_root(deficit_ratio[k] / chi);
    return discriminator_curve(apparent_lambda, std::span{detuning_lambda}.first(n));
}

CurvePoint true_detuning(const DiscriminatorCurve& curve, double apparent_lambda) noexcept {
    if (curve.n_nodes == 0 || !is_finite(apparent_lambda)) return {.detuning_lambda = apparent_lambda};
    const double x = apparent_lambda < 0.0 ? -apparent_lambda : apparent_lambda;
    const auto last = static_cast<std::size_t>(curve.n_nodes - 1);
    CurvePoint point{.detuning_lambda = curve.detuning_lambda[last], .slope = 0.0};
    if (x < curve.apparent_lambda[last]) point = within(curve, place(curve, x), x);
    if (apparent_lambda < 0.0) point.detuning_lambda = -point.detuning_lambda;
    return point;
}

TrueMoments true_moments(const DiscriminatorCurve& curve, double mean_lambda, double mean_sq_lambda2,
                         double noise_sq_lambda2) noexcept {
    if (curve.n_nodes == 0) return {.mean_lambda = mean_lambda, .mean_sq_lambda2 = mean_sq_lambda2};
    const double spread_sq = mean_sq_lambda2 - mean_lambda * mean_lambda - noise_sq_lambda2;
    const double spread = spread_sq > 0.0 ? square_root(spread_sq) : 0.0;
    const double above = true_detuning(curve, mean_lambda + spread).detuning_lambda;
    const double below = true_detuning(curve, mean_lambda - spread).detuning_lambda;
    const double slope = true_detuning(curve, mean_lambda).slope;
    return {.mean_lambda = 0.5 * (above + below),
            .mean_sq_lambda2 = 0.5 * (above * above + below * below) + slope * slope * noise_sq_lambda2,
            .slope = slope};
}

}  // namespace zlg::core
