#pragma once
// The detuning at which the perimeter loop is closed after a switch, part by part.
//
// A switch moves the piezo by U_lambda/2, half a wavelength, open loop. In wavelengths, as bounds:
//
//   half wave   relative error of U_lambda/2:  e/2
//   DAC         half a step:                   (range/2^bits)/2 * k,       k = 0.5/U_lambda/2
//   hysteresis  width of the loop of a stroke U_lambda/2, h S k (U_lambda/2 / S)^2, where h is quoted for the stroke S:
//               play thresholds spread uniformly up to S/2 make the width go as the square of the stroke
//   creep       c/2 * log10(dwell/settling):   U_lambda/2 is learnt after the dwell, the miss arises after the settling

#include <array>
#include <string_view>

namespace zlg::design {

struct MissCauses {
    double half_wave_v = 40.0;              // > 0
    double half_wave_error_ratio = 0.0;     // >= 0
    double range_v = 300.0;                 // > 0
    int dac_bits = 12;                      // 1..32
    double hysteresis_ratio = 0.12;         // >= 0
    double hysteresis_stroke_v = 300.0;     // S, not below half_wave_v
    double creep_ratio_per_decade = 0.015;  // >= 0
    double dwell_s = 90.0;                  // not below settling_s
    double settling_s = 0.010;              // > 0
};

struct MissPart {
    std::string_view name;
    double lambda = 0.0;
};

struct InitialMiss {
    std::array<MissPart, 4> part;
    double root_sum_square_lambda = 0.0;  // independent causes
    double worst_lambda = 0.0;            // all of one sign
};

[[nodiscard]] InitialMiss initial_miss(const MissCauses& causes);

// Error of the voltage that makes a miss: miss_lambda U_lambda/2 / 0.5.
[[nodiscard]] double voltage_of_miss_v(double miss_lambda, double half_wave_v);

}  // namespace zlg::design
