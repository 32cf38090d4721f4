#include "forecast.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <zlg/config/schema.hpp>
#include <zlg/numeric/parallel.hpp>
#include <zlg/recorded/motion.hpp>
#include <zlg/study/gyro_drift.hpp>
#include <zlg/study/switch_trial.hpp>

namespace zlg::choice {
namespace {

constexpr std::size_t n_tried = 4;    // gyros whose switches are tried
constexpr std::int64_t n_gyros = 64;  // whose drift is reckoned
constexpr int n_switches = 24;        // of a trial
constexpr int least_switches = 4;
constexpr double least_interval_s = 2.5;
constexpr double infinite = std::numeric_limits<double>::infinity();

// P(|x| <= limit) of N(mean, variance).
double share_within(double limit, double mean, double variance) {
    if (!(variance > 0.0)) return std::abs(mean) <= limit ? 1.0 : 0.0;
    const double scale = 1.0 / std::sqrt(2.0 * variance);
    return 0.5 * (std::erf((limit - mean) * scale) + std::erf((limit + mean) * scale));
}

double trial_interval_s(const config::Config& gyro) {
    return 1.07 * std::max(least_interval_s, 2.0 * study::shortest_interval_s(gyro));
}

}  // namespace

double first_switch_s(const Candidate& c) {
    return c.first_segment == config::FirstSegment::half ? 0.5 * c.interval_s : c.interval_s;
}

std::int64_t switches_until(double run_s, const Candidate& c) {
    const double after_first = (run_s - first_switch_s(c)) / c.interval_s;
    return after_first > 0.0 ? static_cast<std::int64_t>(std::ceil(after_first * (1.0 - 1e-12))) : 0;
}

double magnetic_angle_arcsec(const design::GyroDrift& gyro, double run_s, const Candidate& c) {
    const std::int64_t m = switches_until(run_s, c);
    if (m == 0) return design::magnetic_integral_arcsec(gyro, 0.0, run_s);
    const double last_s = first_switch_s(c) + static_cast<double>(m - 1) * c.interval_s;
    const double sign = m % 2 == 0 ? 1.0 : -1.0;
    return design::start_residue_arcsec(gyro, c.interval_s, c.first_segment) +
           sign * (design::magnetic_integral_arcsec(gyro, last_s, run_s) -
                   design::kernel_arcsec(gyro, c.interval_s, last_s));
}

double least_trial_s(const config::Config& gyro) { return (least_switches + 0.5) * trial_interval_s(gyro); }

Forecast::Forecast(const Population& population, int threads, IsStopped is_stopped)
    : population_{population}, threads_{threads}, is_stopped_{std::move(is_stopped)} {}

// Twenty-odd switches in quick succession, without drift: docs/accuracy.md, the error of a switch.
SwitchLaw Forecast::learnt(std::int64_t number, const Method& method) const {
    try {
        config::Config gyro = population_.gyro(number, {.method = method});
        gyro.drift.magnetic_arcsec_s = gyro.drift.magnetic_thermal_arcsec_s = gyro.drift.nonmagnetic_arcsec_s = 0.0;
        gyro.compensation.magnetic = core::MagneticMethod::none;
        gyro.switching.schedule = config::Schedule::fixed;
        gyro.switching.interval_s = trial_interval_s(gyro);
        gyro.gyro.fidelity = config::Fidelity::averaged;
        gyro.run.duration_s =
            std::min((n_switches + 0.5) * gyro.switching.interval_s, recorded::motion(gyro).duration_s());
        const Trial trial = try_gyro(population_.requirement(), gyro, is_stopped_);
        const auto n = static_cast<double>(trial.switches);
        if (trial.state != TrialState::good || trial.switches < least_switches) return {infinite};
        // The walk of the ticks of a switch is in the walk of the run; n - 1 for the mean.
        const double walk = gyro.drift.random_walk_arcsec_sqrt_s;
        const double window_s = (gyro.switching.gap_ticks + gyro.compensation.relock_ticks) * gyro.gyro.tick_s;
        const double square =
            trial.switch_rms_arcsec * trial.switch_rms_arcsec * n / (n - 1.0) - walk * walk * window_s;
        return {std::sqrt(std::max(square, 0.0)), trial.alternating_arcsec};
    } catch (const config::ConfigError&) {
        return {infinite};
    }
}

bool Forecast::leaves_unknown(const Candidate& c) const {
    return (c.method.magnetic == core::MagneticMethod::estimate || c.method.schedule == config::Schedule::measured) &&
           switches_until(population_.requirement().run_s, c) > 0;
}

const std::vector<SwitchLaw>& Forecast::laws(const Method& m) {
    std::vector<SwitchLaw>& found = laws_[key(m)];
    if (!found.empty()) return found;
    found.resize(population_.requirement().tolerance.empty() ? 2 : n_tried);
    numeric::in_parallel(found.size(), threads_,
                         [&](std::size_t k) { found[k] = learnt(static_cast<std::int64_t>(k), m); });
    return found;
}

const std::vector<Forecast::Gyro>& Forecast::gyros(const Method& method) {
    std::vector<Gyro>& found = gyros_[{method.tick_s, method.reading}];
    if (!found.empty()) return found;
    const std::int64_t n = population_.requirement().tolerance.empty() ? 1 : n_gyros;
    for (std::int64_t k = 0; k < n; ++k) {
        try {
            const config::Config gyro = population_.gyro(k, {.method = method});
            const double count = gyro.gyro.scale_arcsec;
            found.push_back({study::gyro_drift(gyro), gyro.drift.random_walk_arcsec_sqrt_s,
                             count * count / (method.reading == Reading::phase ? 12.0 : 6.0)});
        } catch (const config::ConfigError&) {
            // It is none; the trials count it.
        }
    }
    return found;
}

Parts Forecast::parts_of(const Gyro& gyro, const SwitchLaw& law, const Candidate& c) const {
    const double run_s = population_.requirement().run_s;
    const std::int64_t m = switches_until(run_s, c);
    const double magnetic = magnetic_angle_arcsec(gyro.drift, run_s, c);
    return {.magnetic = magnetic * magnetic,
            .switches = m == 0 ? 0.0 : static_cast<double>(m) * law.rms_arcsec * law.rms_arcsec,
            .alternating = m == 0 ? 0.0 : law.alternating_arcsec * law.alternating_arcsec,
            .walk = gyro.walk_arcsec_sqrt_s * gyro.walk_arcsec_sqrt_s * run_s,
            .rounding = gyro.rounding_arcsec2};
}

std::vector<Parts> Forecast::all_parts(const Candidate& candidate) {
    static const std::vector<SwitchLaw> none(1);
    const bool has_switches = switches_until(population_.requirement().run_s, candidate) > 0;
    const std::vector<SwitchLaw>& all = has_switches ? laws(candidate.method) : none;
    const std::vector<Gyro>& drawn = gyros(candidate.method);
    std::vector<Parts> parts(drawn.empty() ? 0 : std::max(all.size(), drawn.size()));
    for (std::size_t k = 0; k < parts.size(); ++k)
        parts[k] = parts_of(drawn[k % drawn.size()], all[k % all.size()], candidate);
    return parts;
}

double Forecast::chance(const Candidate& candidate, double rms_ratio) {
    const double limit = population_.requirement().limit_arcsec();
    const std::vector<Parts> all = all_parts(candidate);
    const bool is_unknown = leaves_unknown(candidate);
    double sum = 0.0;
    for (const Parts& p : all)
        sum += share_within(limit, (is_unknown ? 0.0 : std::sqrt(p.magnetic)) + std::sqrt(p.alternating),
                            p.switches * rms_ratio * rms_ratio + p.walk + p.rounding);
    return all.empty() ? 0.0 : sum / static_cast<double>(all.size());
}

Parts Forecast::parts(const Candidate& candidate) {
    const std::vector<Parts> all = all_parts(candidate);
    Parts mean;
    for (const Parts& one : all)
        for (double Parts::*part :
             {&Parts::magnetic, &Parts::switches, &Parts::alternating, &Parts::walk, &Parts::rounding})
            mean.*part += one.*part / static_cast<double>(all.size());
    return mean;
}

double Forecast::switch_rms_arcsec(const Method& method) {
    double sum = 0.0, n = 0.0;
    for (const SwitchLaw& law : laws(method)) {
        if (!std::isfinite(law.rms_arcsec)) continue;
        sum += law.rms_arcsec * law.rms_arcsec;
        n += 1.0;
    }
    return n > 0.0 ? std::sqrt(sum / n) : 0.0;
}

}  // namespace zlg::choice
