#include <fmt/format.h>

#include <cmath>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/log_kind.hpp>

#include "angle_columns.hpp"
#include "angle_log_io.hpp"
#include "signature.hpp"
#include "text_source.hpp"

namespace zlg::logs {

namespace angles {

std::string flag_legend() {
    std::string text;
    for (std::size_t bit = 0; bit < core::angle_flag_names.size(); ++bit) {
        text += fmt::format("{}{}:{}", text.empty() ? "" : " ", core::angle_flag_names[bit], 1u << bit);
    }
    return text;
}

void require_loggable(const TimedAngle& angle) {
    const core::AngleRow& r = angle.row;
    if (std::isfinite(r.dtheta_arcsec) && std::isfinite(r.dtheta_final_arcsec) && r.sigma_arcsec >= 0.0) return;
    throw FormatError(
        fmt::format("tick {} cannot be logged: dtheta {}, final {}, sigma {} arcsec; allowed are "
                    "finite angles and a sigma of 0 or more, or inf",
                    r.tick, r.dtheta_arcsec, r.dtheta_final_arcsec, r.sigma_arcsec));
}

}  // namespace angles

AngleReader::AngleReader(const std::string& path)
    : source_{has_hdf5_signature(path) ? open_angle_hdf5(path) : open_text(path, &open_angle_csv)} {}
AngleReader::~AngleReader() = default;
AngleReader::AngleReader(AngleReader&&) noexcept = default;

const AngleHeader& AngleReader::header() const { return source_->header(); }
bool AngleReader::next(TimedAngle& angle) { return source_->next(angle); }
bool AngleReader::refresh() { return source_->refresh(); }
double AngleReader::fraction_read() const { return source_->fraction_read(); }

AngleWriter::AngleWriter(const std::string& path, double tick_s, const Settings& settings, bool force,
                         const AngleWriterOptions& options)
    : sink_{format_of(path) == LogFormat::hdf5 ? create_angle_hdf5(path, tick_s, settings, force, options)
                                               : create_angle_csv(path, tick_s, settings, force, options)},
      tick_s_{tick_s} {}
AngleWriter::~AngleWriter() = default;
AngleWriter::AngleWriter(AngleWriter&&) noexcept = default;

void AngleWriter::write(const core::AngleRow& row, double truth_dtheta_arcsec) {
    sink_->write({row, static_cast<double>(row.tick + 1) * tick_s_, truth_dtheta_arcsec});
}

void AngleWriter::write_timed(const TimedAngle& angle) { sink_->write(angle); }
void AngleWriter::flush() { sink_->flush(); }
void AngleWriter::close() { sink_->close(); }
const std::string& AngleWriter::part_path() const { return sink_->part_path(); }

}  // namespace zlg::logs
