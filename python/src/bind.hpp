#pragma once
// What each file adds to the module.

#include <pybind11/pybind11.h>

namespace zlg::python {

using namespace pybind11::literals;  // "name"_a

void bind_errors(pybind11::module_& m);
void bind_config(pybind11::module_& m);
void bind_logs(pybind11::module_& m);
void bind_twin(pybind11::module_& m);
void bind_core(pybind11::module_& m);
void bind_rig(pybind11::module_& m);
void bind_design(pybind11::module_& m);
void bind_deviations(pybind11::module_& m);
void bind_noise(pybind11::module_& m);
void bind_calibration(pybind11::module_& m);
void bind_line(pybind11::module_& m);
void bind_study(pybind11::module_& m);
void bind_sweep(pybind11::module_& m);

}  // namespace zlg::python
