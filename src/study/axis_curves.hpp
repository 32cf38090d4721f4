#pragma once
// The deviations of one axis.

#include <span>

#include <zlg/analysis/angle_record.hpp>
#include <zlg/study/analyze.hpp>

namespace zlg::study {

[[nodiscard]] analysis::AngleRecord record_of(std::span<const double> rates_arcsec_s, double rate_hz);

// errors  analysis::SeriesError, as those of deviation().
[[nodiscard]] analysis::DeviationCurve octave_oadev(const AnalysisTask& task, const analysis::AngleRecord& angle);

// Those asked for, and the Allan deviation. The angles of the record, where it has any, are used up.
//
// errors  as analyze_axis.
void take_curves(const AnalysisTask& task, AxisRecord& record, AxisResult& axis);

}  // namespace zlg::study
