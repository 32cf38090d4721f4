#pragma once
// Records that Python gives to the analysis, and results as it gets them.

#include <optional>
#include <string>
#include <tuple>

#include <zlg/deviations/deviation_curve.hpp>
#include <zlg/deviations/series.hpp>
#include <zlg/noise/mode_split.hpp>
#include <zlg/noise/noise_fit.hpp>

#include "arrays.hpp"

namespace zlg::python {

// A record, whose numbers stay the arrays': values, samples a second, kind, unit, and which are valid.
using Samples = std::tuple<In<double>, double, std::string, std::string, std::optional<In<std::uint8_t>>>;

[[nodiscard]] deviations::Series series_of(const Samples& samples);

[[nodiscard]] py::dict dict_of(const deviations::DeviationCurve& curve);
[[nodiscard]] py::dict dict_of(const noise::NoiseFit& fit);
[[nodiscard]] py::dict dict_of(const noise::ModeSplit& split);

}  // namespace zlg::python
