// What only a switched gyro has: its constants, its switches and its alarms.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <zlg/calibration/lab_log.hpp>

#include "values.hpp"

namespace zlg::acceptance {
namespace {

using calibration::Moments;

Value mean_value(const char* name, const Moments& of, double hours, double step, const char* missing) {
    if (of.n < 2) return not_determined(name, missing);
    const auto n = static_cast<double>(of.n);
    return measured(name, of.mean, std::sqrt(of.variance() / n + step * step / 12.0), n - 1.0, hours);
}

// Whether the rotation changes while a switch lasts, gap and settling: the angles of neighbouring stretches of up to 64
// samples differ by more than white noise of the shortest ones lets them, or a faster sinusoid swings.
bool moves(const study::AxisResult& axis) {
    constexpr int of_switch = 64;
    const auto& points = axis.allan.points;
    const auto unit = [&points](const auto& p) {
        return p.deviation * std::sqrt(p.tau_s) / (points.front().deviation * std::sqrt(points.front().tau_s));
    };
    if (std::ranges::any_of(points, [&](const auto& p) { return p.m <= of_switch && unit(p) > 2.0; })) return true;
    const double third = axis.modes->statistics.rms_arcsec / 3.0;
    return axis.fit && std::ranges::any_of(axis.fit->terms.sines, [&](const noise::SineTerm& s) {
               return s.frequency_hz * of_switch > axis.rate_hz &&
                      s.amplitude_arcsec_s > third * 2.0 * std::numbers::pi * s.frequency_hz;
           });
}

// At rest the rotation over a switch is that of the segments beside it.
Value error_value(const std::vector<StillAxis>& axes, double hours) {
    constexpr const char* name = "switch_error.arcsec";
    double n = 0.0, squares = 0.0;
    for (const StillAxis& axis : axes) {
        if (axis.run->kind != RunKind::at_rest || !axis.result.modes) continue;
        const noise::SwitchStatistics& s = axis.result.modes->statistics;
        if (s.n > 0 && moves(axis.result))
            return not_determined(
                name, fmt::format("run {}: the gyro turned unevenly, and by how much is not known", axis.run->number));
        n += static_cast<double>(s.n);
        squares += static_cast<double>(s.n) * s.rms_arcsec * s.rms_arcsec;
    }
    if (n < 2.0) return not_determined(name, "needs a static raw log with two switches or more");
    return deviation(name, std::sqrt(squares / n), n, hours);
}

}  // namespace

std::vector<Value> constant_values(const study::CalibrationResult& found) {
    constexpr std::array<std::pair<const char*, const char*>, 7> names{
        {{"magnetic_drift.deg_h", "drift.magnetic_arcsec_s"},
         {"magnetic_thermal.deg_h", "drift.magnetic_thermal_arcsec_s"},
         {"thermal_time.s", "drift.thermal_time_s"},
         {"bias_frequency.hz", "gyro.bias_hz"},
         {"bias_frequency_temperature.per_c", "gyro.bias_temperature_coefficient_per_c"},
         {"chi.per_lambda2", "gyro.bias_chi"},
         {"half_wave.v", "piezo.half_wave_v"}}};
    double hours = 0.0, segments = 0.0;
    for (const study::CalibratedLog& log : found.logs)
        hours += log.duration_s / 3600.0, segments += static_cast<double>(log.segments);
    std::vector<Value> all;
    const auto add = [&](const char* name, const char* key, double factor) {
        const auto constant = std::ranges::find(found.calibration.constants, key, &calibration::Constant::key);
        const numeric::Estimate& e = constant->estimate;
        const double degrees = std::max(1.0, segments - 2.0);
        all.push_back(e.determined ? measured(name, e.value * factor, e.sigma * factor, degrees, hours)
                                   : not_determined(name, e.reason));
    };
    for (const auto& [name, key] : names) add(name, key, 1.0);
    // By likelihood from the angles between switches: in the deviations of a switched gyro the rounding hides it, and
    // the magnetic part that was taken out takes some of it along.
    add("angle_random_walk.deg_sqrt_h", "drift.random_walk_arcsec_sqrt_s", 1.0 / 60.0);
    if (Value& walk = all.back(); walk.determined) {
        walk.law = Law::chi;
        walk.degrees = 0.5 * std::pow(walk.value / walk.uncertainty, 2);
        walk.reason = "by the drift law of calibrate";
    }
    return all;
}

std::vector<Value> switch_values(const std::vector<SwitchRecord>& logs, const std::vector<StillAxis>& axes) {
    Moments relock, miss;
    double hours = 0.0, longest = 0.0, sigma = 0.0, n = 0.0, half_s = 0.0;
    std::int64_t alarms = 0, withheld = 0, unsettled = 0;
    bool tells_interval = !logs.empty(), is_dead = false;
    for (const SwitchRecord& log : logs) {
        hours += log.hours;
        alarms += log.alarms;
        unsettled += log.unsettled;
        half_s = log.half_s;
        tells_interval = tells_interval && log.withheld.has_value();
        withheld += log.withheld.value_or(0);
        is_dead = is_dead || log.detuning_is_dead;
        for (const double s : log.relock_s) relock.add(s);
        for (const study::SwitchLine& line : log.lines) {
            n += 1.0;
            longest = std::max(longest, static_cast<double>(line.gap_ticks));
            sigma += line.sigma_arcsec * line.sigma_arcsec;
            if (std::isfinite(line.miss_lambda)) miss.add(std::abs(line.miss_lambda));
        }
    }
    constexpr const char* none = "the logs hold no switch";
    std::vector<Value> all;
    constexpr const char* dead = "needs detuning_lambda, which is absent or one value throughout";
    if (is_dead)
        all.push_back(not_determined("relock.s", dead));
    else if (relock.n > 0 && unsettled > 0)
        all.push_back(not_determined("relock.s", fmt::format("after {} of {} switches detuning_lambda does not settle",
                                                             unsettled, unsettled + relock.n)));
    else
        all.push_back(
            mean_value("relock.s", relock, hours, half_s, "needs two switches after which detuning_lambda settles"));
    all.push_back(n > 0.0 ? counted("gap.ticks", longest, hours) : not_determined("gap.ticks", none));
    all.push_back(is_dead ? not_determined("miss.lambda", dead)
                          : mean_value("miss.lambda", miss, hours, 0.0, "needs two switches with detuning_lambda"));
    all.push_back(n > 0.0 && std::isfinite(sigma)
                      ? counted("switch_sigma.arcsec", std::sqrt(sigma / n), hours)
                      : not_determined("switch_sigma.arcsec", n > 0.0 ? "a switch has no finite sigma" : none));
    all.push_back(error_value(axes, hours));
    all.push_back(tells_interval ? counted("switches_withheld.count", static_cast<double>(withheld), hours)
                                 : not_determined("switches_withheld.count",
                                                  "needs raw logs that say switching.interval_s, of schedule fixed"));
    all.push_back({.name = "alarms.per_h",
                   .determined = true,
                   .value = static_cast<double>(alarms) / hours,
                   .uncertainty = std::sqrt(std::max(1.0, static_cast<double>(alarms))) / hours,
                   .law = Law::poisson,
                   .hours = hours});
    return all;
}

}  // namespace zlg::acceptance
