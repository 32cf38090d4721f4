#pragma once
// Low passes as gyros have them, of unit gain at zero frequency.

#include <array>
#include <cstddef>
#include <vector>

namespace zlg::trials {

enum class LowPassKind {
    none,
    exponential,  // y += a (x - y)
    butterworth_1,
    butterworth_2,
    butterworth_4,
    two_exponentials,
    moving_average,
    two_moving_averages,
    held,  // a slower sensor, each value of which stands for some samples
    hann,  // a finite impulse response
};
inline constexpr std::size_t n_low_passes = 10;

struct LowPass {
    std::vector<double> taps{1.0};                // then
    std::vector<std::array<double, 5>> sections;  // b0, b1, b2, a1, a2
    std::size_t held = 1;
    double bandwidth_hz = 0.0;  // at one sample a second, -3 dB; 0: none
};

// cut_hz  about; moving averages have whole lengths.
[[nodiscard]] LowPass low_pass(LowPassKind kind, double cut_hz);

void pass(const LowPass& filter, std::vector<double>& values);

}  // namespace zlg::trials
