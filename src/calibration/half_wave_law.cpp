#include <zlg/calibration/half_wave_law.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "temperature_span.hpp"

namespace zlg::calibration {
namespace {

constexpr std::int64_t min_switches = 4;

struct Step {
    std::size_t log = 0;
    std::int64_t segment = 0;  // behind the switch
    double voltage_v = 0.0;
    double temperature_c = 0.0;
    double drift_v = 0.0;  // within the segment before
};

bool has_windows(const Segment& s) { return s.at_start.n > 0 && s.at_end.n > 0; }

void collect(const LabLog& log, std::size_t index, std::vector<Step>& steps) {
    for (std::size_t k = 1; k < log.segments.size(); ++k) {
        const Segment& before = log.segments[k - 1];
        const Segment& after = log.segments[k];
        if (before.mode == after.mode || !has_windows(before) || !has_windows(after)) continue;
        const double elapsed_ticks = after.at_start.middle_ticks - before.at_end.middle_ticks;
        const double drift_v = 0.5 * (slope_v_per_tick(before) + slope_v_per_tick(after)) * elapsed_ticks;
        steps.push_back({.log = index,
                         .segment = static_cast<std::int64_t>(k),
                         .voltage_v = std::abs(after.at_start.voltage_v - before.at_end.voltage_v - drift_v),
                         .temperature_c = 0.5 * (before.at_end.temperature_c + after.at_start.temperature_c),
                         .drift_v = before.at_end.voltage_v - before.at_start.voltage_v});
    }
}

double median_v(const std::vector<Step>& steps) {
    std::vector<double> v;
    for (const Step& s : steps) v.push_back(s.voltage_v);
    std::nth_element(v.begin(), v.begin() + std::ssize(v) / 2, v.end());
    return v[v.size() / 2];
}

double longest_rest_ticks(std::span<const LabLog> logs) {
    double ticks = 0.0;
    for (const LabLog& log : logs) ticks = std::fmax(ticks, log.rest_after_ticks);
    return ticks;
}

// A switch that ends in another mode of the same helicity has moved by 3, 5, ... half wavelengths.
void divide_by_multiple(std::vector<Step>& steps) {
    const double usual_v = median_v(steps);
    for (Step& s : steps) s.voltage_v /= 2.0 * std::fmax(0.0, std::round(0.5 * (s.voltage_v / usual_v - 1.0))) + 1.0;
    std::erase_if(steps, [&](const Step& s) { return !(std::abs(s.voltage_v - usual_v) < 0.25 * usual_v); });
}

// rms of what a mean reading keeps of the converter's steps. Without noise it is quantum/sqrt 12; noise that reaches
// from step to step lets it fade away. It is the Fourier series of the sawtooth, each term faded by the noise.
double step_error_v(double quantum_v, double reading_variance_v2) {
    const double own_variance_v2 = std::fmax(0.0, reading_variance_v2 - quantum_v * quantum_v / 12.0);
    double sum = 0.0;
    for (int k = 1; k <= 20; ++k) {
        const double turns = 2.0 * std::numbers::pi * k;
        sum += 2.0 / (turns * turns) * std::exp(-turns * turns * own_variance_v2 / (quantum_v * quantum_v));
    }
    return quantum_v * std::sqrt(sum);
}

// A converter that meets the same steps at every switch gives the voltage no better, however often it is read. It meets
// others where the voltage goes on from switch to switch.
double resolution_v(std::span<const LabLog> logs, const std::vector<Step>& steps) {
    double quantum_v = 0.0;
    double variance_v2 = std::numeric_limits<double>::infinity();
    for (const LabLog& log : logs) {
        if (!log.has_piezo()) continue;
        quantum_v = std::fmax(quantum_v, log.piezo_quantum_v);
        variance_v2 = std::fmin(variance_v2, log.piezo_variance_v2);
    }
    if (!(quantum_v > 0.0)) return 0.0;
    double passed_v = 0.0;
    for (const Step& s : steps) passed_v += std::abs(s.drift_v);
    const double independent = 1.0 + std::fmin(static_cast<double>(steps.size()) - 1.0, passed_v / quantum_v);
    return std::sqrt(2.0 / independent) * step_error_v(quantum_v, variance_v2);
}

struct Regression {
    Eigen::VectorXd coefficient;
    Eigen::MatrixXd covariance;
    double rms_v = 0.0;
};

// Ordinary least squares; the covariance holds what neighbours of one log have in common.
Regression regress(const std::vector<Step>& steps, const Eigen::MatrixXd& laws) {
    Eigen::VectorXd v(std::ssize(steps));
    for (Eigen::Index k = 0; k < v.size(); ++k) v[k] = steps[static_cast<std::size_t>(k)].voltage_v;
    const Eigen::MatrixXd inverse = (laws.transpose() * laws).inverse();
    Regression r{inverse * laws.transpose() * v, {}, 0.0};
    const Eigen::VectorXd residual = v - laws * r.coefficient;
    const double dof = static_cast<double>(v.size() - laws.cols());
    double shared = 0.0;
    for (std::size_t k = 1; k < steps.size(); ++k)
        if (steps[k].log == steps[k - 1].log && steps[k].segment == steps[k - 1].segment + 1)
            shared += residual[static_cast<Eigen::Index>(k)] * residual[static_cast<Eigen::Index>(k) - 1];
    const double sum = residual.squaredNorm();
    const double sigma_v = numeric::widened(std::sqrt(std::fmax(0.75 * sum, sum + 2.0 * shared) / dof), dof);
    r.covariance = sigma_v * sigma_v * inverse;
    r.rms_v = std::sqrt(sum / dof);
    return r;
}

void fit(const std::vector<Step>& steps, bool with_law, double resolution, HalfWaveLaw& law) {
    double mean_c = 0.0;
    for (const Step& s : steps) mean_c += s.temperature_c / static_cast<double>(steps.size());
    Eigen::MatrixXd laws = Eigen::MatrixXd::Ones(std::ssize(steps), with_law ? 2 : 1);
    const bool known_c = std::isfinite(mean_c);
    for (Eigen::Index k = 0; k < laws.rows(); ++k) {
        const double t_c = steps[static_cast<std::size_t>(k)].temperature_c;
        if (with_law)
            laws(k, 1) = t_c - mean_c;
        else if (known_c)
            laws(k, 0) = 1.0 + law.coefficient_taken_per_c * (t_c - law.reference_temperature_c);
    }
    Regression r = regress(steps, laws);
    law.scatter_v = r.rms_v;
    r.covariance(0, 0) = std::fmax(r.covariance(0, 0), resolution * resolution);
    if (!with_law) {
        law.half_wave_v = numeric::estimated(r.coefficient[0], std::sqrt(r.covariance(0, 0)));
        return;
    }
    const double to_reference_c = law.reference_temperature_c - mean_c;
    const double u0 = r.coefficient[0] + r.coefficient[1] * to_reference_c;
    const double beta = r.coefficient[1] / u0;
    const Eigen::Vector2d by_u0(1.0, to_reference_c);
    const Eigen::Vector2d by_beta(-beta / u0, (1.0 - beta * to_reference_c) / u0);
    law.half_wave_v = numeric::estimated(u0, std::sqrt(by_u0.dot(r.covariance * by_u0)));
    law.temperature_coefficient_per_c = numeric::estimated(beta, std::sqrt(by_beta.dot(r.covariance * by_beta)));
    law.coefficient_taken_per_c = beta;
}

}  // namespace

double HalfWaveLaw::at_v(double temperature_c) const {
    const double above_c = temperature_c - reference_temperature_c;
    return half_wave_v.value * (std::isfinite(above_c) ? 1.0 + coefficient_taken_per_c * above_c : 1.0);
}

HalfWaveLaw find_half_wave_law(std::span<const LabLog> logs, double reference_temperature_c, double presumed_per_c) {
    HalfWaveLaw law{.coefficient_taken_per_c = presumed_per_c, .reference_temperature_c = reference_temperature_c};
    std::vector<Step> steps;
    for (std::size_t k = 0; k < logs.size(); ++k) collect(logs[k], k, steps);
    std::erase_if(steps, [](const Step& s) { return !std::isfinite(s.voltage_v); });
    if (!steps.empty()) divide_by_multiple(steps);
    law.n_switches = std::ssize(steps);
    if (law.n_switches < min_switches) {
        law.half_wave_v = numeric::refused(
            fmt::format("{} switches with the column piezo_v, at rest before and after ({:.4g} ticks after a "
                        "re-lock); {} or more are needed",
                        law.n_switches, longest_rest_ticks(logs), min_switches));
        law.temperature_coefficient_per_c = law.half_wave_v;
        return law;
    }
    const std::string too_few = too_few_temperatures(logs);
    const bool with_law = too_few.empty() && law.n_switches > min_switches;
    if (!with_law) law.temperature_coefficient_per_c = numeric::refused(too_few.empty() ? "too few switches" : too_few);
    fit(steps, with_law, resolution_v(logs, steps), law);
    return law;
}

}  // namespace zlg::calibration
