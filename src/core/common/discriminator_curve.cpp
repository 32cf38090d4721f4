#include <zlg/core/common/discriminator_curve.hpp>

#include <zlg/core/common/maths.hpp>

namespace zlg::core {
namespace {

constexpr double max_slope = 3.0;  // of a step: a cubic between such slopes has no turn

double limited_slope(double slope, double step_before, double step_after) noexcept {
    const double most = max_slope * (step_before < step_after ? step_before : step_after);
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

// Of the parabola through the last three nodes before an end; pieces counted inwards.
double slope_at_end(Piece end, Piece next) noexcept {
    const double parabola = end.step + (end.step - next.step) * end.width / (end.width + next.width);
    return limited_slope(parabola, end.step, end.step);
}

void set_slopes(DiscriminatorCurve& c) noexcept {
    const auto last = static_cast<std::size_t>(c.n_nodes - 1);
    const bool both_sides = c.apparent_lambda[0] < 0.0;
    c.slope[0] = both_sides ? slope_at_end(piece(c, 0), piece(c, 1)) : slope_at_origin(c, last);
    for (std::size_t k = 1; k < last; ++k) {
        const Piece before = piece(c, k - 1);
        const Piece after = piece(c, k);
        const double parabola = (after.width * before.step + before.width * after.step) / (before.width + after.width);
        c.slope[k] = limited_slope(parabola, before.step, after.step);
    }
    const Piece end = piece(c, last - 1);
    c.slope[last] = slope_at_end(end, last < 2 ? Piece{end.width, c.slope[0]} : piece(c, last - 2));
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
    const double cubic = c.slope[k] + c.slope[k + 1] - 2.0 * p.step;
    const double start = p.step - c.slope[k];
    // F = y_k + h (m_k t + (step - m_k - cubic) t^2 + cubic t^3)
    const double quadratic = start - cubic;
    return {.detuning_lambda = c.detuning_lambda[k] + p.width * t * (c.slope[k] + t * (quadratic + t * cubic)),
            .slope = c.slope[k] + t * (2.0 * quadratic + 3.0 * t * cubic)};
}

}  // namespace

DiscriminatorCurve discriminator_curve(std::span<const double> apparent_lambda,
                                       std::span<const double> detuning_lambda) noexcept {
    DiscriminatorCurve c;
    const std::size_t n = apparent_lambda.size();
    if (n == 0 && detuning_lambda.empty()) return c;
    c.n_nodes = -1;
    std::size_t below = 0;
    while (below < n && apparent_lambda[below] < 0.0) ++below;
    // One side too many, or only the negative one.
    if (detuning_lambda.size() != n || below > max_side_nodes || n - below > max_side_nodes || n == below) return c;
    c.n_nodes = static_cast<std::int32_t>(n) + 1;
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t place = k < below ? k : k + 1;
        c.apparent_lambda[place] = apparent_lambda[k];
        c.detuning_lambda[place] = detuning_lambda[k];
    }
    set_slopes(c);
    return c;
}

CurvePoint true_detuning(const DiscriminatorCurve& curve, double apparent_lambda) noexcept {
    if (curve.n_nodes == 0 || !is_finite(apparent_lambda)) return {.detuning_lambda = apparent_lambda};
    const bool mirrored = apparent_lambda < 0.0 && !(curve.apparent_lambda[0] < 0.0);
    const double x = mirrored ? -apparent_lambda : apparent_lambda;
    const auto last = static_cast<std::size_t>(curve.n_nodes - 1);
    CurvePoint point{.detuning_lambda = curve.detuning_lambda[last], .slope = 0.0};
    if (!(x > curve.apparent_lambda[0])) {
        const bool at_end = curve.apparent_lambda[0] < 0.0;
        point = {.detuning_lambda = curve.detuning_lambda[0], .slope = at_end ? 0.0 : curve.slope[0]};
    } else if (x < curve.apparent_lambda[last]) {
        point = within(curve, place(curve, x), x);
    }
    if (mirrored) point.detuning_lambda = -point.detuning_lambda;
    return point;
}

double slope_behind(const DiscriminatorCurve& curve, double detuning_lambda) noexcept {
    if (curve.n_nodes == 0 || !is_finite(detuning_lambda)) return 1.0;
    const bool mirrored = detuning_lambda < 0.0 && !(curve.detuning_lambda[0] < 0.0);
    const double y = mirrored ? -detuning_lambda : detuning_lambda;
    const auto last = static_cast<std::size_t>(curve.n_nodes - 1);
    std::size_t k = 0;
    while (k + 1 < last && curve.detuning_lambda[k + 1] <= y) ++k;
    return piece(curve, k).width > 0.0 ? piece(curve, k).step : 1.0;
}

TrueMoments true_moments(const DiscriminatorCurve& curve, double mean_lambda, double mean_sq_lambda2,
                         double noise_sq_lambda2) noexcept {
    if (curve.n_nodes == 0) return {.mean_lambda = mean_lambda, .mean_sq_lambda2 = mean_sq_lambda2};
    const double spread_sq = mean_sq_lambda2 - mean_lambda * mean_lambda - noise_sq_lambda2;
    const double spread = spread_sq > 0.0 ? square_root(spread_sq) : 0.0;
    // What the noise of this half leaves below its expectation stays, so that the mean of many halves is the true one.
    const double below_noise_sq = spread_sq > 0.0 ? 0.0 : spread_sq;
    const double above = true_detuning(curve, mean_lambda + spread).detuning_lambda;
    const double below = true_detuning(curve, mean_lambda - spread).detuning_lambda;
    const double slope = true_detuning(curve, mean_lambda).slope;
    return {
        .mean_lambda = 0.5 * (above + below),
        .mean_sq_lambda2 = 0.5 * (above * above + below * below) + slope * slope * (noise_sq_lambda2 + below_noise_sq),
        .slope = slope};
}

}  // namespace zlg::core
