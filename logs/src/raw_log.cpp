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

RawWriter::RawWriter(const std::string& path, const std::vector<std::pair<std::string, std::string>>& settings,
                     bool force)
    : file_{path, force} {
    write_settings(file_, settings);
    std::string names;
    for (const Column& column : columns) names += fmt::format("{}{}", names.empty() ? "" : ",", column.name);
    file_.append(names + "\n");
}

void RawWriter::write(const core::HalfRecord& r) {
    if (!(std::isfinite(r.detuning_lambda) && std::isfinite(r.detuning_sq_lambda2) && std::isfinite(r.piezo_v) &&
          std::isfinite(r.temperature_c))) {
        throw FormatError(
            fmt::format("half {} cannot be logged: detuning {} lambda, its square {}, piezo {} V, "
                        "temperature {} C; allowed are finite numbers",
                        r.half, r.detuning_lambda, r.detuning_sq_lambda2, r.piezo_v, r.temperature_c));
    }
    // Two integers of at most 20 letters, four reals of at most 24, four of at most 2, and the commas.
    std::array<char, 192> row;
    const char* end = fmt::format_to(row.data(), FMT_COMPILE("{},{},{},{},{:d},{:d},{},{},{},{}\n"), r.half,
                                     r.bias_sign, r.mode, r.counts, r.loop_closed, r.valid, r.detuning_lambda,
                                     r.detuning_sq_lambda2, r.piezo_v, r.temperature_c);
    file_.append({row.data(), static_cast<std::size_t>(end - row.data())});
}

void RawWriter::close() { file_.close(); }

}  // namespace zlg::logs
