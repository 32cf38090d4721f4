#include "bound.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Dense>

#include "synthetic/motion.hpp"
#include "synthetic/relock_decay.hpp"

namespace zlg::trials {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int closed_halves = 2 * bound_ticks;  // observed before the gap, and from closing on

// Knots in ticks from closing on, the outer ones repeated so that the basis is complete at the ends.
VectorXd spline_knots(int lit_halves) {
    const double start = -0.5 * lit_halves;
    std::vector<double> knots{start, start, start};
    for (int k = -lit_halves; k <= 12; ++k) knots.push_back(0.5 * k);
    knots.insert(knots.end(), {7.0, 8.0, 8.0, 8.0, 8.0});
    return Eigen::Map<VectorXd>(knots.data(), static_cast<Eigen::Index>(knots.size()));
}

// Values of all cubic B-splines at t, by the recursion of Cox and de Boor (de Boor, A Practical Guide to Splines, 1978,
// ch. X).
VectorXd splines_at(const VectorXd& knots, double t) {
    VectorXd b = VectorXd::Zero(knots.size() - 1);
    for (Eigen::Index i = 0; i < b.size(); ++i) b[i] = t >= knots[i] && t < knots[i + 1] ? 1.0 : 0.0;
    for (Eigen::Index degree = 1; degree <= 3; ++degree) {
        VectorXd next = VectorXd::Zero(b.size() - 1);
        for (Eigen::Index i = 0; i < next.size(); ++i) {
            const double rise = knots[i + degree] - knots[i];
            const double fall = knots[i + degree + 1] - knots[i + 1];
            if (rise > 0.0) next[i] += (t - knots[i]) / rise * b[i];
            if (fall > 0.0) next[i] += (knots[i + degree + 1] - t) / fall * b[i + 1];
        }
        b = next;
    }
    return b;
}

// Covariance of the false angles of the lit halves of the gap and of those after it, by the light. The Fisher
// information of the samples on the spline's coefficients a is I = sum b b'/sigma^2; the false angle of a half is chi
// f0 K integral (b'a)^2 dt, with the derivative S by a at the true decay: S I^-1 S'.
MatrixXd false_angle_covariance(const GyroLaw& g) {
    const VectorXd knots = spline_knots(g.lit_halves);
    const Eigen::Index n = knots.size() - 4;
    const int lit = g.lit_halves + closed_halves;
    MatrixXd information = MatrixXd::Zero(n, n);
    MatrixXd slope = MatrixXd::Zero(lit, n);
    constexpr int pieces = 200;  // of a half, by the midpoint rule
    const double gain = g.chi * g.bias_hz * g.scale_arcsec * 0.5 * g.tick_s;
    for (int k = 0; k < lit; ++k) {
        const int half = k - g.lit_halves;  // from closing on
        for (int j = 0; j < g.light_samples; ++j) {
            const VectorXd b = splines_at(knots, 0.5 * (half + (j + 0.5) / g.light_samples));
            information += b * b.transpose() / (g.light_noise_lambda * g.light_noise_lambda);
        }
        for (int j = 0; j < pieces; ++j) {
            const double t = 0.5 * (half + (j + 0.5) / pieces);
            slope.row(k) += 2.0 * gain / pieces * g.miss_lambda * detuning_ratio(g.loop, std::max(0.0, t)) *
                            splines_at(knots, t).transpose();
        }
    }
    return slope * information.ldlt().solve(slope.transpose());
}

// x: first the rotation of the halves, then the roundings at their edges, then the errors of the false angles.
struct LinearModel {
    MatrixXd covariance;  // C
    MatrixXd observed;    // H
    VectorXd target;      // c
};

// Variance of one reading of the counter, or of the place within the fringe by photodiodes.
double reading_counts2(const GyroLaw& g) {
    if (!g.photodiodes.reads) return 1.0 / 12.0;
    const double step = std::ldexp(4.0, -g.photodiodes.adc_bits);
    const double radius = g.photodiodes.noise * g.photodiodes.noise + step * step / 12.0;
    return radius / (4.0 * std::numbers::pi * std::numbers::pi);
}

// Where the parts of x begin.
struct Layout {
    explicit Layout(const GyroLaw& g)
        : halves{2 * closed_halves + 2 * g.gap_ticks},
          dark{2 * g.gap_ticks - g.lit_halves},
          lit{g.lit_halves + closed_halves},
          edges{halves + 1} {}

    int halves;
    int dark;  // the halves of the gap that nobody observes
    int lit;   // the observed halves after them
    int edges;
    [[nodiscard]] int false_angles() const { return halves + edges; }
    [[nodiscard]] int all() const { return halves + edges + lit; }
};

MatrixXd covariance_of(const GyroLaw& g, const MotionLaw& motion, const Layout& at) {
    constexpr double unknown_arcsec_s = 1e5;  // far above any rate, yet small enough to keep C well conditioned
    MatrixXd covariance = MatrixXd::Zero(at.all(), at.all());
    const double half_s = 0.5 * g.tick_s;
    const auto lags = increment_covariance(motion, half_s, static_cast<std::size_t>(at.halves));
    const double constant = unknown_arcsec_s * half_s * unknown_arcsec_s * half_s;
    for (int i = 0; i < at.halves; ++i)
        for (int j = 0; j < at.halves; ++j)
            covariance(i, j) = lags[static_cast<std::size_t>(std::abs(i - j))] + constant;
    const double rounding = g.scale_arcsec * g.scale_arcsec * reading_counts2(g);
    covariance.block(at.halves, at.halves, at.edges, at.edges).diagonal().setConstant(rounding);
    covariance.bottomRightCorner(at.lit, at.lit) = false_angle_covariance(g);
    return covariance;
}

LinearModel model_of(const GyroLaw& g, const MotionLaw& motion) {
    const Layout at{g};
    LinearModel m{.covariance = covariance_of(g, motion, at),
                  .observed = MatrixXd::Zero(closed_halves + at.lit, at.all()),
                  .target = VectorXd::Zero(at.all())};
    for (int row = 0; row < closed_halves + at.lit; ++row) {
        const int after = row - closed_halves;
        const int h = after < 0 ? row : row + at.dark;
        m.observed(row, h) = 1.0;
        m.observed(row, at.halves + h + 1) = 1.0;
        m.observed(row, at.halves + h) = -1.0;
        if (after < 0) continue;
        const double sign = h % 2 == 0 ? 1.0 : -1.0;
        m.observed(row, at.false_angles() + after) = sign;
        m.target[at.false_angles() + after] = -sign;
    }
    m.target.segment(closed_halves, at.dark).setOnes();
    m.target[at.halves + closed_halves] = -1.0;
    m.target[at.halves + closed_halves + at.dark] = 1.0;
    return m;
}

double min_error(const LinearModel& m, const MatrixXd& observed) {
    MatrixXd of_observed = observed * m.covariance * observed.transpose();
    const VectorXd with_target = observed * m.covariance * m.target;
    const double variance = m.target.dot(m.covariance * m.target);
    return std::sqrt(std::max(0.0, variance - with_target.dot(of_observed.ldlt().solve(with_target))));
}

MatrixXd pairs_of(const MatrixXd& halves) {
    MatrixXd ticks{halves.rows() / 2, halves.cols()};
    for (Eigen::Index i = 0; i < ticks.rows(); ++i) ticks.row(i) = halves.row(2 * i) + halves.row(2 * i + 1);
    return ticks;
}

double alternating_sum_sigma(const MatrixXd& covariance) {
    VectorXd s{covariance.rows()};
    for (Eigen::Index i = 0; i < s.size(); ++i) s[i] = i % 2 == 0 ? 1.0 : -1.0;
    return std::sqrt(s.dot(covariance * s));
}

}  // namespace

SwitchBound bound_of(const GyroLaw& gyro, const MotionLaw& motion) {
    GyroLaw unlit = gyro;
    unlit.lit_halves = 0;
    const LinearModel ticks = model_of(unlit, motion);
    const LinearModel halves = model_of(gyro, motion);
    return {.ticks_arcsec = min_error(ticks, pairs_of(ticks.observed)),
            .halves_arcsec = min_error(halves, halves.observed),
            .relock_arcsec = alternating_sum_sigma(false_angle_covariance(unlit))};
}

}  // namespace zlg::trials
