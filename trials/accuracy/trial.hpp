#pragma once
// One gyro, several compensations of the same records, and the permanent error that each switch leaves.

#include <cstdint>
#include <string>
#include <vector>

#include <zlg/core/gyro_compensation.hpp>

#include "synthetic/laws.hpp"

namespace zlg::trials {

struct AccuracyMethod {
    std::string name;
    core::GyroCompensationConfig config;
    std::vector<core::BankMember> bank{core::motion_bank.begin(), core::motion_bank.end()};  // of its estimates
};

struct SwitchTrial {
    GyroLaw gyro;
    MotionLaw motion;
    int switches = 25;
    std::int64_t learn_ticks = 5000;  // before the first switch
    std::int64_t interval_ticks =
        4000;  // at least; up to an eighth more, at random, so that no switch meets a fixed phase
    std::uint64_t seed = 1;
};

// Permanent error that one switch leaves in the angle: delivered less true rotation over all ticks that the switch
// disturbs, less the roundings of the counter at the ends of that stretch, which the next ticks give back. What remains
// is the error of the gap, of the false angle, and the roundings at the two edges of the gap.
struct SwitchError {
    double error_arcsec = 0.0;
    double sigma_arcsec = 0.0;  // claimed; infinite where no claim is made
    int sign = 1;               // of the false angle
    double tick_squares = 0.0;  // sum of (error/sigma)^2 over the ticks of the gap that claim a sigma
    int ticks_claimed = 0;
};

// By method, then by switch.
[[nodiscard]] std::vector<std::vector<SwitchError>> run_trial(const SwitchTrial& trial,
                                                              const std::vector<AccuracyMethod>& methods);

}  // namespace zlg::trials
