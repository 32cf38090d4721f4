#pragma once
// Records of rates, and all that is computed of one.

#include <zlg/deviations/angle_record.hpp>
#include <zlg/deviations/deviation_kind.hpp>
#include <zlg/deviations/series.hpp>

#include "test.hpp"

namespace zlg::deviations {

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

inline constexpr auto all_kinds = deviation_kinds;

inline AngleRecord record_of(const std::vector<double>& values, DataKind kind = DataKind::rate, double rate_hz = 1.0) {
    return AngleRecord(Series{.what = {kind, Unit::one, rate_hz}, .values = values});
}

}  // namespace zlg::deviations
