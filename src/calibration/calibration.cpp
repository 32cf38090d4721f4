#include <zlg/calibration/calibration.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include <zlg/calibration/bias_law.hpp>
#include <zlg/calibration/bias_loss.hpp>
#include <zlg/calibration/drift_law.hpp>
#include <zlg/calibration/half_wave_law.hpp>

namespace zlg::calibration {
namespace {

void check(std::span<const LabLog> logs) {
    if (logs.empty()) throw std::invalid_argument("calibration: 0 logs, allowed is 1 or more");
    for (const LabLog& log : logs)
        if (log.tick_s != logs.front().tick_s)
            throw std::invalid_argument(
                fmt::format("calibration: {} has ticks of {} s, {} of {} s; allowed is one value", logs.front().name,
                            logs.front().tick_s, log.name, log.tick_s));
}

LossCurve find_curve(std::span<const LabLog> logs, const BiasLaw& law, const Presumed& presumed) {
    if (presumed.read_by_slope) return find_loss_curve(logs, law);
    LossCurve none;
    none.reason = "the detunings of the logs were not all read by one slope";
    return none;
}

void add(const BiasLaw& law, const BiasLoss& loss, Calibration& c) {
    c.constants.push_back({"gyro.bias_hz", "Hz", law.bias_hz});
    c.constants.push_back({"gyro.bias_temperature_coefficient_per_c", "1/C", law.temperature_coefficient_per_c});
    c.constants.push_back({"gyro.bias_chi", "", loss.chi});
    if (law.dof > 0)
        c.goodness.push_back({"bias_scatter_ratio", law.scatter_ratio,
                              "rms of the segments about the law of f0, over what rounding leaves; 0..3"});
    if (loss.n_relocks > 0 && loss.chi2_per_dof > 0.0)
        c.goodness.push_back(
            {"chi_chi2_per_dof", loss.chi2_per_dof,
             fmt::format("residuals of {} re-locks over white rounding and light noise; about 1", loss.n_relocks)});
}

void add(const HalfWaveLaw& law, Calibration& c) {
    c.constants.push_back({"piezo.half_wave_v", "V", law.half_wave_v});
    c.constants.push_back({"piezo.half_wave_temperature_coefficient_per_c", "1/C", law.temperature_coefficient_per_c});
    if (law.half_wave_v.determined)
        c.goodness.push_back(
            {"half_wave_scatter_v", law.scatter_v,
             fmt::format("rms of {} switches about the law of the half-wave voltage", law.n_switches)});
}

void add(const DriftLaw& law, Calibration& c) {
    c.constants.push_back({"field.sensitivity_arcsec_s_g", "arcsec/(s G)", law.sensitivity_arcsec_s_g});
    c.constants.push_back({"field.sensitivity_per_c", "1/C", law.sensitivity_per_c});
    c.constants.push_back({"drift.magnetic_arcsec_s", "arcsec/s", law.magnetic_arcsec_s});
    c.constants.push_back({"drift.magnetic_thermal_arcsec_s", "arcsec/s", law.magnetic_thermal_arcsec_s});
    c.constants.push_back({"drift.thermal_time_s", "s", law.thermal_time_s});
    c.constants.push_back({"drift.nonmagnetic_arcsec_s", "arcsec/s", law.nonmagnetic_arcsec_s});
    c.constants.push_back({"drift.random_walk_arcsec_sqrt_s", "arcsec/sqrt(s)", law.random_walk_arcsec_sqrt_s});
    if (law.dof > 0)
        c.goodness.push_back(
            {"drift_chi2_per_dof", law.chi2_per_dof,
             fmt::format("angles of settled pieces about the drift law, {} degrees of freedom; about 1", law.dof)});
    c.goodness.push_back({"rest_variance_ratio", law.rest.worst_ratio,
                          fmt::format("scatter of the angle over {} ticks against a gyro at rest; 0.25..4 is at rest",
                                      law.rest.worst_ticks)});
}

}  // namespace

Calibration calibrate(std::span<const LabLog> logs, const Presumed& presumed) {
    check(logs);
    Calibration c;
    const double reference_c = presumed.reference_temperature_c;
    const BiasLaw bias = find_bias_law(logs, reference_c, presumed.bias_temperature_coefficient_per_c);
    c.curve = find_curve(logs, bias, presumed);
    const std::vector<LabLog> straight = c.curve.determined ? straightened(logs, c.curve) : std::vector<LabLog>{};
    // Those of which the detuning is used, by the curve where there is one.
    const std::span<const LabLog> seen = c.curve.determined ? std::span{straight} : logs;
    const BiasLoss loss = find_bias_loss(seen, bias, c.curve.determined ? 1 : 4);
    c.chi_higher = loss.higher;
    c.bias_table = bias.table;
    for (const numeric::Estimate& e : {bias.temperature_coefficient_per_c, bias.bias_hz})
        if (!e.determined) c.bias_table = {.reason = e.reason};
    add(bias, loss, c);
    if (c.curve.determined)
        c.goodness.push_back({"curve_chi2_per_dof", c.curve.chi2_per_dof,
                              fmt::format("residuals of {} re-locks over white rounding; about 1", c.curve.n_relocks)});
    add(find_half_wave_law(logs, reference_c, presumed.half_wave_temperature_coefficient_per_c), c);
    DriftLaw drift = find_drift_law(logs, presumed.scale_arcsec, presumed.rate_arcsec_s, bias, presumed.field.of_logs);
    if (presumed.field.of_logs.empty())
        drift.sensitivity_arcsec_s_g = drift.sensitivity_per_c = numeric::refused(presumed.field.why_none);
    add(drift, c);
    // A goodness that is no number is left out: the reason stands with its constant, which is not determined.
    std::erase_if(c.goodness, [](const Goodness& g) { return !std::isfinite(g.value); });
    return c;
}

}  // namespace zlg::calibration
