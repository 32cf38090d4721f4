#pragma once
// A record made ready for deviations: the running sum of its increments, and where samples are missing.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <zlg/deviations/series.hpp>

namespace zlg::deviations {

// Increments and rates: the sum of what is known, their mean removed (no deviation depends on it), at every border of
// intervals; a missing sample adds nothing and is not counted. Across it the angle is unknown: no deviation uses it as
// if it were known. Phase: as it is, a missing one NaN.
//
// memory  8 bytes a sample; with gaps in increments or rates 12.
class AngleRecord {
public:
    // errors  SeriesError, as `check`; also: nothing known, all known samples equal.
    explicit AngleRecord(const Series& series);

    // Takes the numbers and sums them in their place. Space for one more (reserve) saves a copy.
    AngleRecord(const SeriesKind& what, std::vector<double>&& values, std::span<const std::uint8_t> valid = {});

    [[nodiscard]] const SeriesKind& what() const { return what_; }
    [[nodiscard]] std::int64_t n_intervals() const { return static_cast<std::int64_t>(angle_.size()) - 1; }
    [[nodiscard]] std::int64_t n_samples() const { return n_samples_; }
    [[nodiscard]] std::int64_t n_known() const { return n_known_; }
    [[nodiscard]] bool has_gaps() const { return n_known_ < n_samples_; }

    // angle()[k]: at the beginning of interval k, in units of a sample.
    [[nodiscard]] std::span<const double> angle() const { return angle_; }
    // known()[k]: known intervals before interval k; empty for phase, and without gaps.
    [[nodiscard]] std::span<const std::uint32_t> known() const { return known_; }

private:
    void build(std::span<const std::uint8_t> valid);

    SeriesKind what_;
    std::vector<double> angle_;
    std::vector<std::uint32_t> known_;
    std::int64_t n_samples_ = 0;
    std::int64_t n_known_ = 0;
};

// The record of rates, arcsec/s, in whose memory it stands while it is used; of many they lie in a file meanwhile.
//
// errors  as AngleRecord(), and of `use`: the rates are back.
void use_in_place(std::vector<double>& rates, double rate_hz, const std::function<void(const AngleRecord&)>& use);

}  // namespace zlg::deviations
