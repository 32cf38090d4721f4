#include "noise_likelihood.hpp"

#include <algorithm>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace zlg::noise {
namespace {

// The search ends where a step gains less than `min_gain`, far below the 6.6 that one more term must gain
// (noise_selection.cpp); max_steps is a guard. No parameter changes by more than a factor e^2 in a step, so that the
// first steps do not leap to where the likelihood is flat.
constexpr int max_steps = 60;
constexpr double min_gain = 1e-7;     // of the objective
constexpr double max_log_step = 2.0;  // of a logarithm
// Least eigenvalue that the correlation matrix is given; all are 1 where the variances are independent.
constexpr double min_eigenvalue = 1e-3;

// Standard deviation of (V/E)^(1/3), sqrt(2/(9 nu)).
Eigen::ArrayXd cube_root_sigma(const MeasuredVariances& v) { return (2.0 / (9.0 * v.freedom.array())).sqrt(); }

// A set of coefficients and all that follows from it.
struct State {
    Eigen::VectorXd coefficient;
    double log_time = 0.0;
    Eigen::MatrixXd columns;
    Eigen::VectorXd expected;
    Eigen::VectorXd root;      // (V/E)^(1/3)
    Eigen::VectorXd whitened;  // W z
    double objective = 0.0;
};

class Likelihood {
public:
    Likelihood(const MeasuredVariances& v, const Eigen::MatrixXd& columns, const TimedColumn& timed)
        : v_(v), columns_(columns), timed_(timed) {}

    [[nodiscard]] Eigen::MatrixXd all_columns(double log_time) const {
        if (!timed_.at) return columns_;
        Eigen::MatrixXd all(v_.value.size(), columns_.cols() + 1);
        all << columns_, timed_.at(log_time);
        return all;
    }

    [[nodiscard]] State at(const Eigen::VectorXd& coefficient, double log_time) const {
        State now{.coefficient = coefficient, .log_time = log_time, .columns = all_columns(log_time)};
        now.expected = now.columns * coefficient;
        now.root = (v_.value.array() / now.expected.array()).pow(1.0 / 3.0);
        const Eigen::ArrayXd s = cube_root_sigma(v_);
        now.whitened = v_.whitening * ((now.root.array() - 1.0 + s * s) / s).matrix();
        now.objective = now.whitened.squaredNorm() + 2.0 / 3.0 * now.expected.array().log().sum();
        return now;
    }

    // Each term as large as it can be while it stays, by itself, under half of every measured variance.
    [[nodiscard]] State start() const {
        const Eigen::MatrixXd columns = all_columns(timed_.log_time);
        Eigen::VectorXd coefficient(columns.cols());
        for (Eigen::Index k = 0; k < columns.cols(); ++k)
            coefficient[k] = 0.5 * (v_.value.array() / columns.col(k).array()).minCoeff();
        return at(coefficient, timed_.log_time);
    }

    // Derivatives of the logarithms of the expected variances by the parameters, which are the logarithms of the
    // coefficients and of the time.
    [[nodiscard]] Eigen::MatrixXd shares(const State& now) const {
        Eigen::MatrixXd share = now.expected.cwiseInverse().asDiagonal() * now.columns * now.coefficient.asDiagonal();
        if (!timed_.at) return share;
        constexpr double step = 1e-3;  // of the logarithm, for a central difference
        const Eigen::VectorXd slope = (timed_.at(now.log_time + step) - timed_.at(now.log_time - step)) / (2.0 * step);
        share.conservativeResize(Eigen::NoChange, share.cols() + 1);
        share.rightCols<1>() = now.coefficient.tail<1>()[0] * slope.cwiseQuotient(now.expected);
        return share;
    }

    // Fisher information of the parameters; that of one measured variance on the logarithm of its expectation is nu/2.
    [[nodiscard]] Eigen::MatrixXd information(const Eigen::MatrixXd& share) const {
        const Eigen::MatrixXd j = v_.whitening * (v_.freedom.array() / 2.0).sqrt().matrix().asDiagonal() * share;
        return j.transpose() * j;
    }

    // Of the objective. `by_log` is its derivative by log E: that of z^T R^-1 z, where d (V/E)^(1/3)/d log E =
    // -(V/E)^(1/3)/3, and the 2/3 of each logarithm.
    [[nodiscard]] Eigen::VectorXd gradient(const Eigen::MatrixXd& share, const State& now) const {
        const Eigen::VectorXd pull = v_.whitening.transpose() * now.whitened;
        const Eigen::ArrayXd by_log = -2.0 / 3.0 * now.root.array() / cube_root_sigma(v_) * pull.array() + 2.0 / 3.0;
        return share.transpose() * by_log.matrix();
    }

    [[nodiscard]] State moved(const State& now, Eigen::VectorXd move) const {
        const double length = move.cwiseAbs().maxCoeff();
        if (length > max_log_step) move *= max_log_step / length;
        const Eigen::VectorXd coefficient = now.coefficient.array() * move.head(now.coefficient.size()).array().exp();
        double log_time = now.log_time;
        if (timed_.at) log_time = std::clamp(log_time + move.tail<1>()[0], timed_.low, timed_.high);
        return at(coefficient, log_time);
    }

private:
    const MeasuredVariances& v_;
    const Eigen::MatrixXd& columns_;
    const TimedColumn& timed_;
};

// Of the coefficients themselves, and of the logarithm of the time. A coefficient that has gone to zero has the error
// that its column allows, which its logarithm does not know. 1e-12 keeps the matrix regular, here and in the search.
Eigen::MatrixXd covariance(const Likelihood& likelihood, const State& now, const Eigen::MatrixXd& share) {
    Eigen::MatrixXd by = share;
    by.leftCols(now.columns.cols()) = now.expected.cwiseInverse().asDiagonal() * now.columns;
    const Eigen::MatrixXd information = likelihood.information(by);
    const Eigen::VectorXd scale = information.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    Eigen::MatrixXd scaled = scale.asDiagonal() * information * scale.asDiagonal();
    scaled.diagonal().array() += 1e-12;
    return scale.asDiagonal() * scaled.ldlt().solve(Eigen::MatrixXd::Identity(by.cols(), by.cols())) *
           scale.asDiagonal();
}

}  // namespace

void set_scatter(const Eigen::MatrixXd& relative, MeasuredVariances& variances) {
    const Eigen::VectorXd deviation = relative.diagonal().cwiseSqrt();
    variances.freedom = 2.0 * relative.diagonal().cwiseInverse();
    const Eigen::MatrixXd correlation =
        deviation.cwiseInverse().asDiagonal() * relative * deviation.cwiseInverse().asDiagonal();
    // Where far neighbours were left out the matrix may miss being positive by a little.
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(correlation);
    const Eigen::VectorXd value = parts.eigenvalues().cwiseMax(min_eigenvalue);
    variances.whitening = value.cwiseSqrt().cwiseInverse().asDiagonal() * parts.eigenvectors().transpose();
}

TermFit fit_terms(const MeasuredVariances& v, const Eigen::MatrixXd& columns, const TimedColumn& timed) {
    const Likelihood likelihood(v, columns, timed);
    State now = likelihood.start();
    Eigen::MatrixXd share = likelihood.shares(now);
    double damping = 1e-3;  // Marquardt's: tenfold after a step without gain, a tenth after one with gain
    for (int step = 0; step < max_steps && damping < 1e8; ++step) {
        Eigen::MatrixXd information = likelihood.information(share);
        information.diagonal() += (damping * information.diagonal().array() + 1e-12).matrix();
        State trial = likelihood.moved(now, information.ldlt().solve(-0.5 * likelihood.gradient(share, now)));
        if (!(trial.objective <= now.objective)) {
            damping *= 10.0;
            continue;
        }
        const double gain = now.objective - trial.objective;
        now = std::move(trial);
        share = likelihood.shares(now);
        damping = std::max(1e-9, 0.1 * damping);
        if (gain < min_gain) break;
    }
    return {.coefficient = now.coefficient,
            .log_time = now.log_time,
            .expected = now.expected,
            .covariance = covariance(likelihood, now, share),
            .objective = now.objective,
            .chi2 = now.whitened.squaredNorm()};
}

}  // namespace zlg::noise
