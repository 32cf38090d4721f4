#pragma once
// An angle of radians as quarter turns and what is left.

#include <cstdint>

#include <zlg/core/common/maths_kernels.hpp>

namespace zlg::core::maths {

struct Reduced {
    Sum angle;                   // radians, at most pi/4 in size
    std::uint64_t quadrant = 0;  // modulo 4
};

// Of a finite x, |x| >= 2^20. error 2^-70 of the angle
Reduced reduced_large(double x) noexcept;

}  // namespace zlg::core::maths
