#include <fmt/format.h>

#include <limits>
#include <zlg/logs/error.hpp>
#include <zlg/logs/log_kind.hpp>
#include <zlg/logs/raw_log.hpp>

#include "raw_log_io.hpp"
#include "raw_timer.hpp"
#include "row_rules.hpp"
#include "signature.hpp"
#include "text_source.hpp"

namespace zlg::logs {

namespace {

std::unique_ptr<RawSink> create(const std::string& path, const Settings& settings, bool force,
                                const RawColumns& columns, const RawWriterOptions& options) {
    if (options.light_samples < 0 || options.light_samples > core::max_light_samples) {
        throw FormatError(fmt::format("{}: {} light samples in a half; allowed is 0..{}", path, options.light_samples,
                                      core::max_light_samples));
    }
    if (options.light_b && options.light_samples == 0)
        throw FormatError(fmt::format("{}: light samples of beam B; allowed is with those of beam A", path));
    if (columns.has_edge_offset) check_timer_hz(columns.timer_hz, path);
    if (format_of(path) == LogFormat::hdf5) return create_raw_hdf5(path, settings, force, columns, options);
    if (options.light_samples > 0) {
        throw FormatError(
            fmt::format("{}: a CSV log holds no light samples; allowed are the suffixes .h5, .hdf5", path));
    }
    return create_raw_csv(path, settings, force, columns);
}

}  // namespace

void refuse_edge_offset(const core::HalfRecord& record) {
    throw FormatError(fmt::format("half {} cannot be logged: edge_offset_ticks is {}, and the log has no column for it",
                                  record.half, record.edge_offset_ticks));
}

void refuse_span(const core::HalfRecord& record) {
    throw FormatError(
        fmt::format("half {} cannot be logged: its counts go over {} halves, and the log has no column span",
                    record.half, record.span));
}

void refuse_raw(const core::HalfRecord& record, std::string_view name, double value) {
    throw FormatError(
        fmt::format("half {} cannot be logged: {} is {}; allowed is a finite number", record.half, name, value));
}

void require_detunings(const RawColumns& columns, const core::HalfRecord& record) {
    const double mean = columns.has_detuning ? record.detuning_lambda : std::numeric_limits<double>::quiet_NaN();
    const double square = record.detuning_sq_lambda2;
    const auto refuse = [&](std::string_view name, double value, const std::string& what) {
        throw FormatError(fmt::format("half {} cannot be logged: {} = {} {}", record.half, name, value, what));
    };
    if (columns.has_detuning && is_finite(mean) && !is_detuning(mean))
        refuse("detuning_lambda", mean, no_detuning(mean));
    if (columns.has_detuning_sq && is_finite(square) && !is_detuning_sq(square, mean))
        refuse("detuning_sq_lambda2", square, no_detuning_sq(square, mean));
}

RawReader::RawReader(const std::string& path)
    : source_{has_hdf5_signature(path) ? open_raw_hdf5(path) : open_text(path, &open_raw_csv)} {}
RawReader::~RawReader() = default;
RawReader::RawReader(RawReader&&) noexcept = default;

const RawHeader& RawReader::header() const { return source_->header(); }
bool RawReader::next(core::HalfRecord& record) { return source_->next(record); }
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
void RawWriter::close() { sink_->close(); }
const std::string& RawWriter::part_path() const { return sink_->part_path(); }

}  // namespace zlg::logs
