#pragma once
// Sums in a fixed order that a processor with vectors of any width, or none, goes through alike: sixteen sums side by
// side, then a tree. The bits do not depend on the machine.

#include <array>
#include <cstdint>

// A function with this mark is compiled for several vector widths, and the processor's own is taken when it is called.
// The sanitizers start before such a choice can be made.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define ZLG_VECTOR_WIDTHS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define ZLG_VECTOR_WIDTHS
#endif
#define ZLG_INLINE __attribute__((always_inline)) inline

namespace zlg::deviations {

inline constexpr std::int64_t lanes = 16;

ZLG_INLINE double tree_sum(const double* lane) {
    double half[8], quarter[4];
    for (int k = 0; k < 8; ++k) half[k] = lane[k] + lane[k + 8];
    for (int k = 0; k < 4; ++k) quarter[k] = half[k] + half[k + 4];
    return (quarter[0] + quarter[2]) + (quarter[1] + quarter[3]);
}

// Sum of term(0) ... term(n - 1).
template <class Term> ZLG_INLINE double lane_sum(std::int64_t n, const Term& term) {
    alignas(64) double lane[lanes] = {};
    const std::int64_t whole = n - n % lanes;
    for (std::int64_t i = 0; i < whole; i += lanes)
        for (std::int64_t k = 0; k < lanes; ++k) lane[k] += term(i + k);
    for (std::int64_t k = 0; k < n - whole; ++k) lane[k] += term(whole + k);
    return tree_sum(lane);
}

// Two sums of one pass: term(i, first, second) sets what is to be added.
template <class Term> ZLG_INLINE std::array<double, 2> lane_sums(std::int64_t n, const Term& term) {
    alignas(64) double lane[lanes] = {}, other[lanes] = {};
    const auto add = [&](std::int64_t i, std::int64_t k) __attribute__((always_inline)) {
        double first = 0.0, second = 0.0;
        term(i + k, first, second);
        lane[k] += first;
        other[k] += second;
    };
    const std::int64_t whole = n - n % lanes;
    for (std::int64_t i = 0; i < whole; i += lanes)
        for (std::int64_t k = 0; k < lanes; ++k) add(i, k);
    for (std::int64_t k = 0; k < n - whole; ++k) add(whole, k);
    return {tree_sum(lane), tree_sum(other)};
}

}  // namespace zlg::deviations
