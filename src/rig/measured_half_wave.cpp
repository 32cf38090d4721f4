#include <zlg/rig/measured_half_wave.hpp>

#include <algorithm>
#include <cmath>

#include "piezo_wiring.hpp"

namespace zlg::rig {

void MeasuredHalfWave::take(const core::SwitchEvent& event) {
    if (event.outcome != core::SwitchOutcome::switched) return;
    const double measured_v = event.has_half_wave ? event.half_wave_v : std::nan("");
    const double measurement_v2 = measurement_sigma_v * measurement_sigma_v;
    const double ceiling_v2 = MeasuredHalfWave{presumed_v}.variance_v2;
    double prior_v2 = std::min(variance_v2 + process_sigma_v * process_sigma_v, ceiling_v2);
    const double innovation_v = measured_v - estimate_v;
    const double innovation_v2 = innovation_v * innovation_v;
    const bool is_near = measured_v >= 0.5 * presumed_v && measured_v <= 2.0 * presumed_v;
    const bool is_inside = innovation_v2 <= gate * gate * (prior_v2 + measurement_v2);
    const int side = innovation_v > 0.0 ? 1 : -1;
    if (!is_near || (!is_inside && outlier_side != side)) {
        variance_v2 = prior_v2;
        if (is_near) outlier_side = side;
        return;
    }
    if (!is_inside) prior_v2 = innovation_v2;
    const double gain = prior_v2 / (prior_v2 + measurement_v2);
    estimate_v += gain * innovation_v;
    variance_v2 = (1.0 - gain) * prior_v2;
    outlier_side = 0;
}

double MeasuredHalfWave::sigma_v() const { return std::sqrt(variance_v2); }

// Each decade of time between the end of the gap and the measurement of the half-wave voltage adds its creep to the
// next miss. One hysteresis loop says little of the next, least of all the first: the filter's steady gain is 2/3, and
// a change of a tenth of the voltage passes its gate.
MeasuredHalfWave measured_half_wave(const config::Config& config) {
    MeasuredHalfWave made{presumed_half_wave_v(config)};
    if (has_no_hysteresis_or_creep(config)) return made;
    made.measurement_sigma_v = 0.02 * made.presumed_v;
    made.process_sigma_v = std::sqrt(4.0 / 3.0) * made.measurement_sigma_v;
    made.gate = 10.0;
    return made;
}

}  // namespace zlg::rig
