#pragma once
// Light of the two beams.
//
//   (A - B)/(A + B) = bias_sign helicity K dl        white noise in each beam
//
// The discriminator is linear up to the edge of the mode, as suits the averaged model.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

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
          stream_{config.seed, chance::Cause::light},
          deviate_(2 * static_cast<std::size_t>(config.gyro.light_samples)) {}

    // Of a half with so many samples as were configured.
    void begin_half(std::uint64_t half) {
        if (noise_ > 0.0) stream_.gauss(half, deviate_);
    }

    // All samples of a half that is lit in one mode throughout, at the middle of their intervals: after step
    // n_pieces, 3 n_pieces, 5 n_pieces ...
    void see(const Mode& mode, int bias_sign, std::span<const double> length_lambda, std::size_t n_pieces,
             std::span<float> a, std::span<float> b) const {
        const double centre = 0.5 * static_cast<double>(mode.centre_half_lambda);
        const double slope = light_level * bias_sign * mode.helicity() * slope_per_lambda_;
        const double* const of_b = deviate_.data() + a.size();
        for (std::size_t k = 0; k < a.size(); ++k) {
            const double signal = slope * (length_lambda[(2 * k + 1) * n_pieces] - centre);
            a[k] = static_cast<float>((light_level + signal) + noise_ * deviate_[k]);
            b[k] = static_cast<float>((light_level - signal) + noise_ * of_b[k]);
        }
    }

    Beams sample(std::size_t k, const Mode& mode, int bias_sign, const LightParts& left = {}) const {
        const double signal = bias_sign * mode.helicity() * slope_per_lambda_ * mode.detuning_lambda;
        const double a = light_level * left.a;
        const double b = light_level * left.b;
        if (mode.two_way()) return noisy(k, a * (1.0 + signal), b * (1.0 - signal));
        return signal > 0.0 ? noisy(k, a, 0.0) : noisy(k, 0.0, b);
    }

private:
    [[nodiscard]] Beams noisy(std::size_t k, double a, double b) const {
        const std::size_t n = deviate_.size() / 2;
        return {static_cast<float>(a + noise_ * deviate_[k]), static_cast<float>(b + noise_ * deviate_[n + k])};
    }

    double slope_per_lambda_;
    double noise_;
    Noise stream_;
    std::vector<double> deviate_;  // of beam A, then of beam B
};

}  // namespace zlg::twin
