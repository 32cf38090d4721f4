#include <zlg/rig/closed_loop.hpp>

#include <stdexcept>

#include <zlg/config/schema.hpp>
#include <zlg/rig/wiring.hpp>

namespace zlg::rig {
namespace {

twin::Twin make_twin(const config::Config& config, twin::Motion motion) {
    try {
        return twin::Twin{twin_config(config), std::move(motion)};
    } catch (const std::invalid_argument& error) {
        throw config::ConfigError{error.what()};
    }
}

}  // namespace

ClosedLoop::ClosedLoop(const config::Config& config, twin::Motion motion)
    : twin_{make_twin(config, std::move(motion))},
      control_config_{control_config(config)},
      control_state_{initial_state(control_config_)},
      actuator_{initial_actuator(control_config_)} {}

LoopHalf ClosedLoop::advance() {
    const twin::TwinHalf half = twin_.advance(actuator_);
    LoopHalf out;
    out.control = step(control_config_, control_state_, half.sensor);
    out.record = out.control.record;
    out.truth = half.truth;
    out.half_wave_v = control_state_.half_wave.estimate_v;
    out.half_wave_sigma_v = sigma(control_state_.half_wave).value();
    actuator_ = out.control.actuator;
    return out;
}

}  // namespace zlg::rig
