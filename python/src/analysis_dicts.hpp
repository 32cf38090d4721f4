#pragma once
// Results of the analysis as Python gets them.

#include <zlg/analysis/deviation.hpp>
#include <zlg/analysis/mode_split.hpp>
#include <zlg/analysis/noise_fit.hpp>

#include "arrays.hpp"

namespace zlg::python {

[[nodiscard]] py::dict dict_of(const analysis::DeviationCurve& curve);
[[nodiscard]] py::dict dict_of(const analysis::NoiseFit& fit);
[[nodiscard]] py::dict dict_of(const analysis::ModeSplit& split);

}  // namespace zlg::python
