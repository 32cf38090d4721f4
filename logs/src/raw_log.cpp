#include <fmt/compile.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <zlg/logs/error.hpp>
#include <zlg/logs/raw_log.hpp>

#include "csv_reader.hpp"
#include "settings_lines.hpp"

namespace zlg::logs {

namespace {

enum : std::size_t {
    half,
    bias_sign,
    mode,
    counts,
    loop_closed,
    valid,
    detuning_lambda,
    detuning_sq_lambda2,
    piezo_v,
    temperature_c,
};

constexpr std::array<Column, 10> columns{{{"half", true},
                                          {"bias_sign", true},
                                          {"mode", true},
                                          {"counts", true},
                                          {"loop_closed", true},
                                          {"valid", false},
                                          {"detuning_lambda", false},
                                          {"detuning_sq_lambda2", false},
                                          {"piezo_v", false},
                                          {"temperature_c", false}}};

bool is_written(const RawColumns& written, std::size_t column) {
    switch (column) {
        case valid:
            return written.has_valid;
        case detuning_lambda:
            return written.has_detuning;
        case detuning_sq_lambda2:
            return written.has_detuning_sq;
        case piezo_v:
            return written.has_piezo;
        case temperature_c:
            return written.has_temperature;
        default:
            return true;
    }
}

// Counts up to here, and the sum of two of them, are exact in a double.
constexpr std::int64_t max_counts = std::int64_t{1} << 52;

}  // namespace

struct RawReader::State {
    explicit State(const std::string& path) : csv{path, columns} {
        header.settings = csv.settings();
        header.has_valid = csv.has(valid);
        header.has_detuning = csv.has(detuning_lambda);
        header.has_detuning_sq = csv.has(detuning_sq_lambda2);
        header.has_piezo = csv.has(piezo_v);
        header.has_temperature = csv.has(temperature_c);
        header.warnings = csv.warnings();
    }

    [[nodiscard]] std::int64_t next_half() const {
        const std::int64_t value = csv.integer(half, 0, std::numeric_limits<std::int64_t>::max());
        if (value == expected_half) return value;
        csv.fail(half, fmt::format("{}; expected {}", value > expected_half ? "leaves a hole" : "is a repetition",
                                   expected_half));
    }

    [[nodiscard]] std::int8_t next_bias_sign() const {
        const std::int8_t value = csv.sign(bias_sign);
        if (value == previous_bias_sign) {
            csv.fail(bias_sign, fmt::format("as in the row before; expected {:+d}: it must alternate", -value));
        }
        return value;
    }

    [[nodiscard]] double optional_real(std::size_t column) const {
        return csv.has(column) ? csv.real(column) : std::numeric_limits<double>::quiet_NaN();
    }

    CsvReader csv;
    RawHeader header;
    std::int64_t expected_half = 0;
    std::int8_t previous_bias_sign = 0;
};

RawReader::RawReader(const std::string& path) : state_{std::make_unique<State>(path)} {}
RawReader::~RawReader() = default;
RawReader::RawReader(RawReader&&) noexcept = default;

const RawHeader& RawReader::header() const { return state_->header; }

bool RawReader::next(core::HalfRecord& record) {
    State& s = *state_;
    if (!s.csv.next()) return false;
    record.half = s.next_half();
    record.bias_sign = s.next_bias_sign();
    record.mode = s.csv.sign(mode);
    record.counts = s.csv.integer(counts, -max_counts, max_counts);
    record.loop_closed = s.csv.flag(loop_closed);
    record.valid = !s.header.has_valid || s.csv.flag(valid);
    record.detuning_lambda = s.optional_real(detuning_lambda);
    record.detuning_sq_lambda2 = s.optional_real(detuning_sq_lambda2);
    record.piezo_v = s.optional_real(piezo_v);
    record.temperature_c = s.optional_real(temperature_c);
    s.expected_half = record.half + 1;
    s.previous_bias_sign = record.bias_sign;
    return true;
}

bool RawReader::line_is_ended() const { return state_->csv.line_is_ended(); }

double RawReader::fraction_read() const { return state_->csv.fraction_read(); }

RawWriter::RawWriter(const std::string& path, const std::vector<std::pair<std::string, std::string>>& settings,
                     bool force, const RawColumns& written)
    : file_{path, force}, columns_{written} {
    write_settings(file_, settings);
    std::string names;
    for (std::size_t k = 0; k < columns.size(); ++k) {
        if (is_written(columns_, k)) names += fmt::format("{}{}", names.empty() ? "" : ",", columns[k].name);
    }
    file_.append(names + "\n");
}

void RawWriter::write(const core::HalfRecord& r) {
    // Two integers of at most 20 letters, four reals of at most 24, four of at most 2, and the commas.
    std::array<char, 192> row;
    char* end = fmt::format_to(row.data(), FMT_COMPILE("{},{},{},{},{:d}"), r.half, r.bias_sign, r.mode, r.counts,
                               r.loop_closed);
    if (columns_.has_valid) end = fmt::format_to(end, FMT_COMPILE(",{:d}"), r.valid);
    const auto append = [&](bool is_column, double value, std::string_view name) {
        if (!is_column) return;
        if (!std::isfinite(value)) {
            throw FormatError(
                fmt::format("half {} cannot be logged: {} is {}; allowed is a finite number", r.half, name, value));
        }
        end = fmt::format_to(end, FMT_COMPILE(",{}"), value);
    };
    append(columns_.has_detuning, r.detuning_lambda, "detuning_lambda");
    append(columns_.has_detuning_sq, r.detuning_sq_lambda2, "detuning_sq_lambda2");
    append(columns_.has_piezo, r.piezo_v, "piezo_v");
    append(columns_.has_temperature, r.temperature_c, "temperature_c");
    *end++ = '\n';
    file_.append({row.data(), static_cast<std::size_t>(end - row.data())});
}

void RawWriter::close() { file_.close(); }

}  // namespace zlg::logs
