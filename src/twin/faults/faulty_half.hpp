#pragma once
// What the faults that act in a half make of length and light, at its start and after each of its steps.

#include <vector>

#include "fault_light.hpp"

namespace zlg::twin {

struct FaultyHalf {
    std::vector<double> length_lambda;  // beside drift and piezo
    std::vector<LightParts> light;
    double switch_error_lambda = 0.0;  // of a loop that opens with this half
};

}  // namespace zlg::twin
