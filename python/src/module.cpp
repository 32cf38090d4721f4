#include "bind.hpp"

PYBIND11_MODULE(_zlg, m) {
    m.doc() = "The C++ behind zlg. Use the modules of the package; what they take and give is said there.";
    m.attr("version") = ZLG_VERSION;
    zlg::python::bind_errors(m);
    zlg::python::bind_config(m);
    zlg::python::bind_logs(m);
    zlg::python::bind_twin(m);
    zlg::python::bind_core(m);
    zlg::python::bind_rig(m);
    zlg::python::bind_design(m);
    zlg::python::bind_deviations(m);
    zlg::python::bind_noise(m);
    zlg::python::bind_calibration(m);
    zlg::python::bind_line(m);
    zlg::python::bind_study(m);
    zlg::python::bind_sweep(m);
}
