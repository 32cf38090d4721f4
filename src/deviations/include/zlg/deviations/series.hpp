#pragma once
// A record of a gyro's readings at equal intervals, and what they are: never guessed, always said.

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string_view>

namespace zlg::deviations {

// The record cannot answer the question: too short, nothing known, constant, of another kind.
struct SeriesError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

enum class DataKind {
    increments,  // angle turned in each interval
    rate,        // mean rate over each interval
    phase,       // angle at the borders of the intervals, one more than there are intervals
};

// Angles for increments and phase, rates for rate; `one` is a number without unit, for either.
enum class Unit { arcsec, rad, deg, arcsec_s, rad_s, deg_s, deg_h, one };

[[nodiscard]] bool is_rate(Unit unit);

// "arcsec", "deg/h" ... errors  SeriesError: another name.
[[nodiscard]] Unit unit_of(std::string_view name);
[[nodiscard]] std::string_view name_of(Unit unit);

// "increments", "rate", "phase". errors  SeriesError: another name.
[[nodiscard]] DataKind data_kind_of(std::string_view name);

// How many arcsec, or arcsec/s, one unit is.
[[nodiscard]] double in_arcsec(Unit unit);

// What the numbers are; has no defaults, so that nothing is assumed.
struct SeriesKind {
    DataKind kind;
    Unit unit;
    double rate_hz;  // samples per second
};

// From variances of the rate per sample, in the record's own unit, to (arcsec/s)^2; to 1 for Unit::one.
[[nodiscard]] double rate_scale(const SeriesKind& what);

// The numbers themselves stay with the caller.
struct Series {
    SeriesKind what;
    std::span<const double> values;         // not finite: missing
    std::span<const std::uint8_t> valid{};  // 0: missing; empty: all that are finite count
};

// errors  SeriesError: rate not a positive finite number, a unit of another kind, a mask of another length, no sample.
void check(const Series& series);

}  // namespace zlg::deviations
