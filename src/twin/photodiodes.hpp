#pragma once
// Light of the two beams.
//
//   (A - B)/(A + B) = bias_sign helicity K dl        white noise in each beam
//
// The discriminator is linear up to the edge of the mode, as suits the averaged model.

#include <cmath>

#include <zlg/twin/twin_config.hpp>

#include "faults/fault_light.hpp"
#include "laser/laser.hpp"
#include "noise.hpp"

namespace zlg::twin {

class Photodiodes {
public:
    struct Beams {
        float a;
        float b;
    };

    explicit Photodiodes(const TwinConfig& config)
        : slope_per_lambda_{config.gyro.discriminator_per_lambda},
          // The difference of two beams has sqrt(2) times the noise of one, over a sum of two levels.
          noise_{std::sqrt(2.0) * light_level * std::abs(config.gyro.discriminator_per_lambda) *
                 config.gyro.light_noise_lambda},
          stream_{config.seed, NoiseCause::light} {}

    Beams sample(const Mode& mode, int bias_sign, const LightParts& left = {}) {
        const double signal = bias_sign * mode.helicity() * slope_per_lambda_ * mode.detuning_lambda;
        const double a = light_level * left.a;
        const double b = light_level * left.b;
        if (mode.two_way()) return noisy(a * (1.0 + signal), b * (1.0 - signal));
        return signal > 0.0 ? noisy(a, 0.0) : noisy(0.0, b);
    }

private:
    Beams noisy(double a, double b) {
        if (noise_ > 0.0) {
            a += noise_ * stream_.gauss();
            b += noise_ * stream_.gauss();
        }
        return {static_cast<float>(a), static_cast<float>(b)};
    }

    double slope_per_lambda_;
    double noise_;
    NoiseStream stream_;
};

}  // namespace zlg::twin
