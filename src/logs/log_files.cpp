// The readers and writers of both kinds of log.

#include <zlg/logs/raw_log.hpp>

#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/log_kind.hpp>
#include <zlg/text/spelling.hpp>

#include "log_io.hpp"
#include "settings_lines.hpp"

namespace zlg::logs {
namespace {

std::unique_ptr<LogSink<RawTable>> create(const std::string& path, const Settings& settings, bool force,
                                          const RawColumns& columns, const RawWriterOptions& options) {
    if (options.light_samples < 0 || options.light_samples > core::max_light_samples) {
        throw FormatError(fmt::format("{}: {} light samples in a half; allowed is 0..{}", path, options.light_samples,
                                      core::max_light_samples));
    }
    if (options.light_b && options.light_samples == 0)
        throw FormatError(fmt::format("{}: light samples of beam B; allowed is with those of beam A", path));
    if (columns.has_edge_offset) check_timer_hz(columns.timer_hz, path);
    if (options.format_version) (void)checked_format_version(*options.format_version, path);
    if (format_of(path) == LogFormat::hdf5) return create_raw_hdf5(path, force, settings, columns, options);
    if (options.light_samples > 0) {
        throw FormatError(
            fmt::format("{}: a CSV log holds no light samples; allowed are the suffixes .h5, .hdf5", path));
    }
    Settings lines = settings;
    if (columns.has_edge_offset) lines.emplace_back(timer_setting, fmt::format("{}", columns.timer_hz));
    return create_csv<RawTable>(path, force, lines, columns,
                                {.has_fingerprint = options.has_fingerprint, .format_version = options.format_version});
}

// Rows that are in memory, made of another program's file.
class RowsInMemory final : public LogSource<RawTable> {
public:
    RowsInMemory(std::string path, RawHeader header, std::vector<core::HalfRecord> rows)
        : path_{std::move(path)}, rows_{std::move(rows)} {
        header_ = std::move(header);
    }
    bool next(core::HalfRecord& row) override {
        if (next_ == rows_.size()) return false;
        row = rows_[next_++];
        return true;
    }
    [[noreturn]] void refuse_last(std::string_view column, std::int64_t value, const std::string& what) override {
        throw FormatError(fmt::format("{}, half {} as imported: {} = {} {}", path_, next_ - 1, column, value, what));
    }
    [[nodiscard]] double fraction_read() const override {
        return static_cast<double>(next_) / static_cast<double>(rows_.size());
    }

private:
    std::string path_;
    std::vector<core::HalfRecord> rows_;
    std::size_t next_ = 0;
};

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
    if (text::lower_case(path).ends_with(".mcap")) return create_imu_bag(path, tick_s, force);
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

RawReader::RawReader(const std::string& path, RawHeader header, std::vector<core::HalfRecord> rows)
    : source_{std::make_unique<RowsInMemory>(path, std::move(header), std::move(rows))} {}
RawReader::RawReader(const std::string& path) : source_{open_log<RawTable>(path, &open_raw_hdf5)} {}
RawReader::~RawReader() = default;
RawReader::RawReader(RawReader&&) noexcept = default;

const RawHeader& RawReader::header() const { return source_->header(); }
bool RawReader::next(core::HalfRecord& record) {
    if (!source_->next(record)) return false;
    if (!rows_before_.next(record)) {
        const RawSequence::Fault fault = rows_before_.fault(record);
        source_->refuse_last(fault.column, fault.value, fault.what);
    }
    return true;
}
core::LightSamples RawReader::light() const { return source_->light(); }
bool RawReader::refresh() { return source_->refresh(); }
bool RawReader::line_is_ended() const { return source_->line_is_ended(); }
double RawReader::fraction_read() const { return source_->fraction_read(); }

RawWriter::RawWriter(const std::string& path, const Settings& settings, bool force, const RawColumns& columns,
                     const RawWriterOptions& options)
    : sink_{create(path, settings, force, columns, options)} {}
RawWriter::~RawWriter() = default;
RawWriter::RawWriter(RawWriter&&) noexcept = default;

void RawWriter::write(const core::HalfRecord& record, const core::LightSamples& light) { sink_->write(record, light); }
void RawWriter::flush() { sink_->flush(); }
void RawWriter::set_fingerprint(const std::string& fingerprint) {
    require_fingerprint(fingerprint, part_path());
    sink_->set_fingerprint(fingerprint);
}
void RawWriter::close() { sink_->close(); }
const std::string& RawWriter::part_path() const { return sink_->part_path(); }

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
