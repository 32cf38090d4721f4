#pragma once
// The increments of an angle log as samples for deviations, as they are read: memory does not grow with the log.

#include <cstdint>
#include <string>

#include <zlg/core/records.hpp>
#include <zlg/deviations/deviation_stream.hpp>

namespace zlg::deviations {

// Angles that were bridged, guessed or distrusted are no measurements of the gyro's noise.
inline constexpr std::uint32_t not_measured = core::flag_extrapolated | core::flag_interpolated |
                                              core::flag_unrepaired | core::flag_loop_unlocked | core::flag_invalid |
                                              core::flag_mode_mixed;

// As delivered in real time; the best that was known afterwards.
enum class AngleColumn { dtheta, dtheta_final };

struct AngleSamples {
    SeriesKind what;  // increments in arcsec, one a tick
    SampleSource source;
};

// missing_flags  a tick with one of them is a missing sample.
//
// errors  IoError, FormatError as logs::AngleReader; FormatError: no tick_s in the log. The source: FormatError.
[[nodiscard]] AngleSamples angle_samples(const std::string& path, AngleColumn column = AngleColumn::dtheta_final,
                                         std::uint32_t missing_flags = not_measured);

}  // namespace zlg::deviations
