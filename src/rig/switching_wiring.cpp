#include "switching_wiring.hpp"

#include <algorithm>
#include <cmath>

#include <zlg/config/schema.hpp>

namespace zlg::rig {

std::int64_t ticks_of(double time_s, double tick_s) {
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::llround(time_s / tick_s)));
}

core::SwitchScheduleConfig schedule_of(const config::Config& config) {
    if (config.switching.interval_optimal)
        throw config::ConfigError{
            "switching.interval_s = \"optimal\" must be resolved into seconds before a gyro can run"};
    const config::Switching& sw = config.switching;
    return {.interval_ticks = ticks_of(sw.interval_s, config.gyro.tick_s),
            .first_segment = sw.first_segment,
            .kind = sw.schedule,
            .min_ticks = ticks_of(sw.interval_min_s, config.gyro.tick_s),
            .max_ticks = ticks_of(sw.interval_max_s, config.gyro.tick_s),
            .tick_s = config.gyro.tick_s,
            .presumed = {.switch_error_arcsec = sw.switch_error_arcsec, .magnetic_arcsec_s = sw.magnetic_arcsec_s}};
}

}  // namespace zlg::rig
