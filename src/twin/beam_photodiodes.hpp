#pragma once
// What the photodiodes of the two beams make of their light: unequal gains, offsets, and the power that falls with the
// years of the tube.

#include <array>
#include <cstddef>

#include <zlg/core/common/maths.hpp>
#include <zlg/core/records.hpp>
#include <zlg/twin/gyro_config.hpp>

#include "faults/fault_light.hpp"

namespace zlg::twin {

class BeamPhotodiodes {
public:
    explicit BeamPhotodiodes(const LightConfig& config) : config_{config} {}

    // Of the light over that at t = 0.
    [[nodiscard]] double power(double time_s) const {
        return config_.power_decay_per_h == 0.0 ? 1.0 : core::maths::exp(-config_.power_decay_per_h * hours(time_s));
    }

    // Mean samples of both beams at the centre of a mode.
    [[nodiscard]] std::array<double, 2> centred(double time_s) const {
        const double b = config_.gain_b * (1.0 + config_.gain_drift_per_h * hours(time_s));
        return {light_level * (power(time_s) + config_.offset_a), light_level * (power(time_s) * b + config_.offset_b)};
    }

    // The samples of a half around this time. No photodiode shows less than none.
    void see(double time_s, core::SensorFrame& sensor) const {
        const double gain_a = power(time_s);
        const double gain_b = gain_a * config_.gain_b * (1.0 + config_.gain_drift_per_h * hours(time_s));
        if (gain_a != 1.0 || config_.offset_a != 0.0) act(gain_a, config_.offset_a, sensor.light_a, sensor.n_light);
        if (gain_b != 1.0 || config_.offset_b != 0.0) act(gain_b, config_.offset_b, sensor.light_b, sensor.n_light);
    }

private:
    static double hours(double time_s) { return time_s / 3600.0; }

    static void act(double gain, double offset, auto& samples, std::size_t n) {
        for (std::size_t k = 0; k < n; ++k) {
            const double seen = gain * static_cast<double>(samples[k]) + offset * light_level;
            samples[k] = static_cast<float>(seen > 0.0 ? seen : 0.0);
        }
    }

    LightConfig config_;
};

}  // namespace zlg::twin
