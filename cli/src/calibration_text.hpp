#pragma once
// A calibration as a table to read, and as JSON.

#include <string>

#include <nlohmann/json.hpp>

#include <zlg/study/calibrate.hpp>

namespace zlg::cli {

[[nodiscard]] std::string calibration_text(const study::CalibrationResult& result);
[[nodiscard]] nlohmann::json calibration_json(const study::CalibrationResult& result);

// What follows from a laser instead of from logs.
[[nodiscard]] nlohmann::json laser_json(const rig::LaserCalibration& found);

}  // namespace zlg::cli
