#include <zlg/config/schema.hpp>
#include <zlg/design/error.hpp>
#include <zlg/deviations/series.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/mapping.hpp>

#include "bind.hpp"

namespace zlg::python {

namespace py = pybind11;

// Each is also what Python's own functions would raise for such a reason.
void bind_errors(py::module_& m) {
    const py::exception<std::exception> error{m, "Error"};
    const auto also = [&](PyObject* standard) {
        return py::make_tuple(error, py::reinterpret_borrow<py::object>(standard));
    };
    py::register_exception<config::ConfigError>(m, "ConfigError", also(PyExc_ValueError));
    py::register_exception<logs::FormatError>(m, "FormatError", also(PyExc_ValueError));
    py::register_exception<logs::MappingError>(m, "MappingError", also(PyExc_ValueError));
    py::register_exception<logs::IoError>(m, "IoError", also(PyExc_OSError));
    py::register_exception<deviations::SeriesError>(m, "SeriesError", also(PyExc_ValueError));
    py::register_exception<design::DesignError>(m, "DesignError", also(PyExc_ValueError));
}

}  // namespace zlg::python
