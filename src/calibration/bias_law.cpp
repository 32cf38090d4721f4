#include <zlg/calibration/bias_law.hpp>

#include <algorithm>
#include <cmath>

#include <vector>

#include <Eigen/Core>
#include <Eigen/Dense>
#include <zlg/numeric/estimate.hpp>

#include "pieces.hpp"

namespace zlg::calibration {
namespace {

// Weighted least squares whose standard errors come from the scatter of the observations, each for itself.
//
// The expected variances set the weights and need be right only roughly: the covariance is that of White
// (Econometrica 48, 1980), each squared residual divided by 1 - leverage (HC2 of MacKinnon and White, J. Econometrics
// 29, 1985). Where few observations decide, the standard error is widened by as many degrees of freedom as they are
// (Satterthwaite).
class ScatterRegression {
public:
    // One row of laws and one expected variance for each value.
    ScatterRegression(const Eigen::MatrixXd& laws, const Eigen::VectorXd& values, const Eigen::VectorXd& expected);

    [[nodiscard]] const Eigen::VectorXd& coefficient() const { return coefficient_; }
    // Of the sum of the coefficients with these weights.
    [[nodiscard]] double sigma(const Eigen::VectorXd& weights) const;

private:
    Eigen::VectorXd coefficient_;
    Eigen::MatrixXd influence_;  // of each value on each coefficient
    Eigen::VectorXd variance_;   // of each value, from its residual
    Eigen::VectorXd expected_;
};

ScatterRegression::ScatterRegression(const Eigen::MatrixXd& laws, const Eigen::VectorXd& values,
                                     const Eigen::VectorXd& expected)
    : expected_{expected} {
    const Eigen::MatrixXd weighted = expected.cwiseInverse().asDiagonal() * laws;
    influence_ = (laws.transpose() * weighted).ldlt().solve(weighted.transpose());
    coefficient_ = influence_ * values;
    const Eigen::VectorXd residual = values - laws * coefficient_;
    variance_.resize(values.size());
    for (Eigen::Index k = 0; k < values.size(); ++k) {
        const double leverage = laws.row(k).dot(influence_.col(k));
        variance_[k] = residual[k] * residual[k] / std::fmax(1.0 - leverage, 1e-6);
    }
}

double ScatterRegression::sigma(const Eigen::VectorXd& weights) const {
    const Eigen::ArrayXd share = (influence_.transpose() * weights).array().square();
    const double variance = (share * variance_.array()).sum();
    const Eigen::ArrayXd part = share * expected_.array();
    const double deciding = part.sum() * part.sum() / part.square().sum();
    return numeric::widened(std::sqrt(variance), deciding - static_cast<double>(weights.size()));
}

// Fewer readings do not tell their scatter. The settled record is cut so finely that it gives about `many_readings` of
// them, if its segments are longer than that.
constexpr std::int64_t min_readings = 8;
constexpr double many_readings = 40.0;

// The mean difference of a segment, or of a part of one where there are few segments: the counter begins each of them
// at a phase of its own.
struct Reading {
    double difference_counts = 0.0;  // mean over the halves
    double temperature_c = 0.0;
    double sweep_counts = 0.0;  // by how many counts the angle went on meanwhile
};

// Mean counts a second of the neighbours of piece k in the same log and mode. Whether the counter happened to step in a
// piece is bound up with how it was rounded there, so a piece must not decide its own weight.
double turning_counts_s(const std::vector<Piece>& pieces, std::size_t k) {
    constexpr std::size_t either_side = 20;
    double counts = 0.0;
    double length_s = 0.0;
    for (std::size_t n = k > either_side ? k - either_side : 0; n < std::min(pieces.size(), k + either_side + 1); ++n) {
        if (n == k || pieces[n].mode != pieces[k].mode || pieces[n].log != pieces[k].log) continue;
        counts += pieces[n].counts;
        length_s += pieces[n].length_s;
    }
    return length_s > 0.0 ? std::abs(counts) / length_s : 0.0;
}

std::vector<Reading> readings_of(std::span<const LabLog> logs) {
    const std::vector<Piece> pieces = pieces_of(logs, settled_s(logs) / many_readings);
    std::vector<Reading> readings;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        const Piece& p = pieces[k];
        const double halves = 2.0 * p.length_s / logs[p.log].tick_s;
        readings.push_back({p.difference / halves, p.temperature_c, turning_counts_s(pieces, k) * p.length_s});
    }
    return readings;
}

// Expected variance of the mean difference. Where the angle stands, the counter rounds alike in every tick, with
// 1/6 count^2. Where it goes on by m counts, the rounding runs through its period and leaves 1/(360 m^2). From 1.5
// counts on the random walk is the larger part, and the variance falls no further.
double expected_counts2(const Reading& r) {
    const double sweep = std::fmin(r.sweep_counts, 1.5);
    return 1.0 / (6.0 * (1.0 + 60.0 * sweep * sweep));
}

// Where the counter shows one and the same number throughout, the scatter is 0 and tells nothing. f0 is then known to
// about one count over the number of chances to show another: one a reading, and one for each count that the angle has
// passed.
double resolution_counts(const std::vector<Reading>& readings) {
    double chances = 2.0;
    for (const Reading& r : readings) chances += 1.0 + r.sweep_counts;
    return 1.0 / std::sqrt(12.0) / chances;
}

struct Columns {
    Eigen::MatrixXd laws;      // one column a parameter, to be filled
    Eigen::VectorXd counts;    // measured
    Eigen::VectorXd expected;  // variance of each

    Columns(const std::vector<Reading>& readings, Eigen::Index n_laws)
        : laws(std::ssize(readings), n_laws), counts(laws.rows()), expected(laws.rows()) {
        for (Eigen::Index k = 0; k < laws.rows(); ++k) {
            counts[k] = readings[static_cast<std::size_t>(k)].difference_counts;
            expected[k] = expected_counts2(readings[static_cast<std::size_t>(k)]);
        }
    }
};

Moments temperatures(const std::vector<Reading>& readings) {
    Moments m;
    for (const Reading& r : readings) m.add(r.temperature_c);
    return m;
}

// Mean frequency, brought to the reference temperature with the presumed coefficient.
void fit_mean(const std::vector<Reading>& readings, double hz_per_count, double presumed_per_c, BiasLaw& law) {
    Columns columns{readings, 1};
    for (Eigen::Index k = 0; k < columns.laws.rows(); ++k) {
        const double above_c = readings[static_cast<std::size_t>(k)].temperature_c - law.reference_temperature_c;
        columns.laws(k, 0) = std::isfinite(above_c) ? 1.0 + presumed_per_c * above_c : 1.0;
    }
    const ScatterRegression fit{columns.laws, columns.counts, columns.expected};
    const double sigma_counts = std::fmax(fit.sigma(Eigen::VectorXd::Ones(1)), resolution_counts(readings));
    law.bias_hz = numeric::estimated(hz_per_count * fit.coefficient()[0], hz_per_count * sigma_counts);
    law.coefficient_taken_per_c = presumed_per_c;
}

//   f = b0 + b1 (T - mean),  f0 = b0 - b1 (mean - ref),  alpha = b1/f0
void fit_law(const std::vector<Reading>& readings, double hz_per_count, BiasLaw& law) {
    const Moments t = temperatures(readings);
    Columns columns{readings, 2};
    for (Eigen::Index k = 0; k < columns.laws.rows(); ++k) {
        columns.laws(k, 0) = 1.0;
        columns.laws(k, 1) = readings[static_cast<std::size_t>(k)].temperature_c - t.mean;
    }
    const ScatterRegression fit{columns.laws, columns.counts, columns.expected};
    const double to_reference_c = law.reference_temperature_c - t.mean;
    const double f0_counts = fit.coefficient()[0] + fit.coefficient()[1] * to_reference_c;
    const double alpha = fit.coefficient()[1] / f0_counts;
    const double f0_sigma = fit.sigma(Eigen::Vector2d(1.0, to_reference_c));
    const double alpha_sigma = fit.sigma(Eigen::Vector2d(-alpha, 1.0 - alpha * to_reference_c)) / f0_counts;
    const double resolution = resolution_counts(readings);
    const double alpha_resolution = resolution / f0_counts / std::sqrt(t.variance());
    law.bias_hz = numeric::estimated(hz_per_count * f0_counts, hz_per_count * std::fmax(f0_sigma, resolution));
    law.temperature_coefficient_per_c = numeric::estimated(alpha, std::fmax(std::abs(alpha_sigma), alpha_resolution));
    law.coefficient_taken_per_c = alpha;
}

// rms of the readings about the law, each over its expected standard deviation.
double scatter_ratio(const std::vector<Reading>& readings, const BiasLaw& law, double hz_per_count) {
    double sum = 0.0;
    for (const Reading& r : readings) {
        const double off_counts = r.difference_counts - law.at_hz(r.temperature_c) / hz_per_count;
        sum += off_counts * off_counts / expected_counts2(r);
    }
    return std::sqrt(sum / static_cast<double>(law.dof));
}

// A gyro that is shaken or walks reaches 4.
constexpr double max_scatter_ratio = 100.0;

// Of counts that do not follow bias_sign * mode one log in four shows a bias of more than its error, one in a million
// of five times that.
constexpr double least_deviations = 5.0;

// Why counts, mode and bias_sign make no bias together; empty where they do.
std::string contradiction_of(const BiasLaw& law) {
    const auto& [determined, value, sigma, reason] = law.bias_hz;
    if (!(std::abs(value) > least_deviations * sigma))
        return fmt::format("it comes out as {:.3g} +- {:.3g} Hz: the counts do not follow bias_sign * mode", value,
                           sigma);
    if (!(value > 0.0))
        return fmt::format("it comes out as {:.6g} Hz: bias_sign or mode of the logs has the other sign", value);
    if (!(law.scatter_ratio <= max_scatter_ratio))
        return fmt::format(
            "the segments scatter by {:.3g} times what rounding leaves, allowed is up to {:g}: counts, "
            "mode or bias_sign are wrong in a part of the logs",
            law.scatter_ratio, max_scatter_ratio);
    return {};
}

}  // namespace

double BiasLaw::at_hz(double temperature_c) const {
    const double above_c = temperature_c - reference_temperature_c;
    return bias_hz.value * (std::isfinite(above_c) ? 1.0 + coefficient_taken_per_c * above_c : 1.0);
}

BiasLaw find_bias_law(std::span<const LabLog> logs, double reference_temperature_c, double presumed_per_c) {
    BiasLaw law{.reference_temperature_c = reference_temperature_c};
    const std::vector<Reading> readings = readings_of(logs);
    if (std::ssize(readings) < min_readings) {
        law.bias_hz =
            numeric::refused(fmt::format("{} stretches of settled record; {} or more are needed ({} ticks after each "
                                         "re-lock do not count)",
                                         readings.size(), min_readings, settled_after_ticks));
        law.temperature_coefficient_per_c = law.bias_hz;
        return law;
    }
    const double hz_per_count = 2.0 / logs.front().tick_s;
    const std::string too_few = too_few_temperatures(logs);
    law.dof = std::ssize(readings) - (too_few.empty() ? 2 : 1);
    if (too_few.empty()) {
        fit_law(readings, hz_per_count, law);
    } else {
        law.temperature_coefficient_per_c = numeric::refused(too_few);
        fit_mean(readings, hz_per_count, presumed_per_c, law);
    }
    if (!law.bias_hz.determined)
        law.bias_hz =
            numeric::refused(fmt::format("too few of {} stretches of settled record decide: in the others the counter "
                                         "hardly turns; a longer record, or a known rate, would tell",
                                         readings.size()));
    if (!law.bias_hz.determined) return law;
    law.scatter_ratio = scatter_ratio(readings, law, hz_per_count);
    if (const std::string contradiction = contradiction_of(law); !contradiction.empty()) {
        law.contradicts = true;
        law.bias_hz = numeric::refused(contradiction);
        law.temperature_coefficient_per_c = numeric::refused("the bias frequency is not determined");
    }
    return law;
}

}  // namespace zlg::calibration
