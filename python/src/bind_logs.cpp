#include <array>
#include <utility>

#include <zlg/config/schema.hpp>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/log_kind.hpp>
#include <zlg/logs/raw_log.hpp>
#include <zlg/logs/text_columns.hpp>

#include "bind.hpp"
#include "log_columns.hpp"

namespace zlg::python {
namespace {

constexpr std::size_t stride = 1 << 16;

std::string kind(const std::string& path) {
    switch (logs::recognise(path)) {
        case logs::LogKind::raw_csv:
        case logs::LogKind::raw_hdf5:
            return "raw";
        case logs::LogKind::angle_csv:
        case logs::LogKind::angle_hdf5:
            return "angles";
        case logs::LogKind::unknown:
            break;
    }
    return "unknown";
}

py::dict read_raw(const std::string& path, bool light, const py::object& progress) {
    RawCollector rows;
    const Progress tell{progress};
    std::optional<logs::RawReader> reader;
    {
        const py::gil_scoped_release released;
        reader.emplace(path);
        core::HalfRecord record;
        for (std::size_t n = 1; reader->next(record); ++n) {
            rows.add(record, light ? reader->light() : core::LightSamples{});
            if (n % stride == 0) tell(reader->fraction_read());
        }
    }
    py::dict columns = rows.take_out();
    const logs::RawHeader& header = reader->header();
    const auto absent = [&](bool has, const char* name) {
        if (!has) columns[name] = py::none();
    };
    absent(header.has_detuning, "detuning_lambda");
    absent(header.has_detuning_sq, "detuning_sq_lambda2");
    absent(header.has_piezo, "piezo_v");
    absent(header.has_temperature, "temperature_c");
    absent(header.has_edge_offset, "edge_offset_ticks");
    absent(header.has_span, "span");
    std::vector<std::string> warnings = header.warnings;
    if (!reader->line_is_ended())
        warnings.push_back(path + ": the last line has no end; the file may have been cut off");
    columns["warnings"] = warnings;
    columns["settings"] = header.settings;
    columns["timer_hz"] = header.timer_hz;
    columns["complete"] = header.complete;
    return columns;
}

void write_raw(const std::string& path, const py::dict& columns, const config::Settings& settings, double timer_hz,
               bool force, const py::object& progress) {
    const RawView rows{columns};
    const Progress tell{progress};
    const logs::RawColumns kept = header_of(columns, timer_hz);
    const py::gil_scoped_release released;
    logs::RawWriter writer{
        path, settings, force, kept, {.light_samples = rows.light_samples(), .light_b = rows.has_light_b()}};
    for (std::size_t row = 0; row < rows.size(); ++row) {
        if (row % stride == 0) tell(static_cast<double>(row) / static_cast<double>(rows.size()));
        writer.write(rows.record(row), rows.light(row));
    }
    writer.close();
}

py::dict read_angles(const std::string& path, const py::object& progress) {
    AngleCollector rows;
    std::vector<double> t_s;
    const Progress tell{progress};
    std::optional<logs::AngleReader> reader;
    {
        const py::gil_scoped_release released;
        reader.emplace(path);
        const bool has_truth = reader->header().has_truth;
        logs::TimedAngle angle;
        while (reader->next(angle)) {
            has_truth ? rows.add(angle.row, angle.truth_dtheta_arcsec) : rows.add(angle.row);
            t_s.push_back(angle.t_s);
            if (t_s.size() % stride == 0) tell(reader->fraction_read());
        }
    }
    py::dict columns = rows.take_out();
    columns["t_s"] = as_array(std::move(t_s));
    columns["warnings"] = reader->header().warnings;
    columns["settings"] = reader->header().settings;
    columns["complete"] = reader->header().complete;
    return columns;
}

// The columns of an angle log as Python holds them.
struct AngleView {
    In<double> dtheta, final, sigma;
    In<std::int8_t> mode;
    In<std::uint32_t> flags;
    std::optional<In<double>> truth;

    [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(dtheta.size()); }
    [[nodiscard]] core::AngleRow row(std::size_t i) const {
        const auto k = static_cast<py::ssize_t>(i);
        return {.tick = static_cast<std::int64_t>(i),
                .dtheta_arcsec = dtheta.data()[k],
                .dtheta_final_arcsec = final.data()[k],
                .sigma_arcsec = sigma.data()[k],
                .mode = mode.data()[k],
                .flags = flags.data()[k]};
    }
};

void write_angles(const std::string& path, const py::dict& c, double tick_s, const config::Settings& settings,
                  bool force, const py::object& progress) {
    AngleView rows{In<double>{c["dtheta_arcsec"]},
                   In<double>{c["dtheta_final_arcsec"]},
                   In<double>{c["sigma_arcsec"]},
                   whole_numbers<std::int8_t>(c["mode"], "mode"),
                   whole_numbers<std::uint32_t>(c["flags"], "flags"),
                   {}};
    const auto modes = span_of(rows.mode, "mode");
    refuse(modes, "mode", "1 or -1", [&](std::size_t k) { return modes[k] == 1 || modes[k] == -1; });
    if (!c["truth_dtheta_arcsec"].is_none()) rows.truth = In<double>{c["truth_dtheta_arcsec"]};
    const auto n = rows.dtheta.size();
    if (rows.final.size() != n || rows.sigma.size() != n || rows.mode.size() != n || rows.flags.size() != n ||
        (rows.truth && rows.truth->size() != n))
        throw std::invalid_argument{"the columns of an angle log are of one length"};
    const Progress tell{progress};
    const py::gil_scoped_release released;
    logs::AngleWriter writer{path, tick_s, settings, force, {.has_truth = rows.truth.has_value()}};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (i % stride == 0) tell(static_cast<double>(i) / static_cast<double>(rows.size()));
        writer.write(rows.row(i), rows.truth ? rows.truth->data()[i] : 0.0);
    }
    writer.close();
}

logs::TextSeparator separator_of(const std::string& name) {
    using enum logs::TextSeparator;
    const std::array<std::pair<const char*, logs::TextSeparator>, 6> all{{{"auto", automatic},
                                                                          {"space", blanks},
                                                                          {"tab", tab},
                                                                          {"semicolon", semicolon},
                                                                          {"comma", comma},
                                                                          {"bar", bar}}};
    for (const auto& [known, separator] : all)
        if (name == known) return separator;
    throw std::invalid_argument{"separator = " + name + ": allowed is auto, space, tab, semicolon, comma, bar"};
}

logs::TextMark mark_of(const std::string& name) {
    if (name == "auto") return logs::TextMark::automatic;
    if (name == "point") return logs::TextMark::point;
    if (name == "comma") return logs::TextMark::comma;
    throw std::invalid_argument{"decimal = " + name + ": allowed is auto, point, comma"};
}

py::list read_text(const std::string& path, const std::vector<std::string>& columns, const std::string& comment,
                   std::int64_t skip_lines, const std::string& separator, const std::string& decimal) {
    const logs::TextLayout layout{.columns = columns,
                                  .comment = comment,
                                  .skip_lines = skip_lines,
                                  .separator = separator_of(separator),
                                  .mark = mark_of(decimal),
                                  .time_column = "0",
                                  .section = "read_text_columns:"};
    std::vector<std::vector<double>> read;
    {
        const py::gil_scoped_release released;
        read = logs::read_text_columns(path, layout);
    }
    py::list arrays;
    for (auto& each : read) arrays.append(as_array(std::move(each)));
    return arrays;
}

}  // namespace

void bind_logs(py::module_& m) {
    m.def("log_kind", &kind, py::arg("path"));
    m.def("read_raw", &read_raw, py::arg("path"), py::arg("light"), py::arg("progress"));
    m.def("write_raw", &write_raw, py::arg("path"), py::arg("columns"), py::arg("settings"), py::arg("timer_hz"),
          py::arg("force"), py::arg("progress"));
    m.def("read_angles", &read_angles, py::arg("path"), py::arg("progress"));
    m.def("write_angles", &write_angles, py::arg("path"), py::arg("columns"), py::arg("tick_s"), py::arg("settings"),
          py::arg("force"), py::arg("progress"));
    m.def("read_text_columns", &read_text, py::arg("path"), py::arg("columns"), py::arg("comment"),
          py::arg("skip_lines"), py::arg("separator"), py::arg("decimal"));
}

}  // namespace zlg::python
