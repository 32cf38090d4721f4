#include <zlg/calibration/half_wave_law.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "pieces.hpp"

namespace zlg::calibration {
namespace {

constexpr std::int64_t min_switches = 4;

struct Step {
    std::size_t log = 0;
    std::int64_t segment = 0;  // behind the switch
    double from_v = 0.0;
    double to_v = 0.0;
    double half_waves = 1.0;
    double voltage_v = 0.0;  // of one half wavelength
    double temperature_c = 0.0;
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
                         .from_v = before.at_end.voltage_v,
                         .to_v = after.at_start.voltage_v,
                         .voltage_v = std::abs(after.at_start.voltage_v - before.at_end.voltage_v - drift_v),
                         .temperature_c = 0.5 * (before.at_end.temperature_c + after.at_start.temperature_c)});
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
    for (Step& s : steps) {
        s.half_waves = 2.0 * std::fmax(0.0, std::round(0.5 * (s.voltage_v / usual_v - 1.0))) + 1.0;
        s.voltage_v /= s.half_waves;
    }
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

// The step of the converter, and the error that a mean reading of each log keeps of it.
struct Converter {
    double quantum_v = 0.0;
    std::vector<double> error_v;
};

Converter converter_of(std::span<const LabLog> logs) {
    Converter c;
    for (const LabLog& log : logs)
        if (log.has_piezo()) c.quantum_v = std::fmax(c.quantum_v, log.piezo_quantum_v);
    for (const LabLog& log : logs)
        c.error_v.push_back(c.quantum_v > 0.0 ? step_error_v(c.quantum_v, log.piezo_variance_v2) : 0.0);
    return c;
}

// What the errors of the converter do to the coefficients. An error belongs to a place of the voltage and comes again
// with every reading there, in whichever log; a step of the converter away it is another one:
//
//   e(v) = cos(pi t/2) e_k + sin(pi t/2) e_(k+1),   v = (k + t) quantum_v,   e_k independent, of variance error_v^2
//
// so its variance is the same everywhere. Each e_k contributes the square of all that it does in the fit.
Eigen::MatrixXd converter_covariance(const std::vector<Step>& steps, const Eigen::MatrixXd& by_voltage,
                                     const Converter& converter) {
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(by_voltage.rows(), by_voltage.rows());
    if (!(converter.quantum_v > 0.0)) return covariance;
    std::map<double, Eigen::VectorXd> by_place;
    const auto add = [&](double voltage_v, const Eigen::VectorXd& effect) {
        const double k = std::floor(voltage_v / converter.quantum_v);
        const double angle = 0.5 * std::numbers::pi * (voltage_v / converter.quantum_v - k);
        const Eigen::VectorXd none = Eigen::VectorXd::Zero(effect.size());
        by_place.try_emplace(k, none).first->second += std::cos(angle) * effect;
        by_place.try_emplace(k + 1.0, none).first->second += std::sin(angle) * effect;
    };
    for (std::size_t n = 0; n < steps.size(); ++n) {
        const Step& s = steps[n];
        const double error_v = std::copysign(converter.error_v[s.log], s.to_v - s.from_v) / s.half_waves;
        const Eigen::VectorXd effect = error_v * by_voltage.col(static_cast<Eigen::Index>(n));
        add(s.to_v, effect);
        add(s.from_v, -effect);
    }
    for (const auto& [k, effect] : by_place) covariance += effect * effect.transpose();
    return covariance;
}

struct Regression {
    Eigen::VectorXd coefficient;
    Eigen::MatrixXd covariance;
    double rms_v = 0.0;
};

// Sum of squares of the residuals, with twice the products of neighbours of one log.
double sum_with_neighbours(const std::vector<Step>& steps, const Eigen::VectorXd& residual) {
    double shared = 0.0;
    for (std::size_t k = 1; k < steps.size(); ++k)
        if (steps[k].log == steps[k - 1].log && steps[k].segment == steps[k - 1].segment + 1)
            shared += residual[static_cast<Eigen::Index>(k)] * residual[static_cast<Eigen::Index>(k) - 1];
    const double sum = residual.squaredNorm();
    return std::fmax(0.75 * sum, sum + 2.0 * shared);
}

// Ordinary least squares; the covariance holds what neighbours of one log have in common, and the errors of the
// converter. What the latter are expected to leave in the residuals, tr((I - H) C), counts only once.
Regression regress(const std::vector<Step>& steps, const Eigen::MatrixXd& laws, const Converter& converter) {
    Eigen::VectorXd v(std::ssize(steps));
    double converter_sum = 0.0;
    for (Eigen::Index k = 0; k < v.size(); ++k) {
        const Step& s = steps[static_cast<std::size_t>(k)];
        v[k] = s.voltage_v;
        converter_sum += 2.0 * std::pow(converter.error_v[s.log] / s.half_waves, 2);
    }
    const Eigen::MatrixXd normal = laws.transpose() * laws;
    const Eigen::MatrixXd inverse = normal.inverse();
    const Eigen::MatrixXd by_voltage = inverse * laws.transpose();
    Regression r{by_voltage * v, converter_covariance(steps, by_voltage, converter), 0.0};
    const Eigen::VectorXd residual = v - laws * r.coefficient;
    const double dof = static_cast<double>(v.size() - laws.cols());
    converter_sum -= (normal * r.covariance).trace();
    const double sum = std::fmax(0.0, sum_with_neighbours(steps, residual) - std::fmax(0.0, converter_sum));
    const double sigma_v = numeric::widened(std::sqrt(sum / dof), dof);
    r.covariance += sigma_v * sigma_v * inverse;
    r.rms_v = std::sqrt(residual.squaredNorm() / dof);
    return r;
}

void fit(const std::vector<Step>& steps, bool with_law, const Converter& converter, double reference_c,
         double presumed_per_c, HalfWaveLaw& law) {
    double mean_c = 0.0;
    for (const Step& s : steps) mean_c += s.temperature_c / static_cast<double>(steps.size());
    Eigen::MatrixXd laws = Eigen::MatrixXd::Ones(std::ssize(steps), with_law ? 2 : 1);
    const bool known_c = std::isfinite(mean_c);
    for (Eigen::Index k = 0; k < laws.rows(); ++k) {
        const double t_c = steps[static_cast<std::size_t>(k)].temperature_c;
        if (with_law)
            laws(k, 1) = t_c - mean_c;
        else if (known_c)
            laws(k, 0) = 1.0 + presumed_per_c * (t_c - reference_c);
    }
    const Regression r = regress(steps, laws, converter);
    law.scatter_v = r.rms_v;
    if (!with_law) {
        law.half_wave_v = numeric::estimated(r.coefficient[0], std::sqrt(r.covariance(0, 0)));
        return;
    }
    const double to_reference_c = reference_c - mean_c;
    const double u0 = r.coefficient[0] + r.coefficient[1] * to_reference_c;
    const double beta = r.coefficient[1] / u0;
    const Eigen::Vector2d by_u0(1.0, to_reference_c);
    const Eigen::Vector2d by_beta(-beta / u0, (1.0 - beta * to_reference_c) / u0);
    law.half_wave_v = numeric::estimated(u0, std::sqrt(by_u0.dot(r.covariance * by_u0)));
    law.temperature_coefficient_per_c = numeric::estimated(beta, std::sqrt(by_beta.dot(r.covariance * by_beta)));
}

void refuse(const std::string& reason, HalfWaveLaw& law) {
    law.half_wave_v = numeric::refused(reason);
    law.temperature_coefficient_per_c = law.half_wave_v;
}

}  // namespace

HalfWaveLaw find_half_wave_law(std::span<const LabLog> logs, double reference_temperature_c, double presumed_per_c) {
    HalfWaveLaw law;
    std::vector<Step> steps;
    for (std::size_t k = 0; k < logs.size(); ++k) collect(logs[k], k, steps);
    std::erase_if(steps, [](const Step& s) { return !std::isfinite(s.voltage_v); });
    const std::int64_t n_seen = std::ssize(steps);
    if (!steps.empty()) divide_by_multiple(steps);
    law.n_switches = std::ssize(steps);
    if (law.n_switches < min_switches) {
        refuse(fmt::format("{} switches with the column piezo_v, at rest before and after ({:.4g} ticks after a "
                           "re-lock); {} or more are needed",
                           law.n_switches, longest_rest_ticks(logs), min_switches),
               law);
        return law;
    }
    if (2 * law.n_switches < n_seen) {
        refuse(fmt::format("of {} switches only {} move by one voltage or its odd multiples; allowed is half of them",
                           n_seen, law.n_switches),
               law);
        return law;
    }
    const std::string too_few = too_few_temperatures(logs);
    const bool with_law = too_few.empty() && law.n_switches > min_switches;
    if (!with_law) law.temperature_coefficient_per_c = numeric::refused(too_few.empty() ? "too few switches" : too_few);
    fit(steps, with_law, converter_of(logs), reference_temperature_c, presumed_per_c, law);
    if (law.half_wave_v.determined && !(law.half_wave_v.value > law.half_wave_v.sigma))
        refuse(fmt::format("it comes out as {:.3g} +- {:.3g} V", law.half_wave_v.value, law.half_wave_v.sigma), law);
    return law;
}

}  // namespace zlg::calibration
