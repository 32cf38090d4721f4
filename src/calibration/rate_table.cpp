#include <zlg/calibration/rate_table.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>

#include <fmt/format.h>
#include <Eigen/Dense>

#include <zlg/calibration/lab_log.hpp>
#include <zlg/deviations/series.hpp>

namespace zlg::calibration {
namespace {

constexpr double many = 1e9;       // degrees of freedom
constexpr std::size_t parts = 10;  // of a stage, whose means show how certain that of all is

std::optional<TableStage> stage_of(std::span<const double> input, std::span<const double> output,
                                   const RateTableOptions& options) {
    const auto settled = static_cast<std::size_t>(std::max<std::int64_t>(0, options.settling_samples));
    if (input.size() <= settled) return std::nullopt;
    const std::size_t n = input.size() - settled;
    Moments in, out;
    std::vector<Moments> part(parts);
    for (std::size_t k = 0; k < n; ++k) {
        const double x = input[settled + k], y = output[settled + k];
        if (!std::isfinite(x) || !std::isfinite(y)) continue;
        in.add(x);
        out.add(y);
        part[k * parts / n].add(y);
    }
    if (out.n < std::max<std::int64_t>(options.min_samples, 2)) return std::nullopt;
    Moments squares;
    for (const Moments& p : part)
        if (p.n > 0) squares.add((p.mean - out.mean) * (p.mean - out.mean));
    const double sigma = squares.n > 1 ? std::sqrt(squares.mean / static_cast<double>(squares.n - 1)) : 0.0;
    return TableStage{.input_arcsec_s = in.mean + options.earth_arcsec_s,
                      .output = out.mean,
                      .output_sigma = sigma,
                      .n_samples = out.n};
}

std::vector<TableStage> stages_of(std::span<const double> input, std::span<const double> output,
                                  const RateTableOptions& options) {
    double largest = 0.0;
    for (const double x : input)
        if (std::isfinite(x)) largest = std::max(largest, std::abs(x));
    const double near = options.same_rate_ratio * largest;
    std::vector<TableStage> stages;
    const auto first = std::ranges::find_if(input, [](double x) { return std::isfinite(x); });
    if (first == input.end()) return stages;
    auto from = static_cast<std::size_t>(first - input.begin());
    const auto close = [&](std::size_t to) {
        if (const auto s = stage_of(input.subspan(from, to - from), output.subspan(from, to - from), options))
            stages.push_back(*s);
    };
    // A rate that is not known ends no stage.
    for (std::size_t k = from + 1; k <= input.size(); ++k) {
        if (k < input.size() && (!std::isfinite(input[k]) || std::abs(input[k] - input[from]) <= near)) continue;
        close(k);
        from = k;
    }
    return stages;
}

// Slope and offset.
struct Line {
    Eigen::Vector2d of;
    Eigen::Matrix2d covariance;
    double dof = 0.0;
    double variance = 0.0;  // of a stage about it

    [[nodiscard]] double at(double input) const { return of[0] * input + of[1]; }
    // Of what depends on both by these derivatives.
    [[nodiscard]] double variance_by(const Eigen::Vector2d& by) const { return by.dot(covariance * by); }
};

// Least squares, all stages alike; the error from what is left, or, with less than three degrees of freedom, from the
// scatter within the stages, which do not show how straight the line is.
std::optional<Line> line_of(const std::vector<TableStage>& stages, const std::function<bool(double)>& wanted) {
    std::vector<TableStage> of;
    std::ranges::copy_if(stages, std::back_inserter(of), wanted, &TableStage::input_arcsec_s);
    const auto n = std::ssize(of);
    double within = 0.0, largest = 0.0;
    for (const TableStage& s : of) {
        within += s.output_sigma * s.output_sigma;
        largest = std::max(largest, std::abs(s.input_arcsec_s));
    }
    if (n < 3 || largest == 0.0) return std::nullopt;
    const Eigen::Vector2d unit{1.0 / largest, 1.0};
    Eigen::MatrixX2d a(n, 2);
    Eigen::VectorXd y(n);
    for (Eigen::Index k = 0; k < n; ++k) {
        a.row(k) << of[static_cast<std::size_t>(k)].input_arcsec_s / largest, 1.0;
        y[k] = of[static_cast<std::size_t>(k)].output;
    }
    const Eigen::Matrix2d normal = a.transpose() * a;
    if (!(normal.determinant() > 1e-12 * static_cast<double>(n * n))) return std::nullopt;
    const Eigen::Matrix2d inverse = normal.inverse();
    const Eigen::Vector2d fit = inverse * (a.transpose() * y);
    const double dof = static_cast<double>(n) - 2.0;
    const bool few = dof < 3.0;
    const double variance = few ? within / static_cast<double>(n) : (y - a * fit).squaredNorm() / dof;
    return Line{.of = unit.cwiseProduct(fit),
                .covariance = unit.asDiagonal() * inverse * unit.asDiagonal() * variance,
                .dof = few ? many : dof,
                .variance = variance};
}

void take_residuals(const Line& line, double same_rate_ratio, RateTable& table) {
    double largest = 0.0, squares = 0.0;
    for (const TableStage& s : table.stages) largest = std::max(largest, std::abs(s.input_arcsec_s));
    for (TableStage& s : table.stages) {
        s.residual_ppm = 1e6 * (s.output - line.at(s.input_arcsec_s)) / (line.of[0] * largest);
        squares += s.residual_ppm * s.residual_ppm;
        table.largest_residual_ppm = std::max(table.largest_residual_ppm, std::abs(s.residual_ppm));
    }
    table.nonlinearity_ppm = std::sqrt(squares / static_cast<double>(table.stages.size()));
    for (std::size_t i = 0; i < table.stages.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const TableStage &a = table.stages[i], &b = table.stages[j];
            if (std::abs(a.input_arcsec_s - b.input_arcsec_s) > same_rate_ratio * largest) continue;
            const double apart = (a.output - b.output) / line.of[0] - (a.input_arcsec_s - b.input_arcsec_s);
            table.hysteresis_arcsec_s = std::max(table.hysteresis_arcsec_s, std::abs(apart));
        }
}

void take_far(RateTable& table) {
    constexpr double errors = 8.0;
    for (std::size_t k = 0; k < table.stages.size(); ++k) {
        std::vector<TableStage> others = table.stages;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
        const auto line = line_of(others, [](double) { return true; });
        if (!line || line->dof >= many) continue;
        const TableStage& s = table.stages[k];
        const double variance =
            line->variance_by({s.input_arcsec_s, 1.0}) + line->variance + s.output_sigma * s.output_sigma;
        if (std::abs(s.output - line->at(s.input_arcsec_s)) > errors * std::sqrt(variance)) table.far.push_back(k);
    }
}

numeric::Estimate asymmetry_of(const std::vector<TableStage>& stages, double slope) {
    const auto positive = line_of(stages, [](double x) { return x >= 0.0; });
    const auto negative = line_of(stages, [](double x) { return x <= 0.0; });
    if (!positive || !negative)
        return numeric::refused("three stages of either sign, zero counting for both, are needed");
    const double sigma = std::sqrt(positive->covariance(0, 0) + negative->covariance(0, 0));
    return numeric::estimated(1e6 * (positive->of[0] - negative->of[0]) / slope,
                              numeric::widened(1e6 * sigma / std::abs(slope), std::min(positive->dof, negative->dof)));
}

}  // namespace

RateTable rate_table(std::span<const double> input, std::span<const double> output, const RateTableOptions& options) {
    if (input.size() != output.size())
        throw deviations::SeriesError(
            fmt::format("rate table: {} rates of the table and {} of the gyro, allowed are as many of each",
                        input.size(), output.size()));
    RateTable table{.stages = stages_of(input, output, options)};
    if (table.stages.size() < 3)
        throw deviations::SeriesError(
            fmt::format("rate table: {} stages of {} samples or more at one rate, 3 or more are needed",
                        table.stages.size(), options.min_samples));
    const auto line = line_of(table.stages, [](double) { return true; });
    if (!line || line->of[0] == 0.0)
        throw deviations::SeriesError("rate table: all stages have one rate, a scale factor needs two");
    const double slope = line->of[0], inverse = 1.0 / slope;
    table.scale_factor = numeric::estimated(slope, numeric::widened(std::sqrt(line->covariance(0, 0)), line->dof));
    table.arcsec_per_unit = numeric::estimated(inverse, table.scale_factor.sigma * inverse * inverse);
    // D/K: both are estimated together.
    const double d = line->of[1] * inverse, variance = line->variance_by({-d * inverse, inverse});
    table.bias_arcsec_s = numeric::estimated(d, numeric::widened(std::sqrt(std::max(0.0, variance)), line->dof));
    table.asymmetry_ppm = asymmetry_of(table.stages, slope);
    take_residuals(*line, options.same_rate_ratio, table);
    take_far(table);
    return table;
}

}  // namespace zlg::calibration
