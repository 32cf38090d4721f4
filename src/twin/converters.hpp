#pragma once
// Resolution of the converters between volts and numbers.

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace zlg::twin {

// A converter whose codes cover [min_v, max_v] in 2^bits steps. It saturates at the ends of its range.
class Converter {
public:
    Converter(double min_v, double max_v, int bits)
        : min_v_{min_v}, max_v_{max_v}, step_v_{std::ldexp(max_v - min_v, -bits)} {}

    [[nodiscard]] double quantised_v(double volts) const {
        const double limited_v = std::clamp(volts, min_v_, max_v_);
        // Codes are not negative, so that cutting off what follows the point rounds.
        const auto code = static_cast<std::int64_t>((limited_v - min_v_) / step_v_ + 0.5);
        return std::min(max_v_, min_v_ + step_v_ * static_cast<double>(code));
    }

private:
    double min_v_;
    double max_v_;
    double step_v_;
};

}  // namespace zlg::twin
