#pragma once
// Arithmetic of unevaluated sums of two doubles (double-double), without fused operations: Dekker 1971, Knuth.

#include <zlg/core/common/maths_kernels.hpp>

namespace zlg::core::maths {

// a + b exactly (Knuth's two-sum).
inline Sum exact_sum(double a, double b) noexcept {
    const double high = a + b;
    const double of_b = high - a;
    return {high, (a - (high - of_b)) + (b - of_b)};
}

// a b, exactly but for 2^-106 of it, while no part is subnormal (Dekker's product).
inline Sum product_of(double a, double b) noexcept {
    const double high = a * b;
    const double a_head = head_of(a);
    const double b_head = head_of(b);
    const double a_tail = a - a_head;
    const double b_tail = b - b_head;
    return {high, ((a_head * b_head - high) + a_head * b_tail + a_tail * b_head) + a_tail * b_tail};
}

// a/b, of the quotient rounded and what remains.
inline Sum quotient_of(const Sum& a, const Sum& b) noexcept {
    const double high = a.high / b.high;
    const auto [taken, taken_low] = product_of(high, b.high);
    return {high, ((a.high - taken) - taken_low + a.low - high * b.low) / b.high};
}

}  // namespace zlg::core::maths
