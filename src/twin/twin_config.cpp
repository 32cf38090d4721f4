#include <zlg/twin/twin_config.hpp>

#include <zlg/twin/averaged_laser.hpp>

namespace zlg::twin {

// The reversals, linear in time and centred on the border of halves, take the area of one duration from each half.
GyroConfig with_laser(GyroConfig gyro, Quadrature quadrature, const AveragedLaser& laser) {
    gyro.bias_hz = counts_per_turn(quadrature) * laser.bias_hz * (1.0 - gyro.bias_edge_s / gyro.tick_s);
    gyro.bias_chi = laser.bias_chi;
    gyro.discriminator_per_lambda = laser.discriminator_per_lambda;
    return gyro;
}

}  // namespace zlg::twin
