#pragma once
// Halves that a gyro passes over at once: what has happened in them, by the laws that its halves follow.
//
//   phase = sum over the halves of rotation + helicity Om(t) + nonmagnetic drift, and one draw of the walk
//
// Rotation and drift are integrals, the loop holds its detuning while the block grows, and the bias cancels in pairs of
// halves but for its growth. A digital loop adds the noise that light makes of its detuning.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <zlg/twin/twin_config.hpp>

namespace zlg::twin {

// One half of those that were asked for singly.
struct QuietHalf {
    std::int64_t counts = 0;     // of the counter, bias among them
    double place = 0.0;          // within the count at its end, 0..1
    double place_deviate = 0.0;  // noise of its reading, of unit variance
    std::int8_t bias_sign = 1;
};

// Of the detuning in a digital loop: AR(1) from half to half, x <- kept x + white noise, of standard deviation sigma.
//
//   sum of s x^2, s = +-1 in turn, over n halves: variance 2 n sigma^4 (1 - kept^2)/(1 + kept^2)
//
// for x^2 is correlated by kept^(2 k) over k halves, and the sum has its spectrum at half of the rate.
struct DetuningNoise {
    double sigma_lambda = 0.0;
    double kept = 0.0;
};

// How a leap is made.
struct LeapWay {
    bool singly = false;    // every half is told; the walk is then drawn half by half
    DetuningNoise noise{};  // none of an analog loop, whose integrator does not see the light that is sampled
};

struct Leap {
    std::int64_t halves = 0;       // even
    double dtheta_arcsec = 0.0;    // rotation of the case
    double turned_counts = 0.0;    // phase
    std::int64_t counts = 0;       // of the counter
    double start_place = 0.0;      // within the count at its start, 0..1
    double rounding_arcsec = 0.0;  // counter less phase at the end
    double set_point_v = 0.0;      // by which that of a digital loop has followed the block
    double temperature_c = 0.0;    // at the end
    double bias_ratio = 1.0;       // the bias at the end over that at the start
    // Mean samples of the beams A and B.
    std::array<double, 2> light_before{1.0, 1.0};
    std::array<double, 2> light_after{1.0, 1.0};
    std::vector<QuietHalf> half{};  // all of them, or none
};

// Why no halves of an averaged gyro can be passed over at once: key and value of what makes each follow from all
// before it, or of what has no integral; empty where they can.
[[nodiscard]] std::string why_no_leap(const TwinConfig& config);

}  // namespace zlg::twin
