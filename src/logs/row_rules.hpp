#pragma once
// What a row must hold, and the words in which a reader of either format complains.

#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace zlg::logs {

// Counts up to here, and the sum of two of them, are exact in a double.
inline constexpr std::int64_t max_counts = std::int64_t{1} << 52;

inline constexpr std::string_view allowed_sign = "+1 or -1";
inline constexpr std::string_view allowed_flag = "0 or 1";
inline constexpr std::string_view not_finite = "is not finite; allowed is a finite number";
inline constexpr std::string_view not_a_number = "is not a number; allowed is a number or inf";
inline constexpr std::string_view sigma_below_zero = "is negative; allowed is 0 or more, or inf";

// Detunings beyond this are none of a perimeter that is held: the light's discriminator ends before one wavelength.
inline constexpr double max_detuning_lambda = 30.0;
inline constexpr double max_detuning_sq_lambda2 = max_detuning_lambda * max_detuning_lambda;

[[nodiscard]] constexpr bool is_detuning(double lambda) {
    return lambda >= -max_detuning_lambda && lambda <= max_detuning_lambda;
}

// A square below that of the mean is not refused: the two columns of a foreign log may be of different samples.
[[nodiscard]] constexpr double min_detuning_sq(double mean_lambda) {
    (void)mean_lambda;
    return 0.0;
}

// Also 0, which says that it is not known.
[[nodiscard]] constexpr bool is_detuning_sq(double lambda2, double mean_lambda) {
    return lambda2 == 0.0 || (lambda2 >= min_detuning_sq(mean_lambda) && lambda2 <= max_detuning_sq_lambda2);
}

[[nodiscard]] std::string no_detuning(double lambda);
[[nodiscard]] std::string no_detuning_sq(double lambda2, double mean_lambda);

// Of an index that is not the expected one.
[[nodiscard]] std::string out_of_order(std::int64_t value, std::int64_t expected);

// Of a bias sign that is the one of the row before.
[[nodiscard]] std::string not_alternating(std::int64_t value);

[[nodiscard]] std::string out_of_range(std::string_view allowed);
[[nodiscard]] std::string range(std::int64_t min, std::int64_t max);

// The rows directly before one that may have its counts: missed halves.
class MissedRows {
public:
    void add(bool valid, std::int64_t counts, std::int64_t span) {
        n_ = !valid && counts == 0 && span == 1 ? n_ + 1 : 0;
    }
    [[nodiscard]] bool allows(std::int64_t span) const {
        return span >= 1 && span - 1 <= n_ && span <= std::numeric_limits<std::int32_t>::max();
    }
    [[nodiscard]] std::int64_t n() const { return n_; }

private:
    std::int64_t n_ = 0;
};

// Of a span that goes over more than them.
[[nodiscard]] std::string beyond_missed(const MissedRows& missed);

// On the bits, so that a loop over a column is vectorised.
[[nodiscard]] constexpr bool is_finite(double value) {
    constexpr std::uint64_t exponent = 0x7FF0'0000'0000'0000u;
    return (std::bit_cast<std::uint64_t>(value) & exponent) != exponent;
}
[[nodiscard]] constexpr bool is_finite(float value) {
    constexpr std::uint32_t exponent = 0x7F80'0000u;
    return (std::bit_cast<std::uint32_t>(value) & exponent) != exponent;
}

}  // namespace zlg::logs
