// A gyro of one's own under the control and the compensation of zlg.
//
// usage: own_gyro SECONDS RATE_ARCSEC_S RAW.csv
//
// The plant below stands for a model, or for the driver of real electronics: at the end of each half it delivers a
// SensorFrame and takes the ActuatorFrame of the next one. It turns at a constant rate; its magnetic field adds to the
// angle in one mode and takes from it in the other. The raw log can be given to `zlg process` and `zlg analyze`.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include <zlg/config/config.hpp>
#include <zlg/config/schema.hpp>
#include <zlg/core/gyro_control.hpp>
#include <zlg/logs/raw_log.hpp>
#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/rig/wiring.hpp>

using namespace zlg;

namespace {

constexpr double magnetic_arcsec_s = 1.0;

// One mode lies half a wavelength beside the next, of the other helicity. The voltage reaches its set-point at once.
class Plant {
public:
    Plant(const config::Config& config, double rate_arcsec_s) : config_{config}, rate_arcsec_s_{rate_arcsec_s} {}

    core::SensorFrame advance(const core::ActuatorFrame& command) {
        const config::Gyro& gyro = config_.gyro;
        const double v = command.set_point_v[command.n_set_points - 1u];
        const double length_lambda = 0.5 * v / config_.piezo.half_wave_v + 0.08;  // the perimeter is where it is
        const double mode = std::round(2.0 * length_lambda);
        const double detuning_lambda = length_lambda - 0.5 * mode;
        const int helicity = std::fmod(std::abs(mode), 2.0) == 0.0 ? 1 : -1;
        const int sign = sequence_ % 2 == 0 ? 1 : -1;

        const double bias_hz = gyro.bias_hz * (1.0 - gyro.bias_chi * detuning_lambda * detuning_lambda);
        const double turning_hz = (rate_arcsec_s_ + helicity * magnetic_arcsec_s) / gyro.scale_arcsec;
        fringes_ += 0.5 * gyro.tick_s * (sign * helicity * bias_hz + turning_hz);

        core::SensorFrame sensor;
        sensor.sequence = sequence_++;
        sensor.timer_ticks = static_cast<std::uint64_t>(std::llround(sequence_ * 0.5 * gyro.tick_s * rig::timer_hz));
        sensor.counter = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(fringes_)));
        sensor.bias_sign = static_cast<std::int8_t>(sign);
        sensor.polarity = command.polarity;
        sensor.loop_closed = command.loop_closed;
        sensor.n_light = static_cast<std::uint8_t>(gyro.light_samples);
        sensor.has_light_b = true;
        const double signal = sign * helicity * gyro.discriminator_per_lambda * detuning_lambda;
        for (std::size_t k = 0; k < sensor.n_light; ++k) {
            sensor.light_a[k] = static_cast<float>(1.0 + signal + light_noise_(engine_));
            sensor.light_b[k] = static_cast<float>(1.0 - signal + light_noise_(engine_));
        }
        sensor.piezo_v = v;
        sensor.temperature_c = gyro.reference_temperature_c;
        return sensor;
    }

private:
    config::Config config_;
    double rate_arcsec_s_;
    double fringes_ = 0.3;
    std::uint32_t sequence_ = 0;
    // Light without noise would be taken for a converter that is stuck.
    std::normal_distribution<double> light_noise_{0.0, 1e-3};
    std::mt19937_64 engine_{1};
};

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) return 2;
    const double duration_s = std::atof(argv[1]);
    const double rate_arcsec_s = std::atof(argv[2]);

    // The keys of docs/configuration.md that say what is known of the gyro; a file would be read by config::apply_file.
    config::Config config;
    config::apply_set(config, "perimeter.loop=digital");  // the set-points are the voltage of the piezo
    config::apply_set(config, "switching.interval_s=5");
    config::apply_set(config, "compensation.relock=mean_square");
    config::check(config);

    const core::GyroControlConfig control = rig::control_config(config);
    core::GyroControlState state = initial_state(control);
    core::ActuatorFrame command = initial_actuator(control);
    Plant plant{config, rate_arcsec_s};
    rig::Replay compensation{rig::asked_compensation(config)};
    logs::RawWriter log{argv[3], config::to_settings(config), true};

    const auto n_halves = 2 * static_cast<long long>(duration_s / config.gyro.tick_s);
    double angle_arcsec = 0.0;
    int gaps = 0;
    const auto on_row = [&](const core::AngleRow& row) { angle_arcsec += row.dtheta_final_arcsec; };
    const auto on_gap = [&](const core::GapReport&) { ++gaps; };
    for (long long k = 0; k < n_halves; ++k) {
        const core::GyroControlOutput out = step(control, state, plant.advance(command));
        command = out.actuator;
        compensation.take(out.record, {}, on_row, on_gap);
        log.write(out.record);
    }
    compensation.end(on_row, on_gap);
    log.close();
    std::printf("%.6f arcsec turned, %.6f true, %d switches\n", angle_arcsec, rate_arcsec_s * duration_s, gaps);
}
