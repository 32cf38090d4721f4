#include <zlg/logs/angle_log.hpp>

#include <fmt/format.h>

#include <cmath>
#include <zlg/logs/log_kind.hpp>

#include "log_io.hpp"
#include "logged_fingerprint.hpp"
#include "settings_lines.hpp"

namespace zlg::logs {

namespace {

// `switching:1 extrapolated:2 ...`
std::string flag_legend() {
    std::string text;
    for (std::size_t bit = 0; bit < core::angle_flag_names.size(); ++bit) {
        text += fmt::format("{}{}:{}", text.empty() ? "" : " ", core::angle_flag_names[bit], 1u << bit);
    }
    return text;
}

std::unique_ptr<LogSink<AngleTable>> create(const std::string& path, double tick_s, Settings settings, bool force,
                                            const AngleWriterOptions& options) {
    if (path.ends_with(".mcap")) return create_imu_bag(path, tick_s, force);
    if (options.format_version) (void)checked_format_version(*options.format_version, path);
    if (!find_setting(settings, "flags")) settings.emplace_back("flags", flag_legend());
    if (!find_setting(settings, "tick_s") && !std::isnan(tick_s))
        settings.emplace_back("tick_s", fmt::format("{}", tick_s));
    if (format_of(path) == LogFormat::hdf5) return create_angle_hdf5(path, force, settings, options);
    return create_csv<AngleTable>(path, force, settings, {},
                                  {.keep_part = options.keep_csv_part,
                                   .has_fingerprint = options.has_fingerprint,
                                   .format_version = options.format_version});
}

}  // namespace

AngleReader::AngleReader(const std::string& path) : source_{open_log<AngleTable>(path, &open_angle_hdf5)} {}
AngleReader::~AngleReader() = default;
AngleReader::AngleReader(AngleReader&&) noexcept = default;

const AngleHeader& AngleReader::header() const { return source_->header(); }
bool AngleReader::next(TimedAngle& angle) { return source_->next(angle); }
bool AngleReader::refresh() { return source_->refresh(); }
double AngleReader::fraction_read() const { return source_->fraction_read(); }

AngleWriter::AngleWriter(const std::string& path, double tick_s, const Settings& settings, bool force,
                         const AngleWriterOptions& options)
    : sink_{create(path, tick_s, settings, force, options)}, tick_s_{tick_s} {}
AngleWriter::~AngleWriter() = default;
AngleWriter::AngleWriter(AngleWriter&&) noexcept = default;

void AngleWriter::write(const core::AngleRow& row, double truth_dtheta_arcsec) {
    write_timed({row, static_cast<double>(row.tick + 1) * tick_s_, truth_dtheta_arcsec});
}

void AngleWriter::write_timed(const TimedAngle& angle) { sink_->write(angle, {}); }
void AngleWriter::flush() { sink_->flush(); }
void AngleWriter::set_fingerprint(const std::string& fingerprint) {
    require_fingerprint(fingerprint, part_path());
    sink_->set_fingerprint(fingerprint);
}
void AngleWriter::close() { sink_->close(); }
const std::string& AngleWriter::part_path() const { return sink_->part_path(); }

}  // namespace zlg::logs
