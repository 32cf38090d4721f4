#pragma once
// Warming of the gyro after it is switched on, as a part of its end: 1 - exp(-t/thermal_time_s).

#include <array>
#include <cstddef>
#include <cstdint>

#include <zlg/core/common/maths.hpp>

namespace zlg::twin {

// A function of the half alone. The exponential of half 64 q + r is that of 64 q times that of r, so 63 of 64 halves
// take it from a table. In E(x) = exp(x) - 1, which keeps its digits near zero:
//
//   E(a + b) = E(a) + E(b) + E(a) E(b)
class Warming {
public:
    Warming(double half_s, double thermal_time_s) : half_s_{half_s}, thermal_time_s_{thermal_time_s} {
        for (std::size_t r = 0; r < within_.size(); ++r) within_[r] = gone(r);
    }

    // At the start of the half.
    double at(std::uint64_t half) {
        const std::uint64_t block = half / within_.size();
        if (block != block_) {
            block_ = block;
            before_ = gone(block * within_.size());
        }
        const double within = within_[half % within_.size()];
        return -(before_ + within * (1.0 + before_));
    }

private:
    [[nodiscard]] double gone(std::uint64_t half) const {
        return core::maths::expm1(-static_cast<double>(half) * half_s_ / thermal_time_s_);
    }

    double half_s_;
    double thermal_time_s_;
    std::array<double, 64> within_;
    std::uint64_t block_ = 0;
    double before_ = 0.0;
};

}  // namespace zlg::twin
