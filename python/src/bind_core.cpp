#include <zlg/config/config.hpp>
#include <zlg/config/log_settings.hpp>
#include <zlg/config/schema.hpp>
#include <zlg/core/gyro_control.hpp>
#include <zlg/recorded/log_compensation.hpp>
#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/study/half_wave_replay.hpp>
#include <zlg/study/switch_table.hpp>

#include "bind.hpp"
#include "fields_dict.hpp"
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
    py::class_<HalfRecord> record{m, "HalfRecord", "One row of the raw log."};
    record.def(py::init<>());
    logs::for_each_column<logs::RawTable>(
        [&](const auto& column, std::size_t) { record.def_readwrite(column.name, column.member); });
    py::class_<GyroControlOutput>(m, "ControlOutput", "What control makes of one half-period.")
        .def_readonly("actuator", &GyroControlOutput::actuator)
        .def_readonly("record", &GyroControlOutput::record)
        .def_readonly("health", &GyroControlOutput::health);
    py::class_<Control>(m, "Control")
        .def(py::init<const config::Config&>())
        .def("initial_actuator", [](const Control& c) { return core::initial_actuator(c.config); })
        .def("step", [](Control& c, const core::SensorFrame& frame) { return core::step(c.config, c.state, frame); });
}

py::dict compensate(const py::dict& columns, const config::Config& config, const config::Settings& settings,
                    double timer_hz, const py::object& progress) {
    const RawView raw{columns};
    logs::RawHeader log = header_of(columns, timer_hz);
    log.settings = config::checked_log_settings(settings, "the log");
    config::Config said = config;
    config::apply_log(said, log.settings, "the log");
    config::require_log_facts(said, "the log");
    config::check_against_log(config, log.settings, "the log");
    recorded::LogCompensation asked = recorded::log_compensation(config, log, "the log");
    rig::Replay replay{asked.compensation};
    const Progress notify{progress};
    AngleCollector angles;
    study::SwitchTable switches{asked.config.compensation.relock_ticks};
    study::HalfWaveReplay half_wave{asked.config};
    {
        const py::gil_scoped_release released;
        const auto add = [&](const core::AngleRow& row) {
            angles.add(row);
            switches.take(row);
        };
        const auto note = [&](const core::GapReport& gap) { switches.take(gap); };
        core::HalfRecord first;
        angles.reserve(raw.size() / 2);
        for (std::size_t row = 0; row < raw.size(); ++row) {
            const core::HalfRecord half = raw.record(row);
            if (row % 2 != 0) switches.take(static_cast<std::int64_t>(row / 2), first, half);
            first = half;
            half_wave.take(half);
            replay.take(half, raw.light(row), add, note);
            if (row % 65536 == 0) notify(static_cast<double>(row) / static_cast<double>(raw.size()));
        }
        replay.end(add, note);
    }
    recorded::require_a_tick(replay, "the log");
    std::vector<std::string> warnings = std::move(asked.warnings);
    warnings.insert(warnings.end(), asked.notes.begin(), asked.notes.end());
    if (raw.size() % 2 != 0) warnings.push_back(replay.odd_half("the log"));
    if (const std::string line = replay.uncorrected("the log"); asked.lacks_detuning && !line.empty())
        warnings.push_back(line);
    for (std::string& wrong : replay.contradictions("the log")) warnings.push_back(std::move(wrong));
    py::dict result = angles.take_out();
    py::dict table;
    std::vector<study::SwitchLine> lines = switches.lines();
    half_wave.fill(lines);
    add_columns(table, lines);
    result["switches"] = table;
    result["warnings"] = warnings;
    result["settings"] = rig::angle_settings(asked.config);
    return result;
}

template <std::size_t N> py::dict bits(const std::array<const char*, N>& names) {
    py::dict all;
    for (std::size_t bit = 0; bit < N; ++bit) all[names[bit]] = std::uint32_t{1} << bit;
    return all;
}

}  // namespace

void bind_core(py::module_& m) {
    bind_control(m);
    m.def("compensate", &compensate);
    m.attr("angle_flags") = bits(core::angle_flag_names);
    m.attr("health_bits") = bits(core::health_bit_names);
}

}  // namespace zlg::python
