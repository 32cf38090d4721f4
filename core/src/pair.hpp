#pragma once
// Two numbers side by side, for processors with vector instructions; on others the compiler does one after the other.

namespace zlg::core {

using Pair [[gnu::vector_size(16)]] = double;

[[nodiscard]] inline Pair load(const double* numbers) noexcept { return Pair{numbers[0], numbers[1]}; }

[[nodiscard]] inline Pair load(const float* numbers) noexcept {
    return Pair{static_cast<double>(numbers[0]), static_cast<double>(numbers[1])};
}

inline void store(double* numbers, Pair pair) noexcept {
    numbers[0] = pair[0];
    numbers[1] = pair[1];
}

}  // namespace zlg::core
