#pragma once
// Two numbers side by side: one vector where the processor has them, else two numbers in two registers. The same bits.

namespace zlg::core {

#if defined(__SSE2__) || defined(__aarch64__) || defined(__wasm_simd128__)

using Pair [[gnu::vector_size(16)]] = double;

// The lesser and the greater of two numbers, side by side, neither of which is a NaN or a negative zero.
[[nodiscard]] inline Pair lesser(Pair a, Pair b) noexcept { return a < b ? a : b; }
[[nodiscard]] inline Pair greater(Pair a, Pair b) noexcept { return a > b ? a : b; }

#else

// A compiler keeps a vector that its processor does not know in memory.
struct Pair {
    double first = 0.0;
    double second = 0.0;

    [[nodiscard]] double operator[](int k) const noexcept { return k == 0 ? first : second; }
};

inline Pair operator+(Pair a, Pair b) noexcept { return {a.first + b.first, a.second + b.second}; }
inline Pair operator-(Pair a, Pair b) noexcept { return {a.first - b.first, a.second - b.second}; }
inline Pair operator*(Pair a, Pair b) noexcept { return {a.first * b.first, a.second * b.second}; }
inline Pair operator/(Pair a, Pair b) noexcept { return {a.first / b.first, a.second / b.second}; }
inline Pair operator-(Pair a, double b) noexcept { return a - Pair{b, b}; }
inline Pair operator/(Pair a, double b) noexcept { return a / Pair{b, b}; }
inline Pair operator+(double a, Pair b) noexcept { return Pair{a, a} + b; }
inline Pair operator-(double a, Pair b) noexcept { return Pair{a, a} - b; }
inline Pair operator*(double a, Pair b) noexcept { return Pair{a, a} * b; }
inline Pair& operator+=(Pair& a, Pair b) noexcept { return a = a + b; }

// A Cortex-M that computes in double has an instruction for these.
#if defined(__arm__) && defined(__ARM_FP) && __ARM_ARCH_PROFILE == 'M' && (__ARM_FP & 8) != 0
[[nodiscard]] inline double lesser(double a, double b) noexcept { return __builtin_fmin(a, b); }
[[nodiscard]] inline double greater(double a, double b) noexcept { return __builtin_fmax(a, b); }
#else
[[nodiscard]] inline double lesser(double a, double b) noexcept { return a < b ? a : b; }
[[nodiscard]] inline double greater(double a, double b) noexcept { return a > b ? a : b; }
#endif
[[nodiscard]] inline Pair lesser(Pair a, Pair b) noexcept {
    return {lesser(a.first, b.first), lesser(a.second, b.second)};
}
[[nodiscard]] inline Pair greater(Pair a, Pair b) noexcept {
    return {greater(a.first, b.first), greater(a.second, b.second)};
}

#endif

[[nodiscard]] inline Pair load(const double* numbers) noexcept { return Pair{numbers[0], numbers[1]}; }

[[nodiscard]] inline Pair load(const float* numbers) noexcept {
    return Pair{static_cast<double>(numbers[0]), static_cast<double>(numbers[1])};
}

inline void store(double* numbers, Pair pair) noexcept {
    numbers[0] = pair[0];
    numbers[1] = pair[1];
}

}  // namespace zlg::core
