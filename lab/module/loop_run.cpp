// The closed loop of one configuration, from its settings as text.
#include "loop_run.hpp"

#include <utility>

#include <zlg/config/schema.hpp>
#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/laser_agreement.hpp>
#include <zlg/rig/wiring.hpp>

namespace zlg::lab {
namespace {

twin::Motion turned(const twin::Motion& motion, std::shared_ptr<const HandTurns> hand) {
    return hand ? twin::Motion::with_steps(motion, std::move(hand)) : motion;
}

}  // namespace

config::Config asked(std::span<const std::string> settings) {
    config::Config config;
    for (const std::string& setting : settings) config::apply_set(config, setting);
    config::check(config);
    return config;
}

config::Config configured(std::span<const std::string> settings) {
    return rig::agreed_with_laser(asked(settings)).config;
}

LoopRun::LoopRun(const config::Config& config, std::shared_ptr<const HandTurns> hand)
    : tick_s_{config.gyro.tick_s},
      run_halves_{2 * rig::run_ticks(config, rig::motion(config))},
      loop_{config, turned(rig::motion(config), std::move(hand))},
      replay_{rig::asked_compensation(config)} {}

}  // namespace zlg::lab
