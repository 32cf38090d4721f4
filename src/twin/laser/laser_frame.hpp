#pragma once
// From perimeter and field to the frame of the nearest mode, and back to left and right.

#include <array>
#include <utility>

#include <zlg/twin/four_wave.hpp>

#include "laser.hpp"

namespace zlg::twin {

// Intensities near cw, near ccw, far cw, far ccw, and the two biases.
struct FrameLight {
    std::array<double, 4> intensity{};
    double near_bias_hz = 0.0;
    double far_bias_hz = 0.0;

    // What the reversed field would give.
    [[nodiscard]] FrameLight reversed() const {
        return {{intensity[1], intensity[0], intensity[3], intensity[2]}, -near_bias_hz, -far_bias_hz};
    }
};

struct LaserFrame {
    int helicity;        // of the near mode
    double near_lambda;  // its detuning
    double far_lambda;   // that of the neighbour on the other side of the line
    double field_g;      // positive where it raises the line of near cw

    LaserFrame(double perimeter_lambda, double outer_field_g) {
        const Mode mode = lasing_mode(perimeter_lambda);
        helicity = mode.helicity();
        near_lambda = mode.detuning_lambda;
        far_lambda = near_lambda + (near_lambda < 0.0 ? 0.5 : -0.5);
        field_g = helicity * outer_field_g;
    }

    [[nodiscard]] LaserLight light(const FrameLight& f) const {
        LaserLight light{{f.intensity[0], f.intensity[1], f.near_bias_hz},
                         {f.intensity[2], f.intensity[3], f.far_bias_hz}};
        if (helicity < 0) std::swap(light.left, light.right);
        return light;
    }
};

}  // namespace zlg::twin
