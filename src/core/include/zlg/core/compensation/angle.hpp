#pragma once
// Exact accumulation of angle: integer counts, and an error-free remainder for all that is not counts.

#include <cstdint>

#include <zlg/core/compensation/border.hpp>

namespace zlg::core {

// A sum of doubles that keeps what rounding would lose, in a second double.
struct ExactSum {
    double high = 0.0;
    double low = 0.0;

    friend constexpr bool operator==(const ExactSum&, const ExactSum&) = default;

    // accuracy  2^-104 of the sum per addition.
    constexpr void add(double x) noexcept {
        const double sum = high + x;
        const double part = sum - high;
        const double lost = (high - (sum - part)) + (x - part);
        low += lost;
        high = sum + low;
        low -= high - sum;
    }
    constexpr void add(const ExactSum& x) noexcept {
        add(x.high);
        add(x.low);
    }
    constexpr void add_difference(double more, double less) noexcept {
        add(more);
        add(-less);
    }
    [[nodiscard]] constexpr double value() const noexcept { return high + low; }
};

// The angle since the start. A measured tick adds its counts and parts of a count; only what differs from scale *
// counts, such as a correction or a bridged tick, enters the remainder. A gyro that measures for a month without a
// switch has a remainder of zero.
struct Angle {
    std::int64_t counts = 0;
    std::int32_t parts = 0;  // of a count beyond them: 1/65536, 0..65535
    ExactSum remainder_arcsec{};

    friend constexpr bool operator==(const Angle&, const Angle&) = default;

    // Add the increment `dtheta_arcsec` of a tick, of which scale_arcsec * (tick_counts + tick_parts/65536) comes from
    // the counter, |tick_parts| below 65536.
    constexpr void add(std::int64_t tick_counts, double scale_arcsec, double dtheta_arcsec,
                       std::int32_t tick_parts = 0) noexcept {
        // Unsigned, so that even a wild sum of counts wraps instead of being undefined.
        counts =
            static_cast<std::int64_t>(static_cast<std::uint64_t>(counts) + static_cast<std::uint64_t>(tick_counts));
        if (tick_parts != 0) {
            const std::int32_t sum = parts + tick_parts;
            parts = sum & 0xffff;
            counts = static_cast<std::int64_t>(static_cast<std::uint64_t>(counts) +
                                               static_cast<std::uint64_t>(std::int64_t{sum >> 16}));
        }
        const double counted_arcsec = scale_arcsec * counts_and_parts(tick_counts, tick_parts);
        if (dtheta_arcsec == counted_arcsec) return;
        remainder_arcsec.add_difference(dtheta_arcsec, counted_arcsec);
    }

    // accuracy  one rounding of the result.
    [[nodiscard]] constexpr double value_arcsec(double scale_arcsec) const noexcept {
        return scale_arcsec * counts_and_parts(counts, parts) + remainder_arcsec.value();
    }
};

}  // namespace zlg::core
