#pragma once
// What `calibrate` does: the raw logs of one gyro in, its constants out, and the configuration that holds them.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <zlg/calibration/calibration.hpp>
#include <zlg/config/config.hpp>
#include <zlg/logs/raw_log.hpp>
#include <zlg/rig/laser_calibration.hpp>

namespace zlg::study {

// What one log brought.
struct CalibratedLog {
    std::string path;
    double duration_s = 0.0;
    std::int64_t segments = 0;
    std::int64_t relocks = 0;
    bool has_temperature = false;
    double temperature_min_c = 0.0;
    double temperature_max_c = 0.0;
};

struct CalibrationResult {
    calibration::Calibration calibration;
    std::vector<CalibratedLog> logs;
    config::Config config;          // tick, scale and reference temperature are those of the logs
    double slope_per_lambda = 1.0;  // with which their detunings were read
    std::string reference_warning;  // of the bias frequency, also one of `warnings`; empty for none
    std::vector<std::string> warnings;

    [[nodiscard]] bool any_determined() const;
};

struct CalibrationTask {
    std::vector<std::string> logs;           // as `open` knows them; at least one
    double rate_arcsec_s = 0.0;              // known rate of rotation
    std::string rate_name{"rate_arcsec_s"};  // begins a message about it
    // The keys that it was given go over what the logs say. Of what is to be found, only these are presumed.
    config::Config said;
    std::function<logs::RawReader(const std::string&)> open;
    std::function<void(double)> on_progress;  // of the fraction of all logs that was read; may be empty
};

// Every log is read once, row by row.
//
// errors  config::ConfigError: a rate that no gyro has, a log that is named twice, logs whose reference temperature or
// loop differ, tick or scale that nobody says or that are contradicted;
//         logs::FormatError: logs of different ticks or scales, one without a whole tick, one whose settings are wrong;
//         those of `open`.
[[nodiscard]] CalibrationResult calibrate(const CalibrationTask& task);

// The signals of the discriminator's curve, as its points were found; empty where it was not determined.
[[nodiscard]] std::vector<double> curve_signals(const CalibrationResult& result);

// A configuration: the constants that were determined, with tick, scale and reference temperature; the others as
// comments.
[[nodiscard]] std::string calibration_toml(const CalibrationResult& result);

// The same of what follows from a laser instead of from logs.
[[nodiscard]] std::string calibration_toml(const rig::LaserCalibration& found);

}  // namespace zlg::study
