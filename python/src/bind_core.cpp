#include <zlg/config/config.hpp>
#include <zlg/config/log_settings.hpp>
#include <zlg/config/schema.hpp>
#include <zlg/core/gyro_compensation.hpp>
#include <zlg/core/gyro_control.hpp>
#include <zlg/rig/wiring.hpp>

#include "bind.hpp"
#include "log_columns.hpp"

namespace zlg::python {
namespace {

// Config and state of the controller, side by side.
struct Control {
    core::GyroControlConfig config;
    core::GyroControlState state;

    explicit Control(const config::Config& c) : config{rig::control_config(c)}, state{core::initial_state(config)} {}
};

void bind_control(py::module_& m) {
    using core::GyroControlOutput;
    using core::HalfRecord;
    py::class_<HalfRecord>(m, "HalfRecord", "One row of the raw log.")
        .def(py::init<>())
        .def_readwrite("half", &HalfRecord::half)
        .def_readwrite("counts", &HalfRecord::counts)
        .def_readwrite("detuning_lambda", &HalfRecord::detuning_lambda)
        .def_readwrite("detuning_sq_lambda2", &HalfRecord::detuning_sq_lambda2)
        .def_readwrite("piezo_v", &HalfRecord::piezo_v)
        .def_readwrite("temperature_c", &HalfRecord::temperature_c)
        .def_readwrite("bias_sign", &HalfRecord::bias_sign)
        .def_readwrite("mode", &HalfRecord::mode)
        .def_readwrite("loop_closed", &HalfRecord::loop_closed)
        .def_readwrite("valid", &HalfRecord::valid)
        .def_readwrite("edge_offset_ticks", &HalfRecord::edge_offset_ticks)
        .def_readwrite("span", &HalfRecord::span);
    py::class_<GyroControlOutput>(m, "ControlOutput", "What control makes of one half-period.")
        .def_readonly("actuator", &GyroControlOutput::actuator)
        .def_readonly("record", &GyroControlOutput::record)
        .def_readonly("health", &GyroControlOutput::health);
    py::class_<Control>(m, "Control")
        .def(py::init<const config::Config&>(), py::arg("config"))
        .def("initial_actuator", [](const Control& c) { return core::initial_actuator(c.config); })
        .def(
            "step", [](Control& c, const core::SensorFrame& frame) { return core::step(c.config, c.state, frame); },
            py::arg("frame"));
}

// The configuration as it was when the detunings were read: what the log does not tell is presumed.
config::Config as_recorded(config::Config config, const config::Settings& recorded_settings) {
    config.perimeter = {};
    config::apply_log(config, recorded_settings, "the log");
    return config;
}

// The inverse discriminator of [perimeter], for a log whose detunings were read by the slope alone; linear where they were
// not, or none is known.
core::DiscriminatorCurve curve_of(const config::Config& config, const config::Settings& recorded_settings,
                                  std::vector<std::string>& warnings) {
    const config::Perimeter& asked = config.perimeter;
    if (asked.discriminator_signal.empty() && asked.discriminator_detuning_lambda.empty()) return {};
    const config::Config recorded = as_recorded(config, recorded_settings);
    const config::Perimeter& with = recorded.perimeter;
    if (with.discriminator_signal.empty())
        return rig::discriminator_curve(config, recorded.gyro.discriminator_per_lambda);
    if (with.discriminator_signal != asked.discriminator_signal ||
        with.discriminator_detuning_lambda != asked.discriminator_detuning_lambda)
        warnings.emplace_back(
            "the detunings of the log were read through a discriminator curve of its own; the other one, of "
            "perimeter.discriminator_signal, is not applied to them");
    return {};
}

core::GyroCompensationConfig compensation_of(const config::Config& config, const config::Settings& recorded_settings,
                                             const RawView& raw, double timer_hz, std::vector<std::string>& warnings) {
    auto made = rig::compensation_config(config, config.compensation.relock.value_or(core::RelockMethod::none),
                                         config.compensation.bridge);
    made.relock.curve = curve_of(config, recorded_settings, warnings);
    made.profile.record_curve = made.relock.curve;
    if (!raw.has_edge_offset()) return made;
    if (!(timer_hz >= 1.0 && timer_hz <= 1e15))
        throw config::ConfigError{"timer_hz = " + std::to_string(timer_hz) +
                                  ": allowed is 1..1e15, where there are edge_offset_ticks"};
    made.timer = core::Hertz{timer_hz};
    return made;
}

py::dict compensate(const py::dict& columns, const config::Config& config, const config::Settings& settings,
                    double timer_hz, const py::object& progress) {
    const RawView raw{columns};
    const config::Settings recorded_settings = config::checked_log_settings(settings, "the log");
    config::check_against_log(config, recorded_settings, "the log");
    std::vector<std::string> warnings;
    const core::GyroCompensationConfig made = compensation_of(config, recorded_settings, raw, timer_hz, warnings);
    const Progress tell{progress};
    AngleCollector angles;
    {
        const py::gil_scoped_release released;
        core::GyroCompensationState state;
        angles.reserve(raw.size() / 2);
        for (std::size_t row = 0; row < raw.size(); ++row) {
            const auto out = core::step(made, state, raw.record(row), raw.light(row));
            if (out.has_sample && out.sample.has_final) angles.add(out.sample.final_row);
            if (row % 65536 == 0) tell(static_cast<double>(row) / static_cast<double>(raw.size()));
        }
        for (auto out = drain(made, state); out.has_row || out.has_gap; out = drain(made, state))
            if (out.has_row) angles.add(out.row);
    }
    py::dict result = angles.take_out();
    result["warnings"] = warnings;
    return result;
}

template <std::size_t N>
py::dict bits(const std::array<const char*, N>& names) {
    py::dict all;
    for (std::size_t bit = 0; bit < N; ++bit) all[names[bit]] = std::uint32_t{1} << bit;
    return all;
}

}  // namespace

void bind_core(py::module_& m) {
    bind_control(m);
    m.def("compensate", &compensate, py::arg("columns"), py::arg("config"), py::arg("settings"), py::arg("timer_hz"),
          py::arg("progress"));
    m.attr("angle_flags") = bits(core::angle_flag_names);
    m.attr("health_bits") = bits(core::health_bit_names);
}

}  // namespace zlg::python
