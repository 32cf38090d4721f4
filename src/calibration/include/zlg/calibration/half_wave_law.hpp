#pragma once
// U_lambda/2 and its law with temperature, from the voltage before and after switches.
//
//   |U- - U+| = m U0 (1 + beta (T - T_ref)),  m = 1, 3, ... half wavelengths
//
// Both voltages are means of a settled window; the drift of the voltage between the windows follows from the slopes of
// the segments. Neighbouring switches share a segment, so their errors are correlated; the error of a converter's step
// is one and the same for all switches that meet it.

#include <cstdint>
#include <span>

#include <zlg/calibration/lab_log.hpp>
#include <zlg/numeric/estimate.hpp>

namespace zlg::calibration {

struct HalfWaveLaw {
    numeric::Estimate half_wave_v;  // at the reference temperature
    numeric::Estimate temperature_coefficient_per_c;
    std::int64_t n_switches = 0;
    double scatter_v = 0.0;  // rms of one switch about the law
};

// presumed_per_c  the coefficient where the data determine none.
[[nodiscard]] HalfWaveLaw find_half_wave_law(std::span<const LabLog> logs, double reference_temperature_c,
                                             double presumed_per_c);

}  // namespace zlg::calibration
