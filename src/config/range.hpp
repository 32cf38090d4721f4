#pragma once
// The numbers that a key allows, as a check and in words.

#include <limits>
#include <string>

namespace zlg::config {

// All finite numbers unless a bound says otherwise; NaN and infinities never.
struct Range {
    static constexpr double unbounded = std::numeric_limits<double>::infinity();

    double min = -unbounded;
    double max = unbounded;
    bool without_min = false;
    bool without_max = false;
    bool without_zero = false;
    double min_size = 0.0;  // of a number of either sign
    bool or_zero = false;   // 0 besides them
};

inline constexpr Range any_finite{};
inline constexpr Range non_zero{.without_zero = true};
inline constexpr Range non_negative{.min = 0.0};
inline constexpr Range positive{.min = 0.0, .without_min = true};

[[nodiscard]] bool contains(const Range& range, double value);
[[nodiscard]] std::string in_words(const Range& range);

}  // namespace zlg::config
