#include <cmath>

#include <zlg/core/records.hpp>
#include <zlg/deviations/averaging.hpp>
#include <zlg/deviations/deviation.hpp>

#include "analysis_dicts.hpp"
#include "bind.hpp"
#include "fields_dict.hpp"

namespace zlg::python {

py::dict dict_of(const deviations::DeviationCurve& curve) {
    py::dict d;
    add_columns(d, curve.points);
    d["kind"] = name_of(curve.kind);
    d["confidence"] = curve.confidence;
    d["edf"] = column(curve.points, [](const deviations::DeviationPoint& p) { return p.law.edf; });
    return d;
}

deviations::Series series_of(const Samples& samples) {
    const auto& [values, rate_hz, data_type, unit, valid] = samples;
    return {{deviations::data_kind_of(data_type), deviations::unit_of(unit), rate_hz},
            span_of(values, "data"),
            span_of(valid, "valid")};
}

namespace {

using namespace deviations;

std::vector<std::int64_t> spaced(const std::string& taus, int per_decade, std::int64_t largest) {
    if (taus == "octave") return octave_factors(largest);
    if (taus == "decade") return decade_factors(largest);
    if (taus == "log") return log_factors(per_decade, largest);
    if (taus == "all") return all_factors(largest);
    throw SeriesError{"taus = \"" + taus + "\": allowed are octave, decade, log, all, or the times in seconds"};
}

// A tau of which the record has no term is left out.
std::vector<double> within(const std::vector<double>& taus_s, double rate_hz, std::int64_t largest) {
    std::vector<double> kept;
    for (const double tau_s : taus_s)
        if (!(std::round(tau_s * rate_hz) > static_cast<double>(largest))) kept.push_back(tau_s);
    return kept;
}

using Taus = std::variant<std::string, std::vector<double>>;

std::vector<std::int64_t> factors_of(const Taus& taus, int per_decade, bool drop_long_taus, double rate_hz,
                                     std::int64_t largest) {
    if (const auto* name = std::get_if<std::string>(&taus)) return spaced(*name, per_decade, largest);
    const auto& given = std::get<std::vector<double>>(taus);
    return nearest_factors(drop_long_taus ? within(given, rate_hz, largest) : given, rate_hz, largest);
}

py::dict deviation_of(const std::string& kind, const Samples& samples, const Taus& taus, int per_decade,
                      bool drop_long_taus, double confidence, double least_known_ratio, std::optional<int> noise,
                      int threads) {
    const DeviationKind which = deviation_kind_of(kind);
    const DeviationOptions options{
        .confidence = confidence, .least_known_ratio = least_known_ratio, .noise = noise, .threads = threads};
    const Series series = series_of(samples);
    return dict_of(without_interpreter([&] {
        const AngleRecord record{series};
        const auto largest = largest_factor(which, record.n_intervals());
        const double rate_hz = series.what.rate_hz;
        return deviation(record, which, factors_of(taus, per_decade, drop_long_taus, rate_hz, largest), options);
    }));
}

}  // namespace

void bind_deviations(py::module_& m) {
    m.def("deviation", &deviation_of);
    // Angles that were bridged, guessed or distrusted are no measurements of the gyro's noise.
    m.attr("not_measured") = core::flag_extrapolated | core::flag_interpolated | core::flag_unrepaired |
                             core::flag_loop_unlocked | core::flag_invalid | core::flag_mode_mixed;
}

}  // namespace zlg::python
