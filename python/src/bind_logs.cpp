#include <utility>

#include <zlg/config/schema.hpp>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/imported.hpp>
#include <zlg/logs/log_kind.hpp>
#include <zlg/logs/raw_log.hpp>

#include "bind.hpp"
#include "log_columns.hpp"

namespace zlg::python {
namespace {

constexpr std::size_t rows_per_report = 1 << 16;  // between two reports of progress

std::string kind(const std::string& path) {
    using enum logs::LogKind;
    const logs::LogKind found = logs::recognise(path);
    return found == unknown ? "unknown" : found == raw_csv || found == raw_hdf5 ? "raw" : "angles";
}

// `open` makes the reader.
template <class Open>
py::dict raw_columns(const std::string& path, const Open& open, bool light, const py::object& progress) {
    RawCollector rows;
    const Progress notify{progress};
    std::optional<logs::RawReader> reader;
    {
        const py::gil_scoped_release released;
        reader.emplace(open());
        core::HalfRecord record;
        for (std::size_t n = 1; reader->next(record); ++n) {
            rows.add(record, light ? reader->light() : core::LightSamples{});
            if (n % rows_per_report == 0) notify(reader->fraction_read());
        }
    }
    py::dict columns = rows.take_out();
    const logs::RawHeader& header = reader->header();
    logs::RawColumns there = header;
    there.has_valid = true;  // without the column every half is
    logs::for_each_column<RawArrays>([&](const auto& column, std::size_t) {
        if (!column.is_in(there)) columns[column.name] = py::none();
    });
    std::vector<std::string> warnings = header.warnings;
    if (!reader->line_is_ended())
        warnings.push_back(path + ": the last line has no end; the file may have been cut off");
    columns["warnings"] = warnings;
    columns["settings"] = header.settings;
    columns["timer_hz"] = header.timer_hz;
    columns["format_version"] = header.format_version;
    columns["complete"] = header.complete;
    return columns;
}

py::dict read_raw(const std::string& path, bool light, const py::object& progress) {
    return raw_columns(
        path, [&path] { return logs::RawReader{path}; }, light, progress);
}

py::dict axis_dict(logs::ImportedAxis& axis) {
    py::dict d("name"_a = axis.name, "rate_hz"_a = axis.rate_hz, "warnings"_a = axis.warnings);
    d["rates_arcsec_s"] = as_array(axis.rates_arcsec_s.vector());
    if (!axis.mode.empty()) d["mode"] = as_array(std::move(axis.mode));
    if (!axis.phase_arcsec.empty()) d["phase_arcsec"] = as_array(axis.phase_arcsec.vector());
    return d;
}

// A file of another program as columns of a raw log, under "raw", or as axes.
py::dict read_foreign(const std::string& path, const std::vector<std::pair<std::string, std::string>>& said,
                      const std::vector<std::string>& axes, const py::object& progress) {
    logs::ForeignLook look;
    logs::ImportedRaw raw;
    logs::ImportedAxes imported;
    {
        const py::gil_scoped_release released;
        logs::Mapping mapping;
        for (const auto& [key, value] : said) mapping.set(key, value, "zlg.read");
        if (!axes.empty()) mapping.set_axes(axes);
        look = logs::look_at_foreign(path, mapping);
        if (look.makes == logs::Makes::raw)
            raw = logs::imported_raw(look);
        else
            imported = logs::imported_axes(look);
        if (!imported.temperature_c.empty())
            throw logs::MappingError{"temperature_c: is read by `zlg analyze` alone; allowed is to leave it out"};
    }
    std::vector<std::string> notes = look.table.notes;
    for (const auto* some : {&look.said, &raw.notes, &raw.warnings, &imported.notes})
        notes.insert(notes.end(), some->begin(), some->end());
    py::dict d("notes"_a = notes, "raw"_a = py::none());
    if (look.makes == logs::Makes::raw) {
        const auto open = [&] { return logs::RawReader{path, raw.header, std::move(raw.rows)}; };
        d["raw"] = raw_columns(path, open, false, progress);
        return d;
    }
    py::list all;
    for (logs::ImportedAxis& axis : imported.axes) all.append(axis_dict(axis));
    d["axes"] = all;
    return d;
}

void write_raw(const std::string& path, const py::dict& columns, const config::Settings& settings, double timer_hz,
               bool force, const py::object& progress) {
    const RawView rows{columns};
    const Progress notify{progress};
    const logs::RawColumns kept = header_of(columns, timer_hz);
    const auto version = py::cast<logs::FormatVersion>(columns["format_version"]);
    const py::gil_scoped_release released;
    logs::RawWriter writer{
        path,
        settings,
        force,
        kept,
        {.light_samples = rows.light_samples(), .light_b = rows.has_light_b(), .format_version = version}};
    for (std::size_t row = 0; row < rows.size(); ++row) {
        if (row % rows_per_report == 0) notify(static_cast<double>(row) / static_cast<double>(rows.size()));
        writer.write(rows.record(row), rows.light(row));
    }
    writer.close();
}

py::dict read_angles(const std::string& path, const py::object& progress) {
    AngleCollector rows;
    const Progress notify{progress};
    std::optional<logs::AngleReader> reader;
    {
        const py::gil_scoped_release released;
        reader.emplace(path);
        const bool has_truth = reader->header().has_truth;
        logs::TimedAngle angle;
        while (reader->next(angle)) {
            has_truth ? rows.add(angle.row, angle.truth_dtheta_arcsec) : rows.add(angle.row);
            if (rows.size() % rows_per_report == 0) notify(reader->fraction_read());
        }
    }
    py::dict columns = rows.take_out();
    columns["warnings"] = reader->header().warnings;
    columns["settings"] = reader->header().settings;
    columns["format_version"] = reader->header().format_version;
    columns["complete"] = reader->header().complete;
    return columns;
}

void write_angles(const std::string& path, const py::dict& columns, double tick_s, const config::Settings& settings,
                  bool force, const py::object& progress) {
    const AngleView rows{columns};
    const Progress notify{progress};
    const auto version = py::cast<logs::FormatVersion>(columns["format_version"]);
    const py::gil_scoped_release released;
    logs::AngleWriter writer{path, tick_s, settings, force, {.has_truth = rows.has_truth(), .format_version = version}};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (i % rows_per_report == 0) notify(static_cast<double>(i) / static_cast<double>(rows.size()));
        writer.write(rows.angle(i), rows.truth_arcsec(i));
    }
    writer.close();
}

}  // namespace

void bind_logs(py::module_& m) {
    m.attr("format_version") = logs::format_version;
    m.def("log_kind", &kind);
    m.def("read_raw", &read_raw);
    m.def("write_raw", &write_raw);
    m.def("read_foreign", &read_foreign);
    m.def("read_angles", &read_angles);
    m.def("write_angles", &write_angles);
}

}  // namespace zlg::python
