#pragma once
// Detuning from the light: the inverse of the laser's discriminator.
//
//   A(dl) = (cw - ccw) / (cw + ccw)        light of both modes, at the plateau of a bias positive for the nearest one
//
// A grows faster than dl and turns where the light runs one way, or where the next mode takes over. Up to there, and on
// the other side likewise, dl(A) is single-valued. In the zone of four waves A is nearly flat.

#include <vector>

#include <zlg/twin/four_wave.hpp>

namespace zlg::twin {

// A chain of straight lines through (signal, detuning), both strictly increasing.
struct DiscriminatorCurve {
    std::vector<double> signal;
    std::vector<double> detuning_lambda;
    double error_lambda = 0.0;  // of the lines between the knots

    // dl(A); beyond the turning points, where no detuning belongs to the signal, that of the turning point.
    //
    // signal  finite.
    [[nodiscard]] double detuning_of(double signal_ratio) const;

    // Between these the curve is monotonic, so that a reading has one detuning; beyond them it has several.
    [[nodiscard]] double min_detuning_lambda() const { return detuning_lambda.front(); }
    [[nodiscard]] double max_detuning_lambda() const { return detuning_lambda.back(); }
};

// field_g          plateau of the bias, > 0.
// tolerance_lambda largest error of the lines, 1e-6..0.01; a smaller one costs more knots.
// errors           std::invalid_argument for an argument out of range;
//                  std::runtime_error where the signal does not grow at zero detuning, as in the dark.
// cost             about 20 ms.
[[nodiscard]] DiscriminatorCurve discriminator_curve(const FourWave& laser, double field_g,
                                                     double tolerance_lambda = 1e-5);

}  // namespace zlg::twin
