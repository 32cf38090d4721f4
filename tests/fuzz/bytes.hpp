#pragma once
// The bytes of a fuzz input as numbers. Past the end every number is 0.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>

namespace zlg::fuzz {

// Where arithmetic breaks.
inline constexpr std::array edges{0.0,
                                  -0.0,
                                  1.0,
                                  -1.0,
                                  0.5,
                                  1e-300,
                                  5e-324,
                                  1e300,
                                  std::numeric_limits<double>::max(),
                                  -std::numeric_limits<double>::max(),
                                  std::numeric_limits<double>::infinity(),
                                  -std::numeric_limits<double>::infinity(),
                                  std::numeric_limits<double>::quiet_NaN()};

class Bytes {
public:
    Bytes(const std::uint8_t* data, std::size_t size) : left_{data, size} {}

    [[nodiscard]] bool empty() const { return left_.empty(); }
    [[nodiscard]] std::size_t size() const { return left_.size(); }

    template <class Number> [[nodiscard]] Number take() {
        Number number{};
        const std::size_t n = std::min(sizeof number, left_.size());
        if (n > 0) std::memcpy(&number, left_.data(), n);
        left_ = left_.subspan(n);
        return number;
    }

    [[nodiscard]] bool flag() { return (take<std::uint8_t>() & 1) != 0; }

    // 0..n-1.
    [[nodiscard]] unsigned index(unsigned n) { return take<std::uint8_t>() % n; }

    [[nodiscard]] std::int8_t sign() { return flag() ? std::int8_t{-1} : std::int8_t{1}; }

    // An edge, a number near `typical`, or any bits at all.
    [[nodiscard]] double real(double typical) {
        const unsigned kind = index(16);
        if (kind < edges.size()) return kind < 2 ? typical * (1.0 + 0.01 * take<std::int8_t>()) : edges[kind];
        return take<double>();
    }

private:
    std::span<const std::uint8_t> left_;
};

}  // namespace zlg::fuzz
