#pragma once
// The high-voltage stage as the digital loop presumes it: an RC lag whose current is limited.
//
//   dv/dt = clip((command - v)/rc, +-slew)
//
// It predicts the part of a command that is still in flight, and the command that brings the voltage to its target
// soonest.

#include <array>
#include <cstdint>

#include <zlg/core/control/piezo_range.hpp>
#include <zlg/core/records.hpp>

namespace zlg::core {

struct StageModel {
    double rc_s;
    double slew_v_s;
    double piece_s;  // for which a set-point holds
    double decay;    // exp(-piece_s/rc_s)
};

[[nodiscard]] StageModel stage_model(double rc_s, double slew_v_s, double piece_s) noexcept;

struct StageMove {
    std::array<double, max_set_points> set_point_v{};
    double mean_v = 0.0;  // over the n set-points
    double end_v = 0.0;
};

// Drive the voltage towards `target_v`, within the range, with n set-points: each beyond the target as far as brings it
// there within its piece, as long as the current limit allows.
[[nodiscard]] StageMove move_towards(const StageModel& stage, const PiezoRange& range, double from_v, double target_v,
                                     std::int32_t n) noexcept;

}  // namespace zlg::core
