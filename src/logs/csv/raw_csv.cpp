#include <fmt/compile.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <zlg/logs/error.hpp>

#include "csv_reader.hpp"
#include "raw_columns.hpp"
#include "raw_log_io.hpp"
#include "raw_timer.hpp"
#include "row_rules.hpp"
#include "settings_lines.hpp"

namespace zlg::logs {

namespace {

class RawCsvSource final : public RawSource {
public:
    explicit RawCsvSource(const std::string& path) : csv_{path, raw::csv_columns} {
        header_.settings = csv_.settings();
        raw::note_columns(csv_, header_);
        if (header_.has_edge_offset) header_.timer_hz = take_timer_hz(header_.settings, std::nullopt, path);
        header_.warnings = csv_.warnings();
    }

    bool next(core::HalfRecord& record) override {
        if (!csv_.next()) return false;
        record.half = next_half();
        record.bias_sign = next_bias_sign();
        record.mode = csv_.sign(raw::mode);
        record.counts = csv_.integer(raw::counts, -max_counts, max_counts);
        record.loop_closed = csv_.flag(raw::loop_closed);
        record.valid = !header_.has_valid || csv_.flag(raw::valid);
        record.detuning_lambda = next_detuning();
        record.detuning_sq_lambda2 = next_detuning_sq(record.detuning_lambda);
        record.piezo_v = optional_real(raw::piezo_v);
        record.temperature_c = optional_real(raw::temperature_c);
        record.edge_offset_ticks = next_edge_offset();
        record.span = next_span();
        missed_.add(record.valid, record.counts, record.span);
        expected_half_ = record.half + 1;
        previous_bias_sign_ = record.bias_sign;
        return true;
    }

    [[nodiscard]] bool line_is_ended() const override { return csv_.line_is_ended(); }
    [[nodiscard]] double fraction_read() const override { return csv_.fraction_read(); }

private:
    [[nodiscard]] std::int64_t next_half() const {
        const std::int64_t value = csv_.integer(raw::half, 0, std::numeric_limits<std::int64_t>::max());
        if (value != expected_half_) csv_.fail(raw::half, out_of_order(value, expected_half_));
        return value;
    }

    [[nodiscard]] std::int8_t next_bias_sign() const {
        const std::int8_t value = csv_.sign(raw::bias_sign);
        if (value == previous_bias_sign_) csv_.fail(raw::bias_sign, not_alternating(value));
        return value;
    }

    [[nodiscard]] std::int32_t next_edge_offset() const {
        if (!header_.has_edge_offset) return 0;
        using Limits = std::numeric_limits<std::int32_t>;
        return static_cast<std::int32_t>(csv_.integer(raw::edge_offset_ticks, Limits::min(), Limits::max()));
    }

    [[nodiscard]] std::int32_t next_span() const {
        if (!header_.has_span) return 1;
        using Limits = std::numeric_limits<std::int64_t>;
        const std::int64_t value = csv_.integer(raw::span, Limits::min(), Limits::max());
        if (!missed_.allows(value)) csv_.fail(raw::span, beyond_missed(missed_));
        return static_cast<std::int32_t>(value);
    }

    [[nodiscard]] double next_detuning() const {
        const double value = optional_real(raw::detuning_lambda);
        if (header_.has_detuning && !is_detuning(value)) csv_.fail(raw::detuning_lambda, no_detuning(value));
        return value;
    }

    [[nodiscard]] double next_detuning_sq(double mean_lambda) const {
        const double value = optional_real(raw::detuning_sq_lambda2);
        if (header_.has_detuning_sq && !is_detuning_sq(value, mean_lambda))
            csv_.fail(raw::detuning_sq_lambda2, no_detuning_sq(value, mean_lambda));
        return value;
    }

    [[nodiscard]] double optional_real(std::size_t column) const {
        return csv_.has(column) ? csv_.real(column) : std::numeric_limits<double>::quiet_NaN();
    }

    CsvReader csv_;
    MissedRows missed_;
    std::int64_t expected_half_ = 0;
    std::int8_t previous_bias_sign_ = 0;
};

class RawCsvSink final : public RawSink {
public:
    RawCsvSink(const std::string& path, const Settings& settings, bool force, const RawColumns& columns)
        : file_{path, force}, columns_{columns} {
        write_settings(file_, settings);
        if (columns_.has_edge_offset) write_settings(file_, {{timer_setting, fmt::format("{}", columns_.timer_hz)}});
        std::string names;
        for (std::size_t k = 0; k < raw::csv_columns.size(); ++k) {
            if (!raw::is_written(columns_, k)) continue;
            names += fmt::format("{}{}", names.empty() ? "" : ",", raw::csv_columns[k].name);
        }
        file_.append(names + "\n");
    }

    void write(const core::HalfRecord& r, const core::LightSamples&) override {
        require_columns(columns_, r);
        // Two integers of at most 20 letters, two of 11, four reals of at most 24, four of at most 2, and the commas.
        std::array<char, 208> row;
        char* end = fmt::format_to(row.data(), FMT_COMPILE("{},{},{},{},{:d}"), r.half, r.bias_sign, r.mode, r.counts,
                                   r.loop_closed);
        if (columns_.has_valid) end = fmt::format_to(end, FMT_COMPILE(",{:d}"), r.valid);
        const auto append = [&](bool is_column, double value, std::string_view name) {
            if (!is_column) return;
            if (!std::isfinite(value)) refuse_raw(r, name, value);
            end = fmt::format_to(end, FMT_COMPILE(",{}"), value);
        };
        append(columns_.has_detuning, r.detuning_lambda, "detuning_lambda");
        append(columns_.has_detuning_sq, r.detuning_sq_lambda2, "detuning_sq_lambda2");
        append(columns_.has_piezo, r.piezo_v, "piezo_v");
        append(columns_.has_temperature, r.temperature_c, "temperature_c");
        if (columns_.has_edge_offset) end = fmt::format_to(end, FMT_COMPILE(",{}"), r.edge_offset_ticks);
        if (columns_.has_span) end = fmt::format_to(end, FMT_COMPILE(",{}"), r.span);
        *end++ = '\n';
        file_.append({row.data(), static_cast<std::size_t>(end - row.data())});
    }

    void flush() override { file_.flush(); }
    void close() override { file_.close(); }
    [[nodiscard]] const std::string& part_path() const override { return file_.part_path(); }

private:
    TableFile file_;
    RawColumns columns_;
};

}  // namespace

std::unique_ptr<RawSource> open_raw_csv(const std::string& path) { return std::make_unique<RawCsvSource>(path); }

std::unique_ptr<RawSink> create_raw_csv(const std::string& path, const Settings& settings, bool force,
                                        const RawColumns& columns) {
    return std::make_unique<RawCsvSink>(path, settings, force, columns);
}

}  // namespace zlg::logs
