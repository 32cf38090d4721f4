#pragma once
// Results of the analysis as Python gets them.

#include <zlg/deviations/deviation.hpp>
#include <zlg/noise/mode_split.hpp>
#include <zlg/noise/noise_fit.hpp>

#include "arrays.hpp"

namespace zlg::python {

[[nodiscard]] py::dict dict_of(const deviations::DeviationCurve& curve);
[[nodiscard]] py::dict dict_of(const noise::NoiseFit& fit);
[[nodiscard]] py::dict dict_of(const noise::ModeSplit& split);

}  // namespace zlg::python
