#include "monitor_wiring.hpp"

#include <algorithm>
#include <cstdint>

#include "bias_wiring.hpp"

namespace zlg::rig {
namespace {

// Counts of a half at which a counter that follows no faster would stop.
std::int64_t counts_limit(const config::Config& config) {
    const double most = 0.5 * config.gyro.tick_s * counter_max_hz(config.gyro);
    return static_cast<std::int64_t>(std::clamp(most - 1.0, 1.0, 0x1p62));
}

}  // namespace

void add_monitors(const config::Config& config, core::GyroControlConfig& made) {
    const config::Gyro& g = config.gyro;
    const double bias_counts = 0.5 * g.tick_s * g.bias_hz;
    made.health.counts_limit = counts_limit(config);
    made.bias_monitor.presumed_counts = std::min(bias_counts, 1e15);
    if (bias_counts >= core::min_bias_counts) made.coil_monitor.tolerance_ratio = 0.5 / bias_counts;
    made.counter_monitor.watches = true;
    made.light_monitor.noise = core::Wavelengths{g.light_noise_lambda};
    // A laser whose curve is not known reads several times its detuning: the bias cannot have lost what that would take.
    const bool reads_true = g.fidelity != config::Fidelity::laser || made.detector.curve.n_nodes > 0;
    if (!reads_true) made.light_monitor.max_gain = 10.0;
    if (reads_true && g.bias_chi > 0.0 && bias_counts >= 100.0) made.light_monitor.bias_chi = g.bias_chi;
    const double false_counts = bias_counts * g.bias_chi;
    if (false_counts > 0.0) {
        const double noise_lambda2 = g.light_noise_lambda * g.light_noise_lambda;
        made.detuning_monitor.max_change_lambda2 = std::min(1.0 / false_counts + 20.0 * noise_lambda2, 1e6);
    }
    made.detuning_monitor.relock_ticks = config.compensation.relock_ticks;
}

}  // namespace zlg::rig
