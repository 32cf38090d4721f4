#pragma once
// Everything configurable, as plain values: one struct per TOML section, one member per key, same names.
//
// Meaning, unit, default and range of each key stand in `schema.cpp`, in one table that reads, checks, writes and
// documents them.

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <zlg/config/analysis.hpp>
#include <zlg/config/faults.hpp>
#include <zlg/config/laser.hpp>
#include <zlg/core/compensation/magnetic_drift.hpp>
#include <zlg/core/methods.hpp>

namespace zlg::config {

enum class Loop { analog, exponential, digital };
enum class FirstSegment { full, half };
enum class LastSegment { any, half };
enum class Schedule { fixed, growing, measured };
enum class MotionPrior { learnt, flat, lines };
enum class MotionKind { rest, constant, sine, sum, file };
enum class ColumnHolds { increment, rate };
enum class Fidelity { averaged, laser };

struct Run {
    std::optional<double> duration_s;  // unset: 3600, or the length of the motion file
    std::int64_t seed = 1;
};

struct Gyro {
    Fidelity fidelity = Fidelity::averaged;
    double tick_s = 0.005;
    double scale_arcsec = 3.263;
    double bias_hz = 60e3;  // mean over a half, edges included, at zero detuning and reference temperature
    double bias_chi = 3.6;
    double bias_edge_s = 50e-6;
    std::int64_t first_bias_sign = 1;
    double reference_temperature_c = 20.0;
    double temperature_rise_c = 20.0;
    double bias_temperature_coefficient_per_c = 0.0;
    std::int64_t light_samples = 16;
    double light_noise_lambda = 0.0033;
    double discriminator_per_lambda = 0.332;  // (I1 - I2)/(I1 + I2) per wavelength of detuning
    core::DitherMethod dither = core::DitherMethod::none;
    std::optional<double> counter_max_hz;  // unset: 1.01 times that of 400 deg/s and the bias
};

struct Drift {
    double magnetic_arcsec_s = 0.7;
    double magnetic_thermal_arcsec_s = 0.7;
    double thermal_time_s = 3000.0;
    double nonmagnetic_arcsec_s = 0.05;
    double random_walk_arcsec_sqrt_s = 0.14;
};

struct Perimeter {
    Loop loop = Loop::analog;
    double tau_s = 0.0065;
    double limit_lambda = 0.09;
    double miss_lambda = 0.22;
    double expansion_lambda_per_c = 0.025;
    std::int64_t relock_halves = 0;  // digital loop: halves after closing in which it corrects all it sees; 0: none
    double sample_gain = 0.12;       // in these halves, of one light sample
    double settled_tau_s = 0.025;    // of the digital loop afterwards
    std::int64_t set_points = 16;    // a half, of the digital loop
    std::vector<double> discriminator_detuning_lambda;  // calibrated points of the discriminator; none: it is linear
    std::vector<double> discriminator_signal;           // (I1 - I2)/(I1 + I2) there
    double discriminator_centre_lambda = 0.0;           // detuning of the largest bias
};

struct Piezo {
    double half_wave_v = 40.0;  // at the reference temperature of [gyro]
    double half_wave_temperature_coefficient_per_c = 0.0;
    double half_wave_error = 0.0;  // relative error of the U_lambda/2 that control presumes before it has measured it
    double rc_s = 0.001;
    double slew_v_s = 4000.0;
    double range_min_v = 0.0;
    double range_max_v = 300.0;
    double hysteresis = 0.0;  // width of a loop of stroke hysteresis_stroke_v over its height; 0: none
    double hysteresis_stroke_v = 300.0;
    double creep_per_decade = 0.0;  // growth of a stroke per decade of time; 0: none
    double mirror_hz = 0.0;         // resonance of the mirror; 0: rigid
    double mirror_damping = 0.05;
    std::int64_t dac_bits = 12;
    std::int64_t adc_bits = 12;
    double adc_noise_v = 0.02;
};

struct Switching {
    double interval_s = 90.0;
    bool interval_optimal = false;  // interval_s = "optimal"
    FirstSegment first_segment = FirstSegment::full;
    LastSegment last_segment = LastSegment::any;
    Schedule schedule = Schedule::fixed;
    double interval_min_s = 10.0;  // of a schedule that is not fixed
    double interval_max_s = 600.0;
    double switch_error_arcsec = 2.0;  // presumed, of one switch, rms
    double magnetic_arcsec_s = 0.7;    // presumed
    std::int64_t gap_ticks = 3;
    std::int64_t gap_min_ticks = 0;  // from which on a switch that has arrived closes the loop; 0: gap_ticks
};

struct Compensation {
    std::optional<core::RelockMethod> relock;  // unset: mean_square where the log has detuning, none where not
    std::int64_t relock_ticks = 20;
    core::BridgeMethod bridge = core::BridgeMethod::automatic;
    std::int64_t extrapolation_points = 4;
    std::int64_t points_before = 2;
    std::int64_t points_after = 2;
    MotionPrior prior = MotionPrior::learnt;  // of bridge = "optimal"
    double prior_band_hz = 24.0;              // of a flat prior: 0.12 in a tick of 5 ms
    double prior_rate_arcsec_s = 8485.0;      // its rms rate: that of a sine of 12 000 arcsec/s
    std::vector<double> prior_line_hz = {20.0};
    std::vector<double> prior_line_arcsec_s = {12000.0};  // amplitudes
    core::MagneticMethod magnetic = core::MagneticMethod::none;
    double magnetic_arcsec_s = 0.0;         // at the start, by calibration
    double magnetic_sigma_arcsec_s = 10.0;  // of that; large: not calibrated
    double magnetic_thermal_arcsec_s = 0.0;
    double magnetic_thermal_sigma_arcsec_s = 10.0;
    double magnetic_thermal_time_s = 3000.0;
};

struct Motion {
    MotionKind kind = MotionKind::sine;
    double rate_arcsec_s = 0.0;                          // a constant rate that is added to sine and sum
    std::vector<double> amplitude_arcsec_s = {12000.0};  // one number for sine, one or more for sum
    std::vector<double> frequency_hz = {7.03};
    std::vector<double> phase_deg = {0.0};
    std::string path;
    std::string column;  // number from 1, or name; empty: 1
    ColumnHolds column_holds = ColumnHolds::increment;
    double scale_arcsec = 1.0;    // arcsec (or arcsec/s) per unit of the column
    double rate_hz = 100.0;       // rows per second
    std::string comment = "#";    // lines that begin with this are skipped
    std::int64_t skip_lines = 0;  // numeric header lines to skip after comments and empty lines
    TextSeparator separator = TextSeparator::automatic;
    DecimalMark decimal = DecimalMark::automatic;
    std::string time_column;  // number or name; empty: looked for; "0": there is none
};

struct Design {
    double switch_error_arcsec = 10.0;
    std::vector<double> run_lengths_s = {600.0, 900.0, 3600.0, 36000.0};
};

struct Config {
    Run run;
    Gyro gyro;
    Laser laser;
    Drift drift;
    Perimeter perimeter;
    Piezo piezo;
    Switching switching;
    Compensation compensation;
    Motion motion;
    Faults faults;
    Design design;
    Analysis analysis;

    // Keys that a layer has set, as they are written (`gyro.tick_s`), whatever to: see `is_given`.
    std::set<std::string, std::less<>> given;
};

}  // namespace zlg::config
