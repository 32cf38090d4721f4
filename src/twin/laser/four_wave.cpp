#include <zlg/twin/four_wave.hpp>

#include "gas.hpp"
#include "laser_frame.hpp"

namespace zlg::twin {
namespace {

const LaserConfig& validated(const LaserConfig& config) {
    validate(config);
    return config;
}

}  // namespace

FourWave::FourWave(const LaserConfig& config)
    : config_{validated(config)}, gas_{std::make_shared<const Gas>(config_)}, centre_intensity_{at(0.0, 0.0).left.cw} {}

LaserLight FourWave::at(double perimeter_lambda, double field_g) const {
    const LaserFrame frame{perimeter_lambda, field_g};
    const GasPoint point = gas_->at(frame.near_lambda, frame.far_lambda, gas_->shift_of(frame.field_g));
    return frame.light(point.light(steady_state(point.competition)));
}

}  // namespace zlg::twin
