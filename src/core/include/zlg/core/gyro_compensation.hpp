#pragma once
// Compensation: makes angle of what control recorded, half by half.
//
// It obeys the recorded mode, bias sign and loop state and never commands, so a recorded log gives the same bits as the
// live run. Two halves make a tick; a tick with an open loop or an invalid half belongs to a gap, and so does one with
// counts that go over more than one half.

#include <cstdint>

#include <zlg/core/compensation/angle.hpp>
#include <zlg/core/compensation/border.hpp>
#include <zlg/core/compensation/compensation_constants.hpp>
#include <zlg/core/compensation/counted_stretch.hpp>
#include <zlg/core/compensation/edge_shift.hpp>
#include <zlg/core/compensation/gap_bridge.hpp>
#include <zlg/core/compensation/lock_in.hpp>
#include <zlg/core/compensation/magnetic_drift.hpp>
#include <zlg/core/compensation/relock_drift.hpp>
#include <zlg/core/records.hpp>
#include <zlg/core/units.hpp>

namespace zlg::core {

struct GyroCompensationConfig {
    RelockDriftConfig relock{};
    RelockProfileConfig profile{};  // of `joint`
    GapBridgeConfig bridge{};       // its relock and relock_ticks are those of `relock` (bridge_of)
    MagneticDriftConfig magnetic{};
    LockInConfig lock_in{};
    CompensationConstants gyro{};
};

// The bridge with the re-lock that it corrects.
[[nodiscard]] constexpr GapBridgeConfig bridge_of(const GyroCompensationConfig& config) noexcept {
    GapBridgeConfig bridge = config.bridge;
    bridge.relock = config.relock.method;
    bridge.relock_ticks = config.relock.ticks;
    return bridge;
}

[[nodiscard]] GyroCompensationFault check(const GyroCompensationConfig& config) noexcept;

struct GyroCompensationState {
    bool has_first = false;
    HalfRecord first{};        // the half that waits for the other one of its tick
    bool first_waits = false;  // the last tick was tick 1 of `frequency`
    bool refused = false;      // the last half was closed, and not valid
    Border border{};           // at the end of the last half
    // Measured ticks with the place within the count at both ends less those without, 0..32.
    std::int32_t n_with_phase = 0;
    bool start_unknown = false;  // the reversal that begins the next half is recorded where none can have been
    EdgeShiftState edges{};
    CountedStretchState stretch{};
    RelockDriftState relock{};
    double bias_arcsec = 0.0;           // what a positive bias adds to a half, slow mean
    double n_bias = 0.0;                // ticks in it, up to its memory
    std::int32_t n_switches = 0;        // recent ones
    double switch_error_arcsec2 = 0.0;  // their mean square error, by the sigma of their gaps
    Angle angle{};                      // sum of all dtheta delivered
    MagneticDriftState magnetic{};
    GapBridgeState bridge{};

    friend bool operator==(const GyroCompensationState&, const GyroCompensationState&) = default;
};

struct CompensationOutput {
    bool has_sample = false;  // at the end of every tick
    AngleSample sample{};
    double angle_arcsec = 0.0;  // accumulated
};

// For the schedule of the control, which may ignore it.
[[nodiscard]] SwitchAdvice advice(const GyroCompensationConfig& config, const GyroCompensationState& state) noexcept;

// Advance by one half-period. A half with counts beyond 2^52 is invalid, and so are both halves beside an edge that is
// shifted by a quarter of a tick or more. A span below 1 counts as 1.
[[nodiscard]] CompensationOutput step(const GyroCompensationConfig& config, GyroCompensationState& state,
                                      const HalfRecord& half, LightSamples light = {}) noexcept;

// What a half-period leaves to the background, where it does (gap_bridge.hpp).
void work(const GyroCompensationConfig& config, GyroCompensationState& state, Pause pause = nullptr,
          std::span<const BankMember> bank = motion_bank) noexcept;

// The log has ended: one more report of a gap or final row at each call, until there is neither. An odd last half is
// dropped.
[[nodiscard]] DrainOutput drain(const GyroCompensationConfig& config, GyroCompensationState& state) noexcept;

}  // namespace zlg::core
