#include "accuracy_bound.hpp"

#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "accuracy_loop.hpp"
#include "accuracy_motion.hpp"

namespace zlg::trials {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int seen_halves = 2 * bound_ticks;  // on each side

// Knots in ticks, the outer ones repeated so that the basis is complete at the ends.
VectorXd spline_knots() {
    std::vector<double> knots{0.0, 0.0, 0.0};
    for (int k = 0; k <= 12; ++k) knots.push_back(0.5 * k);
    knots.insert(knots.end(), {7.0, 8.0, 8.0, 8.0, 8.0});
    return Eigen::Map<VectorXd>(knots.data(), static_cast<Eigen::Index>(knots.size()));
}

// Values of all cubic B-splines at t, by the recursion of Cox and de Boor.
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

// Covariance of the false angles of the halves after the gap, by the light: the information of all samples on the
// spline's coefficients, carried to chi f0 K integral dl^2 dt of each half at the true course of the loop.
MatrixXd false_angle_covariance(const GyroLaw& g) {
    const VectorXd knots = spline_knots();
    const Eigen::Index n = knots.size() - 4;
    MatrixXd information = MatrixXd::Zero(n, n);
    MatrixXd slope = MatrixXd::Zero(seen_halves, n);
    constexpr int pieces = 200;
    const double gain = g.chi * g.bias_hz * g.scale_arcsec * 0.5 * g.tick_s;
    for (int k = 0; k < seen_halves; ++k) {
        for (int j = 0; j < g.light_samples; ++j) {
            const VectorXd b = splines_at(knots, 0.5 * (k + (j + 0.5) / g.light_samples));
            information += b * b.transpose() / (g.light_noise_lambda * g.light_noise_lambda);
        }
        for (int j = 0; j < pieces; ++j) {
            const double t = 0.5 * (k + (j + 0.5) / pieces);
            slope.row(k) +=
                2.0 * gain / pieces * g.miss_lambda * detuning_ratio(g.loop, t) * splines_at(knots, t).transpose();
        }
    }
    return slope * information.ldlt().solve(slope.transpose());
}

// All that a switch depends on, and how readings and target are made of it: halves of motion, edges, false angles.
struct LinearModel {
    MatrixXd covariance;
    MatrixXd seen;
    VectorXd target;
};

// Where the parts of a model begin.
struct Layout {
    explicit Layout(const GyroLaw& g)
        : halves{2 * seen_halves + 2 * g.gap_ticks}, gap_halves{2 * g.gap_ticks}, edges{halves + 1} {}

    int halves;
    int gap_halves;
    int edges;
    [[nodiscard]] int false_angles() const { return halves + edges; }
    [[nodiscard]] int all() const { return halves + edges + seen_halves; }
};

MatrixXd covariance_of(const GyroLaw& g, const MotionLaw& motion, double constant_arcsec_s, const Layout& at) {
    MatrixXd covariance = MatrixXd::Zero(at.all(), at.all());
    const double half_s = 0.5 * g.tick_s;
    const auto lags = increment_covariance(motion, half_s, static_cast<std::size_t>(at.halves));
    const double constant = constant_arcsec_s * half_s * constant_arcsec_s * half_s;
    for (int i = 0; i < at.halves; ++i)
        for (int j = 0; j < at.halves; ++j)
            covariance(i, j) = lags[static_cast<std::size_t>(std::abs(i - j))] + constant;
    const double rounding = g.scale_arcsec * g.scale_arcsec / 12.0;
    covariance.block(at.halves, at.halves, at.edges, at.edges).diagonal().setConstant(rounding);
    covariance.bottomRightCorner(seen_halves, seen_halves) = false_angle_covariance(g);
    return covariance;
}

LinearModel model_of(const GyroLaw& g, const MotionLaw& motion, double constant_arcsec_s) {
    const Layout at{g};
    LinearModel m{.covariance = covariance_of(g, motion, constant_arcsec_s, at),
                  .seen = MatrixXd::Zero(2 * seen_halves, at.all()),
                  .target = VectorXd::Zero(at.all())};
    for (int row = 0; row < 2 * seen_halves; ++row) {
        const int after = row - seen_halves;
        const int h = after < 0 ? row : row + at.gap_halves;
        m.seen(row, h) = 1.0;
        m.seen(row, at.halves + h + 1) = 1.0;
        m.seen(row, at.halves + h) = -1.0;
        if (after < 0) continue;
        const double sign = after % 2 == 0 ? 1.0 : -1.0;
        m.seen(row, at.false_angles() + after) = sign;
        m.target[at.false_angles() + after] = -sign;
    }
    m.target.segment(seen_halves, at.gap_halves).setOnes();
    m.target[at.halves + seen_halves] = -1.0;
    m.target[at.halves + seen_halves + at.gap_halves] = 1.0;
    return m;
}

double min_error(const LinearModel& m, const MatrixXd& seen) {
    MatrixXd of_seen = seen * m.covariance * seen.transpose();
    const VectorXd with_target = seen * m.covariance * m.target;
    const double variance = m.target.dot(m.covariance * m.target);
    return std::sqrt(std::max(0.0, variance - with_target.dot(of_seen.ldlt().solve(with_target))));
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
    constexpr double unknown_arcsec_s = 1e5;
    const LinearModel free_rate = model_of(gyro, motion, unknown_arcsec_s);
    const LinearModel known_rate = model_of(gyro, motion, 0.0);
    return {.ticks_arcsec = min_error(free_rate, pairs_of(free_rate.seen)),
            .halves_arcsec = min_error(free_rate, free_rate.seen),
            .known_rate_arcsec = min_error(known_rate, known_rate.seen),
            .relock_arcsec = alternating_sum_sigma(false_angle_covariance(gyro))};
}

}  // namespace zlg::trials
