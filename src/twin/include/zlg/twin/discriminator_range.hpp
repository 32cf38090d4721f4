#pragma once
// Where the light of the laser tells one detuning: the discriminator
//
//   A(dl) = (cw - ccw) / (cw + ccw)        light of both modes, at the plateau of a bias positive for the nearest one
//
// grows faster than dl and turns where the light runs one way, or where the next mode takes over. Up to there, and on
// the other side likewise, dl(A) is single-valued. In the zone of four waves A is nearly flat.

#include <zlg/twin/four_wave.hpp>

namespace zlg::twin {

// Between these the signal grows, so that a reading has one detuning; beyond them it has several.
struct DiscriminatorRange {
    double min_detuning_lambda = 0.0;
    double max_detuning_lambda = 0.0;
};

// field_g  plateau of the bias, > 0.
// errors   std::invalid_argument for an argument out of range;
//          std::runtime_error where the signal does not grow at zero detuning, as in the dark.
// cost     about 20 ms.
[[nodiscard]] DiscriminatorRange discriminator_range(const FourWave& laser, double field_g);

}  // namespace zlg::twin
