#pragma once
// The limits of the monitors, in one table. A limit of 0 is not watched, but where its line says otherwise.

#include <cstdint>

#include <zlg/core/units.hpp>

namespace zlg::core {

struct MonitorLimits {
    std::int64_t counts = 2000;    // of a half: bias plus the highest rate of rotation, > 0
    double bias_counts = 0.0;      // presumed, of a half, up to 1e15; below `min_bias_counts` it is not watched
    double coil_ratio = 0.0;       // deviation of the coil current in one half, 0..1
    Wavelengths light_noise{0.0};  // of one sample, white, as detuning, 0..10; below `min_noise` none is known
    double bias_chi = 0.0;         // chi of the relative loss of the bias, chi dl^2, 0..1e6
    double light_gain = 1.0;  // of a reading over its detuning, far from the centre: 1 where the curve is known; 1..100
    double detuning_change_lambda2 = 0.0;  // of the mean square within a tick, 0..1e6
    double balance_ticks =
        12000.0;  // that the slower mean of the balance of the photodiodes learns from, 1..2^30; always watched
    std::int32_t relock_ticks = 20;  // after a gap, whose false angle the compensation subtracts, 0..2^24
};

// Rounding and the change of an ordinary rotation hide a smaller bias.
inline constexpr double min_bias_counts = 32.0;

// Less noise than this could be none at all: steady light then is no fault, and nothing is called noisy.
inline constexpr Wavelengths min_noise{1e-4};

[[nodiscard]] constexpr bool is_allowed(const MonitorLimits& c) noexcept {
    return c.counts > 0 && c.bias_counts >= 0.0 && c.bias_counts <= 1e15 && c.coil_ratio >= 0.0 &&
           c.coil_ratio <= 1.0 && c.light_noise >= Wavelengths{0.0} && c.light_noise <= Wavelengths{10.0} &&
           c.bias_chi >= 0.0 && c.bias_chi <= 1e6 && c.light_gain >= 1.0 && c.light_gain <= 100.0 &&
           c.detuning_change_lambda2 >= 0.0 && c.detuning_change_lambda2 <= 1e6 && c.balance_ticks >= 1.0 &&
           c.balance_ticks <= 1 << 30 && c.relock_ticks >= 0 && c.relock_ticks <= (1 << 24);
}

}  // namespace zlg::core
