#include <zlg/core/control/gyro_control_state.hpp>

namespace zlg::core {

GyroControlState initial_state(const GyroControlConfig& config, std::uint64_t counter) noexcept {
    GyroControlState s;
    s.loop = initial_state(config.loop, config.mode_switch.start_set_point);
    s.half_wave = initial_state(config.half_wave, config.mode_switch.start_set_point);
    s.up.move_v = config.half_wave.half_wave.value();
    s.down.move_v = -s.up.move_v;
    s.schedule = initial_state(config.schedule);
    s.mode_switch = initial_state(config.mode_switch);
    s.counter = counter;
    s.reading_monitor.good = s.reading_monitor.last = counter;
    s.reading_monitor.mode = config.mode_switch.start_polarity;
    s.piezo_v = config.mode_switch.start_set_point.value();
    s.temperature_c = config.presumed_temperature.value();
    return s;
}

}  // namespace zlg::core
