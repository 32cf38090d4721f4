#pragma once
// Records that Python gives to the analysis, and results as it gets them.

#include <optional>

#include <zlg/deviations/deviation_curve.hpp>
#include <zlg/deviations/series.hpp>
#include <zlg/noise/mode_split.hpp>
#include <zlg/noise/noise_fit.hpp>

#include "arrays.hpp"

namespace zlg::python {

// A record, whose numbers stay the arrays'.
struct Samples {
    deviations::SeriesKind what;
    In<double> values;
    std::optional<In<std::uint8_t>> valid;

    [[nodiscard]] deviations::Series series() const { return {what, span_of(values, "data"), span_of(valid, "valid")}; }
};

[[nodiscard]] py::dict dict_of(const deviations::DeviationCurve& curve);
[[nodiscard]] py::dict dict_of(const noise::NoiseFit& fit);
[[nodiscard]] py::dict dict_of(const noise::ModeSplit& split);

}  // namespace zlg::python
