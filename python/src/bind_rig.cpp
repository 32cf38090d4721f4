#include <zlg/config/config.hpp>
#include <zlg/recorded/motion.hpp>
#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/laser_calibration.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/study/resolved.hpp>

#include "bind.hpp"
#include "log_columns.hpp"
#include "use.hpp"

namespace zlg::python {
namespace {

struct Loop {
    rig::ClosedLoop loop;
    bool is_busy = false;
};

// Some halves of a loop as columns: those of a raw log, and beside them health and truth.
py::dict advance(Loop& shared, std::int64_t halves, bool light, const py::object& progress) {
    if (!(halves >= 0)) throw std::invalid_argument{"halves = " + std::to_string(halves) + ": allowed is 0 or more"};
    const Use use{shared.is_busy, "loop"};
    rig::ClosedLoop& loop = shared.loop;
    const auto n = static_cast<std::size_t>(halves);
    RawCollector rows;
    std::vector<std::uint32_t> health;
    std::vector<double> turned, false_relock, detuning;
    const Progress notify{progress};
    {
        const py::gil_scoped_release released;
        rows.reserve(n), health.reserve(n), turned.reserve(n), false_relock.reserve(n), detuning.reserve(n);
        for (std::size_t half = 0; half < n; ++half) {
            const rig::LoopHalf out = loop.advance();
            rows.add(out.record, light ? loop.light() : core::LightSamples{});
            health.push_back(out.control.health);
            turned.push_back(out.truth.dtheta_arcsec);
            false_relock.push_back(out.truth.false_relock_arcsec);
            detuning.push_back(out.truth.detuning_end_lambda);
            if (half % 16384 == 0) notify(static_cast<double>(half) / static_cast<double>(n));
        }
    }
    py::dict columns = rows.take_out();
    columns["health"] = as_array(std::move(health));
    columns["truth_dtheta_arcsec"] = as_array(std::move(turned));
    columns["truth_false_relock_arcsec"] = as_array(std::move(false_relock));
    columns["truth_detuning_end_lambda"] = as_array(std::move(detuning));
    return columns;
}

}  // namespace

void bind_rig(py::module_& m) {
    py::class_<Loop>(m, "ClosedLoop")
        .def(py::init([](const config::Config& config, const std::optional<twin::Motion>& motion) {
            return Loop{rig::ClosedLoop{config, motion ? *motion : recorded::motion(config)}};
        }))
        .def("advance", &advance);
    m.def("run_ticks", [](const config::Config& config, const std::optional<twin::Motion>& motion) {
        return rig::run_ticks(config, motion ? *motion : recorded::motion(config));
    });
    m.def("resolved", [](const config::Config& config) {
        study::Resolved made;
        {
            const py::gil_scoped_release released;
            made = study::resolved(config);
        }
        return py::make_tuple(made.config, made.notes, made.warnings);
    });
    m.def("calibrated_by_laser", &rig::calibrated_by_laser, py::call_guard<py::gil_scoped_release>());
    m.def("angle_settings", &rig::angle_settings);
    m.attr("timer_hz") = rig::timer_hz;
}

}  // namespace zlg::python
