#pragma once
// A calibration as a table to read, as a configuration to use, and as JSON.

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <zlg/calibration/calibration.hpp>
#include <zlg/config/config.hpp>
#include <zlg/rig/laser_calibration.hpp>

namespace zlg::cli {

// What one log brought.
struct CalibrationFile {
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
    std::vector<CalibrationFile> files;
    config::Config config;          // tick, scale and reference temperature are those of the logs
    double slope_per_lambda = 1.0;  // with which their detunings were read
    std::string warning;            // of the bias frequency; empty for none
};

[[nodiscard]] std::string calibration_text(const CalibrationResult& result);

// The constants that were determined, with tick, scale and reference temperature; the others as comments.
[[nodiscard]] std::string calibration_toml(const CalibrationResult& result);

[[nodiscard]] nlohmann::json calibration_json(const CalibrationResult& result);

// What follows from a laser instead of from logs.
[[nodiscard]] std::string laser_toml(const rig::LaserCalibration& found);
[[nodiscard]] nlohmann::json laser_json(const rig::LaserCalibration& found);

}  // namespace zlg::cli
