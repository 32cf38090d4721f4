#pragma once
// One gyro in closed loop, half by half and tick by tick.

#include <cstdint>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/core/records.hpp>

namespace zlg::trials {

struct GyroHistory {
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
[[nodiscard]] GyroHistory simulate(const config::Config& config, double end_s);

}  // namespace zlg::trials
