#pragma once
// Resolution of the converters between volts and numbers.

#include <algorithm>
#include <cmath>

namespace zlg::twin {

// A converter whose codes cover [min_v, max_v] in 2^bits steps. It saturates at the ends of its range.
class Converter {
public:
    Converter(double min_v, double max_v, int bits)
        : min_v_{min_v}, max_v_{max_v}, step_v_{std::ldexp(max_v - min_v, -bits)} {}

    [[nodiscard]] double quantised_v(double volts) const {
        const double limited_v = std::clamp(volts, min_v_, max_v_);
        return std::min(max_v_, min_v_ + step_v_ * std::round((limited_v - min_v_) / step_v_));
    }

private:
    double min_v_;
    double max_v_;
    double step_v_;
};

}  // namespace zlg::twin
