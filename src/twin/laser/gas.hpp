#pragma once
// Gain, pulling and competition of the four waves, in the frame of the mode nearest to the line centre.
//
// Waves are ordered near cw, near ccw, far cw, far ccw. In the frame a positive shift raises the line of near cw; near
// and far have opposite helicity, so far cw is lowered. Reversal of the shift exchanges cw and ccw of both modes.

#include <array>

#include <zlg/twin/laser_config.hpp>

#include "competition.hpp"
#include "laser_frame.hpp"
#include "lorentz_average.hpp"

namespace zlg::twin {

struct GasPoint {
    Competition competition;
    double near_bias_hz = 0.0;  // of the unsaturated gas
    double far_bias_hz = 0.0;

    // Intensities of the lit waves of a balance, and the biases that go with them.
    [[nodiscard]] FrameLight light(const Balance& balance) const;
};

class Gas {
public:
    explicit Gas(const LaserConfig& config);

    // near_lambda  detuning of the near mode; far_lambda that of the far one, half a wavelength off.
    // shift        of near cw's line, in units of ku.
    [[nodiscard]] GasPoint at(double near_lambda, double far_lambda, double shift) const;

    // Unsaturated gain over loss of a mode at a detuning, without field.
    [[nodiscard]] double gain_loss(double detuning_lambda) const;

    [[nodiscard]] double shift_of(double field_g) const { return shift_per_g_ * field_g; }

private:
    static constexpr unsigned n_isotopes = 2;

    [[nodiscard]] double coupling(unsigned i, unsigned j) const;

    std::array<double, n_isotopes> line_;  // centres, in units of ku as all frequencies here
    std::array<double, n_isotopes> share_;
    double half_width_;
    double spectral_range_;
    double shift_per_g_;
    double opposite_coupling_;
    double loss_;
    double gain_ = 1.0;  // G: round-trip gain over <L>
    double pulling_hz_;  // FSR/(2 pi) G/2
};

}  // namespace zlg::twin
