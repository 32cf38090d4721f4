#include <zlg/twin/twin.hpp>

#include <utility>

#include "averaged_gyro.hpp"
#include "gyro.hpp"
#include "laser_gyro.hpp"
#include "validate.hpp"

namespace zlg::twin {
namespace {

std::unique_ptr<Gyro> make_gyro(const TwinConfig& config, Motion motion) {
    validate(config);
    if (config.gyro.fidelity == Fidelity::laser) return std::make_unique<LaserGyro>(config, std::move(motion));
    return std::make_unique<AveragedGyro>(config, std::move(motion));
}

}  // namespace

Twin::Twin(const TwinConfig& config, Motion motion) : gyro_{make_gyro(config, std::move(motion))} {}
Twin::~Twin() = default;
Twin::Twin(Twin&&) noexcept = default;
Twin& Twin::operator=(Twin&&) noexcept = default;

TwinHalf Twin::advance(const core::ActuatorFrame& actuator) { return gyro_->advance(actuator); }

}  // namespace zlg::twin
