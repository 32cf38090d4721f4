#pragma once
// The counter's readings at the borders of halves: whole counts, and the place within the count where the phase of the
// fringe was read.
//
//   angle at a border = (sum of counts + parts/65536) K
//
// A reading without a phase lies anywhere in its count: it stands for the middle, with the variance 1/12. So the angle
// of a half is the difference of its two borders whatever is known of either, and the sum over halves is that of the
// first and the last border: a phase that comes and goes loses nothing.

#include <cstdint>

#include <zlg/core/common/as_double.hpp>
#include <zlg/core/compensation/compensation_constants.hpp>
#include <zlg/core/records.hpp>

namespace zlg::core {

class Border {
public:
    constexpr Border() = default;
    // parts  of a count, 1/65536: 0..65535.
    constexpr explicit Border(std::int32_t parts) noexcept : place_{parts} {}

    [[nodiscard]] constexpr bool is_known() const noexcept { return place_ < count_parts; }
    [[nodiscard]] constexpr std::int32_t parts() const noexcept { return place_ & (count_parts - 1); }

    friend constexpr bool operator==(const Border&, const Border&) = default;

private:
    std::int32_t place_ = count_parts + count_parts / 2;
};

// The border that ends a half.
[[nodiscard]] constexpr Border border_of(const HalfRecord& half) noexcept {
    return has_fringe(half) ? Border{static_cast<std::int32_t>(half.fringe)} : Border{};
}

// From border to border, in parts: beyond the counts.
[[nodiscard]] constexpr std::int32_t parts_between(const Border& from, const Border& to) noexcept {
    return to.parts() - from.parts();
}

// Exact up to 2^36 counts.
[[nodiscard]] constexpr double counts_and_parts(std::int64_t counts, std::int32_t parts) noexcept {
    return as_double(counts) + parts / double{count_parts};
}

// Variance of one reading: of the rounding to a count, or to a part of it with the noise of the phase.
[[nodiscard]] constexpr double reading_counts2(const CompensationConstants& gyro, bool with_phase) noexcept {
    constexpr double of_parts = 1.0 / (12.0 * double{count_parts} * double{count_parts});
    return with_phase ? gyro.fringe_noise_counts * gyro.fringe_noise_counts + of_parts : 1.0 / 12.0;
}

// Variance of a tick by both readings; twice the covariance of two neighbouring ticks, without its sign. `with_phase`:
// the place within the count is read.
[[nodiscard]] constexpr double rounding_arcsec2(const CompensationConstants& gyro, bool with_phase) noexcept {
    if (!with_phase) return rounding_arcsec2(gyro);
    return gyro.scale.value() * gyro.scale.value() * 2.0 * reading_counts2(gyro, true);
}

// The same of a tick between two borders.
[[nodiscard]] constexpr double rounding_arcsec2(const CompensationConstants& gyro, const Border& from,
                                                const Border& to) noexcept {
    if (!from.is_known() && !to.is_known()) return rounding_arcsec2(gyro);
    return gyro.scale.value() * gyro.scale.value() *
           (reading_counts2(gyro, from.is_known()) + reading_counts2(gyro, to.is_known()));
}

// What two neighbouring ticks share of their rounding, twice the size of their covariance: no more than either has.
[[nodiscard]] constexpr double shared_rounding(double usual, double variance_a, double variance_b) noexcept {
    const double less = variance_a < variance_b ? variance_a : variance_b;
    return less < usual ? less : usual;
}

}  // namespace zlg::core
