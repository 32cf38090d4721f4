#include <zlg/rig/asked_compensation.hpp>

#include <zlg/rig/wiring.hpp>

namespace zlg::rig {

using core::RelockMethod;

RelockMethod asked_relock(const config::Config& config) {
    return config.compensation.relock.value_or(RelockMethod::mean_square);
}

core::GyroCompensationConfig asked_compensation(const config::Config& config) {
    return compensation_config(config, asked_relock(config), config.compensation.bridge);
}

config::Settings angle_settings(config::Config config) {
    config.compensation.relock = asked_relock(config);
    config::Settings settings;
    for (const auto& setting : config::to_settings(config))
        if (setting.first.starts_with("gyro.") || setting.first.starts_with("compensation.") ||
            setting.first == "switching.gap_ticks" || setting.first == "drift.random_walk_arcsec_sqrt_s" ||
            setting.first.starts_with("perimeter.discriminator_"))
            settings.push_back(setting);
    return settings;
}

}  // namespace zlg::rig
