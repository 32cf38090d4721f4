#pragma once
// What one gyro in closed loop makes of its time, half by half and tick by tick.

#include <cstdint>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/core/records.hpp>

namespace zlg::trials {

struct Course {
    std::vector<std::uint32_t> health;  // of each half
    std::vector<bool> half_valid;
    std::vector<double> true_arcsec;  // of each tick
    std::vector<core::AngleRow> rows;
    std::vector<core::GapReport> gaps;
    std::vector<double> detuning_lambda;  // of each tick, at its end
    std::vector<bool> lit;
    bool not_finite = false;
};

// errors  config::ConfigError.
[[nodiscard]] Course course_of(const config::Config& config, double end_s);

}  // namespace zlg::trials
