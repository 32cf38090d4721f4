#include <zlg/twin/twin.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bias_area.hpp"
#include "converters.hpp"
#include "fringe_counter.hpp"
#include "noise.hpp"
#include "perimeter.hpp"
#include "photodiodes.hpp"
#include "validate.hpp"

namespace zlg::twin {
namespace {

constexpr double timer_hz = 1e7;
constexpr double coil_plateau_a = 1.0;

// Pieces of one light-sample interval: an odd number, so that the sample lies in the middle of a piece. Simpson's rule
// on pieces of 200 us, or a twentieth of the loop's time constant, is good to 1e-7 of the false angle.
int pieces_per_sample(const TwinConfig& config) {
    constexpr double max_piece_s = 200e-6;
    constexpr int max_pieces = 4096;
    const double interval_s = 0.5 * config.tick_s / config.light_samples;
    const double wanted = std::ceil(interval_s / std::min(max_piece_s, config.loop_tau_s / 20.0));
    const int pieces = static_cast<int>(std::clamp(wanted, 1.0, max_pieces / double{core::max_light_samples}));
    return pieces | 1;
}

const TwinConfig& validated(const TwinConfig& config) {
    validate(config);
    return config;
}

}  // namespace

struct Twin::State {
    State(const TwinConfig& twin_config, Motion twin_motion);

    TwinHalf advance(const core::ActuatorFrame& actuator);

    BiasArea live_through_half(int bias_sign, TwinHalf& half);
    void count(const BiasArea& area, int bias_sign, TwinHalf& half);
    void read_out(const core::ActuatorFrame& actuator, int bias_sign, TwinHalf& half);

    [[nodiscard]] double warming_at(std::uint64_t at_half) const;
    [[nodiscard]] double drift_lambda(double warming) const;
    [[nodiscard]] double bias_hz() const;
    [[nodiscard]] double half_wave_v() const;

    const TwinConfig config;
    const Motion motion;
    const double half_s;
    const int n_pieces;  // of one light-sample interval
    const Converter adc;
    Perimeter perimeter;
    Photodiodes photodiodes;
    NoiseStream walk_noise;
    NoiseStream adc_noise;
    NoiseStream dark_noise;
    FringeCounter counter;
    std::uint64_t index = 0;     // of the half that comes next
    double warming_start = 0.0;  // 1 - exp(-t/thermal_time_s) at the start and the end of the half
    double warming_end = 0.0;
    double garbage_cycles = 0.0;
};

Twin::State::State(const TwinConfig& twin_config, Motion twin_motion)
    : config{validated(twin_config)},
      motion{std::move(twin_motion)},
      half_s{0.5 * config.tick_s},
      n_pieces{pieces_per_sample(config)},
      adc{config.piezo_min_v, config.piezo_max_v, config.adc_bits},
      perimeter{config, 2 * n_pieces * config.light_samples},
      photodiodes{config},
      walk_noise{config.seed, NoiseCause::random_walk},
      adc_noise{config.seed, NoiseCause::adc},
      dark_noise{config.seed, NoiseCause::dark_counts},
      counter{NoiseStream{config.seed, NoiseCause::start_phase}.uniform()} {}

double Twin::State::warming_at(std::uint64_t at_half) const {
    return -std::expm1(-static_cast<double>(at_half) * half_s / config.thermal_time_s);
}

double Twin::State::drift_lambda(double warming) const {
    return config.expansion_lambda_per_c * config.temperature_rise_c * warming;
}

double Twin::State::bias_hz() const {
    const double above_reference_c = config.temperature_rise_c * 0.5 * (warming_start + warming_end);
    return config.bias_hz * (1.0 + config.bias_temperature_coefficient_per_c * above_reference_c);
}

double Twin::State::half_wave_v() const {
    const double above_reference_c = config.temperature_rise_c * warming_end;
    return config.half_wave_v * (1.0 + config.half_wave_temperature_coefficient_per_c * above_reference_c);
}

TwinHalf Twin::State::advance(const core::ActuatorFrame& actuator) {
    const int bias_sign = index % 2 == 0 ? config.first_bias_sign : -config.first_bias_sign;
    const double warming_next = warming_at(index + 1);
    if (config.half_wave_temperature_coefficient_per_c != 0.0) perimeter.take_half_wave(half_wave_v());
    perimeter.begin_half(actuator, drift_lambda(warming_end), drift_lambda(warming_next));
    warming_start = std::exchange(warming_end, warming_next);

    TwinHalf half;
    const BiasArea area = live_through_half(bias_sign, half);
    count(area, bias_sign, half);
    ++index;
    read_out(actuator, bias_sign, half);
    return half;
}

// Step through the light samples: each at the middle of its interval, all of the bias on the way.
BiasArea Twin::State::live_through_half(int bias_sign, TwinHalf& half) {
    const int n_samples = config.light_samples;
    const double piece_s = half_s / (n_pieces * n_samples);
    BiasArea area;
    garbage_cycles = 0.0;
    Mode start = perimeter.mode();
    area.subtract_edge(start, config.bias_edge_s);
    for (int sample = 0; sample < n_samples; ++sample) {
        for (int piece = 0; piece < n_pieces; ++piece) {
            perimeter.step();
            const Mode middle = perimeter.mode();
            if (piece == n_pieces / 2) {
                const Photodiodes::Beams beams = photodiodes.sample(middle, bias_sign);
                half.sensor.light_a[static_cast<std::size_t>(sample)] = beams.a;
                half.sensor.light_b[static_cast<std::size_t>(sample)] = beams.b;
            }
            perimeter.step();
            const Mode end = perimeter.mode();
            if (!area.add(start, middle, end, piece_s)) {
                half.truth.lit = false;
                garbage_cycles += piece_s * bias_hz() * (2.0 * dark_noise.uniform() - 1.0);
            }
            start = end;
        }
    }
    area.subtract_edge(start, config.bias_edge_s);
    half.truth.detuning_end_lambda = start.detuning_lambda;
    return area;
}

//   cycles = sign p int helicity (1 - chi dl^2) shape dt + (rotation + drift)/scale
//
// Rotation is counted for the lit part of the half only: in the rest the counter shows garbage.
void Twin::State::count(const BiasArea& area, int bias_sign, TwinHalf& half) {
    const double t0_s = static_cast<double>(index) * half_s;
    const double t1_s = static_cast<double>(index + 1) * half_s;
    half.truth.dtheta_arcsec = motion.increment_arcsec(t0_s, t1_s);

    const double plateau_hz = bias_sign * bias_hz() / (1.0 - config.bias_edge_s / config.tick_s);
    const double false_cycles = -plateau_hz * config.bias_chi * area.shaped_square();
    half.truth.false_relock_arcsec = config.scale_arcsec * false_cycles;

    const double lit_part = half.truth.lit ? 1.0 : area.lit_s() / half_s;
    const double magnetic_arcsec_s =
        config.magnetic_arcsec_s + config.magnetic_thermal_arcsec_s * 0.5 * (warming_start + warming_end);
    double seen_arcsec = lit_part * half.truth.dtheta_arcsec + magnetic_arcsec_s * area.helicity_s() +
                         config.nonmagnetic_arcsec_s * lit_part * half_s;
    if (config.random_walk_arcsec_sqrt_s > 0.0) {
        seen_arcsec += config.random_walk_arcsec_sqrt_s * std::sqrt(half_s) * walk_noise.gauss();
    }
    counter.advance(plateau_hz * area.shaped_s() + false_cycles + garbage_cycles + seen_arcsec / config.scale_arcsec);
}

void Twin::State::read_out(const core::ActuatorFrame& actuator, int bias_sign, TwinHalf& half) {
    core::SensorFrame& sensor = half.sensor;
    sensor.sequence = static_cast<std::uint32_t>(index - 1);
    sensor.timer_ticks = index * static_cast<std::uint64_t>(std::llround(half_s * timer_hz));
    sensor.counter = counter.value();
    sensor.bias_sign = static_cast<std::int8_t>(bias_sign);
    sensor.polarity = actuator.polarity;
    sensor.loop_closed = actuator.loop_closed;
    sensor.n_light = static_cast<std::uint8_t>(config.light_samples);
    sensor.has_light_b = true;
    half.truth.perimeter_v = perimeter.voltage_v();
    const double noise_v = config.adc_noise_v > 0.0 ? config.adc_noise_v * adc_noise.gauss() : 0.0;
    sensor.piezo_v = adc.quantised_v(half.truth.perimeter_v + noise_v);
    sensor.coil_current_a = coil_plateau_a * bias_sign;
    sensor.temperature_c = config.reference_temperature_c + config.temperature_rise_c * warming_end;
}

Twin::Twin(const TwinConfig& config, Motion motion) : state_{std::make_unique<State>(config, std::move(motion))} {}
Twin::~Twin() = default;
Twin::Twin(Twin&&) noexcept = default;
Twin& Twin::operator=(Twin&&) noexcept = default;

TwinHalf Twin::advance(const core::ActuatorFrame& actuator) { return state_->advance(actuator); }

}  // namespace zlg::twin
