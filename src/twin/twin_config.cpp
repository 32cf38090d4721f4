#include <zlg/twin/twin_config.hpp>

#include <zlg/twin/averaged_laser.hpp>

namespace zlg::twin {

// The reversals, linear in time and centred on the border of halves, take the area of one duration from each half.
TwinConfig with_laser(TwinConfig config, const AveragedLaser& laser) {
    config.bias_hz = config.beats.counts_per_turn * laser.bias_hz * (1.0 - config.bias_edge_s / config.tick_s);
    config.bias_chi = laser.bias_chi;
    config.discriminator_per_lambda = laser.discriminator_per_lambda;
    return config;
}

}  // namespace zlg::twin
