// The closed loop of one configuration, from its settings as text.
#include "loop_run.hpp"

#include <zlg/config/schema.hpp>
#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/laser_agreement.hpp>
#include <zlg/rig/wiring.hpp>

namespace zlg::lab {

config::Config configured(std::span<const std::string> settings) {
    config::Config config;
    for (const std::string& setting : settings) config::apply_set(config, setting);
    config::check(config);
    return rig::agreed_with_laser(config).config;
}

LoopRun::LoopRun(const config::Config& config)
    : tick_s_{config.gyro.tick_s},
      run_halves_{2 * rig::run_ticks(config, rig::motion(config))},
      loop_{config, rig::motion(config)},
      replay_{rig::asked_compensation(config)} {}

}  // namespace zlg::lab
