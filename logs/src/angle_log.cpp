#include <fmt/compile.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/error.hpp>

#include "csv_reader.hpp"
#include "settings_lines.hpp"

namespace zlg::logs {

namespace {

enum : std::size_t { tick, t_s, dtheta_arcsec, dtheta_final_arcsec, sigma_arcsec, mode, flags };

constexpr std::array<Column, 7> columns{
    {{"tick"}, {"t_s"}, {"dtheta_arcsec"}, {"dtheta_final_arcsec"}, {"sigma_arcsec"}, {"mode"}, {"flags"}}};

std::string flag_legend() {
    std::string text = "# flags =";
    for (std::size_t bit = 0; bit < core::angle_flag_names.size(); ++bit) {
        text += fmt::format(" {}:{}", core::angle_flag_names[bit], 1u << bit);
    }
    return text + "\n";
}

}  // namespace

struct AngleReader::State {
    explicit State(const std::string& path) : csv{path, columns} {
        header.settings = csv.settings();
        header.warnings = csv.warnings();
    }

    [[nodiscard]] std::int64_t next_tick() const {
        const std::int64_t value = csv.integer(tick, 0, std::numeric_limits<std::int64_t>::max());
        if (value == expected_tick) return value;
        csv.fail(tick, fmt::format("{}; expected {}", value > expected_tick ? "leaves a hole" : "is a repetition",
                                   expected_tick));
    }

    CsvReader csv;
    AngleHeader header;
    std::int64_t expected_tick = 0;
};

AngleReader::AngleReader(const std::string& path) : state_{std::make_unique<State>(path)} {}
AngleReader::~AngleReader() = default;
AngleReader::AngleReader(AngleReader&&) noexcept = default;

const AngleHeader& AngleReader::header() const { return state_->header; }

bool AngleReader::next(TimedAngle& angle) {
    State& s = *state_;
    if (!s.csv.next()) return false;
    angle.row.tick = s.next_tick();
    angle.t_s = s.csv.real(t_s);
    angle.row.dtheta_arcsec = s.csv.real(dtheta_arcsec);
    angle.row.dtheta_final_arcsec = s.csv.real(dtheta_final_arcsec);
    angle.row.sigma_arcsec = s.csv.real_or_infinite(sigma_arcsec);
    if (!(angle.row.sigma_arcsec >= 0.0)) s.csv.fail(sigma_arcsec, "is negative; allowed is 0 or more, or inf");
    angle.row.mode = s.csv.sign(mode);
    angle.row.flags = static_cast<std::uint32_t>(s.csv.integer(flags, 0, std::numeric_limits<std::uint32_t>::max()));
    ++s.expected_tick;
    return true;
}

AngleWriter::AngleWriter(const std::string& path, double tick_s,
                         const std::vector<std::pair<std::string, std::string>>& settings, bool force)
    : file_{path, force}, tick_s_{tick_s} {
    write_settings(file_, settings);
    file_.append(flag_legend());
    file_.append(fmt::format("# tick_s = {}\n", tick_s));
    std::string names;
    for (const Column& column : columns) names += fmt::format("{}{}", names.empty() ? "" : ",", column.name);
    file_.append(names + "\n");
}

void AngleWriter::write(const core::AngleRow& r) {
    if (!(std::isfinite(r.dtheta_arcsec) && std::isfinite(r.dtheta_final_arcsec) && r.sigma_arcsec >= 0.0)) {
        throw FormatError(
            fmt::format("tick {} cannot be logged: dtheta {}, final {}, sigma {} arcsec; allowed are "
                        "finite angles and a sigma of 0 or more, or inf",
                        r.tick, r.dtheta_arcsec, r.dtheta_final_arcsec, r.sigma_arcsec));
    }
    // One integer of at most 20 letters, four reals of at most 24, the sign, at most 10 of flags, and the commas.
    std::array<char, 160> row;
    const double t_end_s = static_cast<double>(r.tick + 1) * tick_s_;
    const char* end = fmt::format_to(row.data(), FMT_COMPILE("{},{},{},{},{},{},{}\n"), r.tick, t_end_s,
                                     r.dtheta_arcsec, r.dtheta_final_arcsec, r.sigma_arcsec, r.mode, r.flags);
    file_.append({row.data(), static_cast<std::size_t>(end - row.data())});
}

void AngleWriter::close() { file_.close(); }

}  // namespace zlg::logs
