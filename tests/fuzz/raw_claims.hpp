#pragma once
// What must hold of any raw log: it is refused with a reason, or its rows are as documented and survive being written
// in either format and read again.

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <zlg/core/records.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/log_kind.hpp>
#include <zlg/logs/raw_log.hpp>

#include "claim.hpp"
#include "scratch.hpp"
#include "settings.hpp"

namespace zlg::fuzz {

struct RawLog {
    logs::RawHeader header;
    std::vector<core::HalfRecord> rows;
    std::vector<std::vector<float>> light_a;
    std::vector<std::vector<float>> light_b;
};

inline void claim_raw_row(const logs::RawHeader& header, const core::HalfRecord& row,
                          const std::vector<core::HalfRecord>& before) {
    constexpr std::int64_t most = std::int64_t{1} << 52;
    const auto as_promised = [](bool has, double value) { return has ? std::isfinite(value) : std::isnan(value); };
    claim(row.half == static_cast<std::int64_t>(before.size()), "halves have no holes");
    claim(row.bias_sign == 1 || row.bias_sign == -1, "bias_sign is a sign");
    claim(before.empty() || row.bias_sign == -before.back().bias_sign, "bias_sign alternates");
    claim(row.mode == 1 || row.mode == -1, "mode is a sign");
    claim(row.counts >= -most && row.counts <= most, "counts are exact as a double");
    claim(header.has_valid || row.valid, "absent `valid` means valid");
    claim(as_promised(header.has_detuning, row.detuning_lambda), "detuning is finite, or absent");
    claim(as_promised(header.has_detuning_sq, row.detuning_sq_lambda2), "mean square is finite, or absent");
    claim(as_promised(header.has_piezo, row.piezo_v), "piezo voltage is finite, or absent");
    claim(as_promised(header.has_temperature, row.temperature_c), "temperature is finite, or absent");
}

inline void claim_light(const logs::RawHeader& header, const core::LightSamples& light) {
    const auto n = static_cast<std::size_t>(header.light_samples);
    claim(light.a.size() == n, "light as announced");
    claim(light.b.size() == (header.has_light_b ? n : 0), "light of beam B as announced");
    for (const float sample : light.a) claim(std::isfinite(sample), "light is finite");
    for (const float sample : light.b) claim(std::isfinite(sample), "light of beam B is finite");
}

// Nothing where it is refused; what throws anything else than the readers' own errors ends the process.
inline std::optional<RawLog> read_raw(const std::string& path) {
    try {
        RawLog log;
        logs::RawReader reader{path};
        log.header = reader.header();
        claim(log.header.light_samples >= 0 && log.header.light_samples <= core::max_light_samples,
              "0..64 light samples");
        for (core::HalfRecord row; reader.next(row);) {
            claim_raw_row(log.header, row, log.rows);
            claim_light(log.header, reader.light());
            log.rows.push_back(row);
            log.light_a.emplace_back(reader.light().a.begin(), reader.light().a.end());
            log.light_b.emplace_back(reader.light().b.begin(), reader.light().b.end());
        }
        claim(!log.rows.empty() || !log.header.complete, "a log without rows is refused");
        return log;
    } catch (const logs::FormatError&) {
        return std::nullopt;
    } catch (const logs::IoError&) {
        return std::nullopt;
    }
}

inline void write_raw(const std::string& path, const RawLog& log, const logs::RawWriterOptions& light) {
    logs::RawWriter writer{path, log.header.settings, true, log.header, light};
    for (std::size_t k = 0; k < log.rows.size(); ++k) writer.write(log.rows[k], {log.light_a[k], log.light_b[k]});
    writer.close();
}

inline void claim_raw_survives(const RawLog& log) {
    for (const char* name : {"again.csv", "again.h5"}) {
        const std::string path = scratch().path(name);
        const bool is_csv = logs::format_of(path) == logs::LogFormat::csv;
        if (!can_be_written(log.header.settings, !is_csv)) continue;
        const logs::RawWriterOptions light{.light_samples = log.header.light_samples,
                                           .light_b = log.header.has_light_b};
        write_raw(path, log, is_csv ? logs::RawWriterOptions{} : light);
        const std::optional<RawLog> again = read_raw(path);
        claim(again.has_value() || log.rows.empty(), "what was written is read");
        if (!again) continue;
        claim(again->header.warnings.empty(), "what was written is read without a warning");
        claim(again->header.settings == log.header.settings, "settings survive");
        claim(again->rows == log.rows, "rows survive to the last bit");
        claim(is_csv || (again->light_a == log.light_a && again->light_b == log.light_b),
              "light survives to the last bit");
    }
}

}  // namespace zlg::fuzz
