#include "axis_curves.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <zlg/deviations/averaging.hpp>

namespace zlg::study {
namespace {

using deviations::AngleRecord;
using deviations::DeviationKind;

DeviationKind kind_of(config::Deviation d) { return deviations::deviation_kinds[static_cast<std::size_t>(d)]; }

std::vector<std::int64_t> spaced_factors(const config::Analysis& c, std::int64_t largest) {
    switch (c.taus) {
        case config::Taus::decade: return deviations::decade_factors(largest);
        case config::Taus::all: return deviations::all_factors(largest);
        case config::Taus::octave: break;
    }
    return deviations::octave_factors(largest);
}

std::vector<std::int64_t> factors_of(const config::Analysis& c, DeviationKind kind, std::int64_t n, double rate_hz) {
    const std::int64_t largest = deviations::largest_factor(kind, n);
    if (largest < 1)
        throw deviations::SeriesError(fmt::format("{} samples are too few for {}", n, deviations::name_of(kind)));
    if (!c.taus_s.empty()) return deviations::nearest_factors(c.taus_s, rate_hz, largest);
    return spaced_factors(c, largest);
}

bool is_allan(DeviationKind kind) {
    return kind == DeviationKind::oadev || kind == DeviationKind::adev || kind == DeviationKind::totdev;
}

deviations::DeviationOptions options_of(const AnalysisTask& task) {
    return {.confidence = task.config.confidence, .threads = task.threads};
}

deviations::DeviationCurve allan_curve(const AnalysisTask& task, const AngleRecord& angle,
                                       const std::vector<deviations::DeviationCurve>& curves) {
    const auto asked = std::ranges::find_if(curves, is_allan, &deviations::DeviationCurve::kind);
    if (asked != curves.end()) return *asked;
    try {
        return octave_oadev(task, angle);
    } catch (const deviations::SeriesError&) {
        // Angles that are known here and there may have another deviation and not this one.
        return {.kind = DeviationKind::oadev, .confidence = task.config.confidence, .points = {}};
    }
}

}  // namespace

AngleRecord record_of(std::span<const double> rates, double rate_hz) {
    return AngleRecord({.what = {deviations::DataKind::rate, deviations::Unit::arcsec_s, rate_hz}, .values = rates});
}

deviations::DeviationCurve octave_oadev(const AnalysisTask& task, const AngleRecord& angle) {
    const auto factors =
        deviations::octave_factors(deviations::largest_factor(DeviationKind::oadev, angle.n_intervals()));
    return deviations::deviation(angle, DeviationKind::oadev, factors, options_of(task));
}

void take_curves(const AnalysisTask& task, AxisRecord& record, AxisResult& axis) {
    const auto take = [&](const AngleRecord& angle) {
        for (const config::Deviation d : task.config.deviations) {
            const DeviationKind kind = kind_of(d);
            axis.curves.push_back(deviations::deviation(
                angle, kind, factors_of(task.config, kind, angle.n_intervals(), record.rate_hz), options_of(task)));
        }
        axis.allan = allan_curve(task, angle, axis.curves);
    };
    // Angles are taken as they were recorded; they are not needed after.
    if (record.phase_arcsec.empty())
        deviations::use_in_place(record.rates_arcsec_s, record.rate_hz, take);
    else
        take(AngleRecord({deviations::DataKind::phase, deviations::Unit::arcsec, record.rate_hz},
                         std::move(record.phase_arcsec)));
}

}  // namespace zlg::study
