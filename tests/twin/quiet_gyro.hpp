#pragma once
// A gyro without noise or drift, of equal photodiodes, and the moves that the tests make with it.

#include <zlg/twin/twin.hpp>

#include "test.hpp"

namespace zlg::twin {

inline TwinConfig quiet_gyro() {
    TwinConfig config;
    config.light = equal_light;
    config.gyro.light_noise_lambda = 0.0;
    config.drift.magnetic_arcsec_s = 0.0;
    config.drift.magnetic_thermal_arcsec_s = 0.0;
    config.drift.nonmagnetic_arcsec_s = 0.0;
    config.drift.random_walk_arcsec_sqrt_s = 0.0;
    config.piezo.adc_noise_v = 0.0;
    config.coil_noise_a = 0.0;
    config.perimeter.expansion_lambda_per_c = 0.0;
    return config;
}

// The perimeter is held, not regulated: it stays where the set-point puts it.
inline TwinConfig held_gyro() {
    TwinConfig config = quiet_gyro();
    config.perimeter.loop = Loop::digital;
    config.perimeter.miss_lambda = 0.0;
    config.piezo.dac_bits = 24;
    return config;
}

inline core::ActuatorFrame frame(bool loop_closed, int polarity, double set_point_v = 150.0) {
    core::ActuatorFrame result;
    result.loop_closed = loop_closed;
    result.polarity = static_cast<std::int8_t>(polarity);
    result.set_point_v[0] = set_point_v;
    return result;
}

inline std::vector<TwinHalf> advance(Twin& twin, const core::ActuatorFrame& actuator, int n_halves) {
    std::vector<TwinHalf> halves;
    for (int h = 0; h < n_halves; ++h) halves.push_back(twin.advance(actuator));
    return halves;
}

// One switch from helicity +1 at 150 V with a gap of three ticks; the halves from the closing on.
inline std::vector<TwinHalf> relocked(const TwinConfig& config, double set_point_v, int n_halves) {
    Twin twin{config, Motion::rest()};
    advance(twin, frame(true, 1), 4);
    advance(twin, frame(false, -1, set_point_v), 6);
    return advance(twin, frame(true, -1, set_point_v), n_halves);
}

// False drift of each tick, arcsec/s (= deg/h), positive where its first half pulls the count up.
inline std::vector<double> false_drift_deg_h(const std::vector<TwinHalf>& halves, double tick_s) {
    std::vector<double> result;
    for (std::size_t h = 0; h + 1 < halves.size(); h += 2) {
        result.push_back((halves[h].truth.false_relock_arcsec + halves[h + 1].truth.false_relock_arcsec) / tick_s);
    }
    return result;
}

inline std::int64_t count_between(const TwinHalf& before, const TwinHalf& after) {
    return static_cast<std::int64_t>(after.sensor.counter - before.sensor.counter);
}

}  // namespace zlg::twin
