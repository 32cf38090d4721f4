#pragma once
// The deviations of one axis.

#include <span>

#include <zlg/deviations/angle_record.hpp>
#include <zlg/study/axis.hpp>

namespace zlg::study {

[[nodiscard]] deviations::AngleRecord record_of(std::span<const double> rates_arcsec_s, double rate_hz);

// errors  deviations::SeriesError, as those of deviation().
[[nodiscard]] deviations::DeviationCurve octave_oadev(const AnalysisTask& task, const deviations::AngleRecord& angle);

// Those asked for, and the Allan deviation. The angles of the record, where it has any, are used up.
//
// errors  as analyze_axis.
void take_curves(const AnalysisTask& task, AxisRecord& record, AxisResult& axis);

}  // namespace zlg::study
