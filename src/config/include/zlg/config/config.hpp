#pragma once
// Everything configurable, as plain values: one struct per TOML section, one member per key, same names.
//
// Meaning, unit, default and range of each key stand in `key_table.cpp`, in one table that reads, checks, writes and
// documents them.

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <zlg/core/compensation/magnetic_drift.hpp>
#include <zlg/core/control/switch_schedule.hpp>
#include <zlg/core/methods.hpp>
#include <zlg/twin/environment_config.hpp>
#include <zlg/twin/fault_kinds.hpp>
#include <zlg/twin/gyro_config.hpp>
#include <zlg/twin/laser_config.hpp>

namespace zlg::config {

using core::FirstSegment;
using twin::Fidelity;
using twin::Loop;
using twin::Quadrature;
using twin::Readout;
using Schedule = core::ScheduleKind;
using Drift = twin::DriftConfig;
using twin::FieldKind;
using Course = twin::CourseConfig;
using Field = twin::FieldConfig;
using Temperature = twin::TemperatureConfig;
using Laser = twin::LaserConfig;
using Light = twin::LightConfig;
using Photodiodes = twin::PhotodiodesConfig;

enum class MotionKind { rest, constant, sine, sum, file };
enum class ColumnHolds { increment, rate };
enum class Deviation { adev, oadev, mdev, tdev, hdev, ohdev, totdev };
enum class Taus { octave, decade, all };
enum class ShownRate { deg_h, arcsec_s, deg_s, rad_s };
enum class TextSeparator { automatic, space, tab, semicolon, comma, bar };
enum class DecimalMark { automatic, point, comma };

struct Run {
    std::optional<double> duration_s;  // unset: 3600, or the length of the motion file
    std::uint64_t seed = 1;
};

// What makes the gyro itself stands in the sections of the twin; added here is what its processor presumes or does.
struct Gyro : twin::GyroConfig {
    core::DitherMethod dither = core::DitherMethod::none;
    std::optional<double> counter_max_hz;  // unset: 1.01 times that of 400 deg/s and the bias
};

struct Perimeter : twin::PerimeterConfig {
    int relock_halves = 0;  // digital loop: halves after closing in which it corrects all it sees; 0: none
    static constexpr double sample_gain = 0.12;         // in these halves, of one light sample
    static constexpr double settled_tau_s = 0.025;      // of the digital loop afterwards
    std::vector<double> discriminator_detuning_lambda;  // calibrated points of the discriminator; none: it is linear
    std::vector<double> discriminator_signal;           // (I1 - I2)/(I1 + I2) there
    double discriminator_centre_lambda = 0.0;           // detuning of the largest bias
};

struct Piezo : twin::PiezoConfig {
    double half_wave_error = 0.0;  // relative error of the U_lambda/2 that control presumes before it has measured it
};

struct Switching {
    double interval_s = 90.0;
    bool interval_optimal = false;  // interval_s = "optimal"
    FirstSegment first_segment = FirstSegment::full;
    Schedule schedule = Schedule::fixed;
    double interval_min_s = 10.0;  // of a schedule that is not fixed
    double interval_max_s = 600.0;
    int gap_ticks = 3;
    int gap_min_ticks = 0;  // from which on a switch that has arrived closes the loop; 0: gap_ticks
};

struct Compensation {
    std::optional<core::RelockMethod> relock;  // unset: mean_square where the log has detuning, none where not
    int relock_ticks = 20;
    core::BridgeMethod bridge = core::BridgeMethod::automatic;
    int extrapolation_points = 4;
    int points_before = 2;
    int points_after = 2;
    core::MagneticMethod magnetic = core::MagneticMethod::none;
    double magnetic_arcsec_s = 0.0;        // at the start, by calibration
    double magnetic_sigma_arcsec_s = 1.0;  // of that; not calibrated
    double magnetic_thermal_arcsec_s = 0.0;
    double magnetic_thermal_sigma_arcsec_s = 1.0;
    double magnetic_thermal_time_s = 3000.0;
    double lock_in_hz = 0.0;          // threshold of lock-in, by calibration; 0: not calibrated, nothing is corrected
    double lock_in_sigma_hz = 300.0;  // of that; not calibrated
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
    double scale_arcsec = 1.0;  // arcsec (or arcsec/s) per unit of the column
    double rate_hz = 100.0;     // rows per second
    std::string comment = "#";  // lines that begin with this are skipped
    int skip_lines = 0;         // numeric header lines to skip after comments and empty lines
    TextSeparator separator = TextSeparator::automatic;
    DecimalMark decimal = DecimalMark::automatic;
    std::string time_column;  // number or name; empty: looked for; "0": there is none
};

// What breaks in a simulated gyro.
struct Faults {
    // Fault number i is kind[i] from at_s[i] on.
    std::vector<twin::FaultKind> kind;
    std::vector<double> at_s;
    std::vector<double> duration_s;
    std::vector<double> size;  // in the unit of its kind
    double random_per_hour = 0.0;
    std::uint64_t random_seed = 1;
    std::vector<twin::FaultKind> random_kinds;  // none: all
};

struct Design {
    double switch_error_arcsec = 10.0;
    std::vector<double> run_lengths_s = {600.0, 900.0, 3600.0, 36000.0};
};

// What `zlg analyze` is to compute.
struct Analysis {
    std::vector<Deviation> deviations = {Deviation::oadev};
    Taus taus = Taus::octave;
    std::vector<double> taus_s;  // instead of them
    double confidence = 0.95;
    ShownRate unit = ShownRate::deg_h;
    double table_settling_s = 0.0;  // of each stage
    double table_earth_arcsec_s = 0.0;
};

struct Config {
    Run run;
    Gyro gyro;
    Laser laser;
    Drift drift;
    Temperature temperature;
    Field field;
    Perimeter perimeter;
    Piezo piezo;
    Light light;
    Photodiodes photodiodes;
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
