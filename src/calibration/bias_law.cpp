#include <zlg/calibration/bias_law.hpp>

#include <algorithm>
#include <cmath>

#include <vector>

#include <Eigen/Core>
#include <zlg/numeric/estimate.hpp>

#include "pieces.hpp"
#include "scatter_regression.hpp"

namespace zlg::calibration {
namespace {

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

// What knot j has of the value at a temperature.
double share_of_knot(const BiasTable& table, std::size_t j, double temperature_c) {
    const auto at_c = [&](std::size_t k) { return table.knots[k][0]; };
    if (j > 0 && temperature_c < at_c(j))
        return std::fmax(0.0, (temperature_c - at_c(j - 1)) / (at_c(j) - at_c(j - 1)));
    const bool is_below = j + 1 < table.knots.size() && temperature_c > at_c(j);
    return is_below ? std::fmax(0.0, (at_c(j + 1) - temperature_c) / (at_c(j + 1) - at_c(j))) : 1.0;
}

// Least squares on a course that is straight between knots with as many readings between two; empty where two knots are
// the same to a hundredth of the span, or one has too few readings to tell its error.
BiasTable fit_table(const std::vector<Reading>& readings, std::size_t n_knots, double counts_at_reference) {
    std::vector<double> all_c;
    for (const Reading& r : readings) all_c.push_back(r.temperature_c);
    std::sort(all_c.begin(), all_c.end());
    BiasTable table;
    for (std::size_t j = 0; j < n_knots; ++j)
        table.knots.push_back({all_c[j * (all_c.size() - 1) / (n_knots - 1)], 0.0});
    for (std::size_t j = 1; j < n_knots; ++j)
        if (!(table.knots[j][0] - table.knots[j - 1][0] > 0.01 * (all_c.back() - all_c.front()))) return {};
    Columns columns{readings, static_cast<Eigen::Index>(n_knots)};
    for (std::size_t k = 0; k < readings.size(); ++k)
        for (std::size_t j = 0; j < n_knots; ++j)
            columns.laws(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)) =
                share_of_knot(table, j, readings[k].temperature_c);
    const ScatterRegression fit{columns.laws, columns.counts, columns.expected};
    for (Eigen::Index j = 0; j < columns.laws.cols(); ++j) {
        // The readings between two knots tell no others.
        const double sigma = fit.sigma(Eigen::VectorXd::Unit(columns.laws.cols(), j), 2.0);
        if (!std::isfinite(sigma)) return {};
        table.knots[static_cast<std::size_t>(j)][1] = fit.coefficient()[j] / counts_at_reference - 1.0;
        table.sigma.push_back(std::fmax(sigma, resolution_counts(readings)) / counts_at_reference);
    }
    return table;
}

// Each interval is halved as long as a knot leaves the coarser course, first the line, by more than its errors. Of a
// smooth bend a course that is straight between its knots misses a third of that step, for each halving leaves a
// quarter.
BiasTable find_table(const std::vector<Reading>& readings, double hz_per_count, BiasLaw course) {
    constexpr double least_sigmas = 4.0;
    constexpr std::size_t least_knots = 3, enough_knots = 5, most_knots = 33;
    bool bends = true;
    for (std::size_t n = least_knots; n <= most_knots && (n <= enough_knots || bends); n = 2 * n - 1) {
        BiasTable finer = fit_table(readings, n, course.bias_hz.value / hz_per_count);
        if (finer.knots.empty()) break;
        bends = false;
        for (std::size_t k = 0; k < n; ++k) {
            const double before = course.at_hz(finer.knots[k][0]) / course.bias_hz.value - 1.0;
            const double step = std::abs(finer.knots[k][1] - before);
            bends |= step > least_sigmas * finer.sigma[k];
            finer.sigma[k] = std::hypot(finer.sigma[k], step / 3.0);
        }
        if (bends || !course.table.knots.empty()) course.table = std::move(finer);
    }
    return course.table;
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
    if (!table.knots.empty() && std::isfinite(temperature_c)) {
        double ratio = 1.0;
        for (std::size_t j = 0; j < table.knots.size(); ++j)
            ratio += share_of_knot(table, j, temperature_c) * table.knots[j][1];
        return bias_hz.value * ratio;
    }
    const double above_c = temperature_c - reference_temperature_c;
    return bias_hz.value * (std::isfinite(above_c) ? 1.0 + coefficient_taken_per_c * above_c : 1.0);
}

double BiasLaw::slope_hz_per_c(double temperature_c) const {
    double half_c = 0.5;
    if (!table.knots.empty()) {
        const double least_c = table.knots.front()[0], most_c = table.knots.back()[0];
        half_c = std::fmin(half_c, 0.5 * (most_c - least_c));
        temperature_c = std::fmin(std::fmax(temperature_c, least_c + half_c), most_c - half_c);
    }
    return (at_hz(temperature_c + half_c) - at_hz(temperature_c - half_c)) / (2.0 * half_c);
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
    if (law.temperature_coefficient_per_c.determined) law.table = find_table(readings, hz_per_count, law);
    law.scatter_ratio = scatter_ratio(readings, law, hz_per_count);
    if (const std::string contradiction = contradiction_of(law); !contradiction.empty()) {
        law.contradicts = true;
        law.bias_hz = numeric::refused(contradiction);
        law.temperature_coefficient_per_c = numeric::refused("the bias frequency is not determined");
    }
    return law;
}

}  // namespace zlg::calibration
