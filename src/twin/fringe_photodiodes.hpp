#pragma once
// The two photodiodes of the beat, sampled at the latch.
//
//   c = o_c + A cos p,  s = o_s + (1 + e) A sin(p + d)          white noise in each, then the converter
//
// The latch is a reversal of the bias: there the beat turns round, its frequency going through f t/(t_e/2) from one
// sign to the other. A sample that is taken tau later sees the phase
//
//   p(tau) = p - sign f tau^2/t_e + r tau,  |tau| < t_e/2       f: the plateau, sign: of the half that ends, r:
//   rotation
//
// and further off the plateau of the new sign.

#include <cmath>
#include <cstdint>
#include <numbers>

#include <zlg/core/common/maths.hpp>
#include <zlg/core/records.hpp>
#include <zlg/twin/twin_config.hpp>

#include "converters.hpp"
#include "noise.hpp"

namespace zlg::twin {

// The beat at the latch.
struct LatchedBeat {
    double turns = 0.0;         // its phase
    double amplitude = 0.0;     // over that at the centre
    std::uint64_t quarter = 0;  // of the turn, by the comparators; its two lowest bits
    double plateau_hz = 0.0;    // of the bias in the half that ends, with its sign
    double rotation_hz = 0.0;
};

class FringePhotodiodes {
public:
    explicit FringePhotodiodes(const TwinConfig& config)
        : on_{config.gyro.readout == Readout::phase},
          config_{config.photodiodes},
          edge_s_{config.gyro.bias_edge_s},
          adc_{-photodiode_range, photodiode_range, config.photodiodes.adc_bits},
          noise_{config.seed, chance::Cause::fringe},
          jitter_{config.seed, chance::Cause::fringe_jitter} {}

    void sample(std::uint64_t half, const LatchedBeat& beat, core::SensorFrame& sensor) {
        if (!on_) return;
        const double tau_s = config_.skew_s + (config_.jitter_s > 0.0 ? config_.jitter_s * jitter_.gauss(half) : 0.0);
        const double phase_rad = 2.0 * std::numbers::pi * (beat.turns + turned_back(beat, tau_s));
        const double angle_rad = config_.angle_error_deg * std::numbers::pi / 180.0;
        sensor.has_fringe = true;
        sensor.fringe_quarter = static_cast<std::uint8_t>(beat.quarter & 3u);
        sensor.fringe_c = seen(half, 0, config_.offset_cosine + beat.amplitude * core::maths::cos(phase_rad));
        sensor.fringe_s = seen(half, 1,
                               config_.offset_sine + (1.0 + config_.amplitude_error) * beat.amplitude *
                                                         core::maths::sin(phase_rad + angle_rad));
    }

private:
    [[nodiscard]] double turned_back(const LatchedBeat& beat, double tau_s) const {
        if (tau_s == 0.0) return 0.0;
        const double away_s = std::abs(tau_s);
        const double within = edge_s_ > 0.0 ? std::fmin(away_s, 0.5 * edge_s_) : 0.0;
        const double on_edge = within > 0.0 ? within * within / edge_s_ : 0.0;
        return beat.rotation_hz * tau_s - beat.plateau_hz * (on_edge + (away_s - within));
    }

    float seen(std::uint64_t half, std::size_t diode, double value) {
        const double noise = config_.noise > 0.0 ? config_.noise * noise_.gauss(half, diode) : 0.0;
        return static_cast<float>(adc_.quantised_v(value + noise));
    }

    bool on_;
    PhotodiodesConfig config_;
    double edge_s_;
    Converter adc_;
    NoiseAhead<2> noise_;
    NoiseAhead<1> jitter_;
};

}  // namespace zlg::twin
