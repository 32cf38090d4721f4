#pragma once
// One gyro as its processor holds it: control and compensation in a row, half-period by half-period.
//
// Nothing here knows a board: the same source runs on the host, where it is tested.

#include <cstdint>

#include <zlg/core/gyro_compensation.hpp>
#include <zlg/core/gyro_control.hpp>
#include <zlg/core/records.hpp>

namespace zlg::firmware {

// What the gyro runs by.
struct Settings {
    core::GyroControlConfig control{};
    core::GyroCompensationConfig compensation{};
};

// Which part refuses its configuration, and what its check says.
struct SettingsFault {
    core::GyroControlFault control = core::GyroControlFault::none;
    core::GyroCompensationFault compensation = core::GyroCompensationFault::none;

    friend bool operator==(const SettingsFault&, const SettingsFault&) = default;
};

[[nodiscard]] SettingsFault check(const Settings& settings) noexcept;

struct GyroState {
    core::GyroControlState control{};
    core::GyroCompensationState compensation{};

    friend bool operator==(const GyroState&, const GyroState&) = default;
};

struct HalfOutput {
    core::GyroControlOutput control{};
    core::CompensationOutput compensation{};
};

class Gyro {
public:
    // Begin anew. The settings have passed `check`.
    //
    // counter  reading of the fringe counter when the first half begins.
    // return   what is commanded for the first half.
    core::ActuatorFrame start(const Settings& settings, std::uint64_t counter = 0) noexcept;

    // Advance by one half-period: call it once per half, also when its frame was missed.
    //
    // frame  one that claims more than core::max_light_samples light samples has none.
    // cost   that of both parts of the core; no allocation.
    [[nodiscard]] HalfOutput half(const core::SensorFrame& frame) noexcept;

    // From now on the caller works between the half-periods (`work`), which may interrupt that; else a half does it at
    // its end.
    void work_in_background() noexcept { state_.compensation.bridge.background.worker.is_background = true; }

    // What the halves have left to do: up to 80 ms. `pause` is called within.
    void work(core::Pause pause = nullptr) noexcept;

    // The angle that is still due when no more halves come, one report at each call, until there is none.
    [[nodiscard]] core::DrainOutput drain() noexcept;

    // The reading at the start was not known: the next half, the first one, is not counted.
    void forget_counter() noexcept {
        core::GyroControlState& control = state_.control;
        control.counter_stale = true;
        control.reading_monitor.countable = control.reading_monitor.has_last = false;
    }

    // While held nothing is switched by the schedule; forced it is once, held or not.
    void hold_switching(bool held) noexcept { state_.control.schedule.held = held; }
    void force_switch() noexcept { state_.control.schedule.asked = true; }

    [[nodiscard]] const Settings& settings() const noexcept { return settings_; }
    [[nodiscard]] const GyroState& state() const noexcept { return state_; }

private:
    Settings settings_{};
    GyroState state_{};
};

}  // namespace zlg::firmware
