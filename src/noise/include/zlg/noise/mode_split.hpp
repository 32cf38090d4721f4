#pragma once
// A switched gyro's rate, split into what follows the mode and what does not.
//
// y_k = mean rate of segment k between two switches, m_k = +1 or -1 its mode, t_k its middle. Over three neighbours a
// steady growth of either part drops out:
//
//   non-magnetic (half-sum)      (y_{k-1} + 2 y_k + y_{k+1})/4
//   magnetic (half-difference)   m_k (2 y_k - y_{k-1} - y_{k+1})/4
//
// Both with the warming of eq (5), by least squares over all segments, weighted by their length:
//
//   y_k = Om_nm + m_k (Om_0 + A (1 - exp(-t_k/tau)))
//
// The mean over a segment has the weight u^2 (1 - u)^2, u = 0..1 along it, so that a vibration and what is left
// of a switch at its ends weigh nothing.

#include <cstdint>
#include <span>
#include <vector>

#include <zlg/numeric/estimate.hpp>

namespace zlg::noise {

struct ModeSegment {
    std::int8_t mode = 1;
    double time_s = 0.0;  // middle
    double known_s = 0.0;
    double rate_arcsec_s = 0.0;
};

struct ModePoint {
    double time_s = 0.0;
    double magnetic_arcsec_s = 0.0;
    double nonmagnetic_arcsec_s = 0.0;
};

// The angle from the first missing sample to the end of the settling, less that of the segments beside it at their mean
// rates: at rest the error of the switch, on a moving base that of the motion too.
struct SwitchAngle {
    double time_s = 0.0;
    std::int8_t mode_after = 1;
    double error_arcsec = 0.0;
};

struct SwitchStatistics {
    std::int64_t n = 0;
    double mean_arcsec = 0.0;
    double mean_sigma_arcsec = 0.0;
    double rms_arcsec = 0.0;
    double max_arcsec = 0.0;           // magnitude
    double mean_by_mode_arcsec = 0.0;  // mean of mode_after times the error: what alternates from switch to switch
};

struct ModeSplit {
    std::vector<ModeSegment> segments;
    std::vector<ModePoint> points;  // of every segment with two neighbours
    numeric::Estimate nonmagnetic_arcsec_s;
    numeric::Estimate magnetic_arcsec_s;  // Om_0
    numeric::Estimate magnetic_thermal_arcsec_s;
    numeric::Estimate thermal_time_s;
    // Om_0 + A (1 - exp(-t/tau)) as it fits best, determined or not; tau 0: constant.
    double fitted_magnetic = 0.0, fitted_thermal = 0.0, fitted_time_s = 0.0;
    std::vector<SwitchAngle> switches;
    SwitchStatistics statistics;

    [[nodiscard]] double magnetic_at(double time_s) const;
};

struct ModeRecord {
    double rate_hz = 1.0;
    std::span<const double> rates_arcsec_s;    // NaN where nothing was measured, as in the gap of a switch
    std::span<const double> bridged_arcsec_s;  // with the gaps filled as the gyro's compensation did; empty: not known
    std::span<const std::int8_t> mode;         // as many
};

// settling  samples after a gap that belong to the switch.
//
// return  of a record that is never switched one segment and no more.
// errors  SeriesError: lengths differ.
[[nodiscard]] ModeSplit split_modes(const ModeRecord& record, std::int64_t settling);

// Subtracts the magnetic part.
void take_out_magnetic(const ModeSplit& split, std::span<const std::int8_t> mode, double rate_hz,
                       std::span<double> rates_arcsec_s);

}  // namespace zlg::noise
