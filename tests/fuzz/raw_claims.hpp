#pragma once
// What must hold of any raw log: it is refused with a reason, or its rows are as documented and survive being written in
// either format and read again.

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
    std::vector<std::vector<float>> light;
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
            claim(reader.light().size() == static_cast<std::size_t>(log.header.light_samples), "light as announced");
            for (const float sample : reader.light()) claim(std::isfinite(sample), "light is finite");
            log.rows.push_back(row);
            log.light.emplace_back(reader.light().begin(), reader.light().end());
        }
        claim(!log.rows.empty() || !log.header.complete, "a log without rows is refused");
        return log;
    } catch (const logs::FormatError&) {
        return std::nullopt;
    } catch (const logs::IoError&) {
        return std::nullopt;
    }
}

inline void write_raw(const std::string& path, const RawLog& log, int light_samples) {
    logs::RawWriter writer{path, log.header.settings, true, log.header, {.light_samples = light_samples}};
    for (std::size_t k = 0; k < log.rows.size(); ++k) {
        writer.write(log.rows[k], light_samples > 0 ? log.light[k] : std::vector<float>{});
    }
    writer.close();
}

inline void claim_raw_survives(const RawLog& log) {
    for (const char* name : {"again.csv", "again.h5"}) {
        const std::string path = scratch().path(name);
        const bool is_csv = logs::format_of(path) == logs::LogFormat::csv;
        if (!can_be_written(log.header.settings, !is_csv)) continue;
        write_raw(path, log, is_csv ? 0 : log.header.light_samples);
        const std::optional<RawLog> again = read_raw(path);
        claim(again.has_value() || log.rows.empty(), "what was written is read");
        if (!again) continue;
        claim(again->header.warnings.empty(), "what was written is read without a warning");
        claim(again->header.settings == log.header.settings, "settings survive");
        claim(again->rows == log.rows, "rows survive to the last bit");
        claim(is_csv || again->light == log.light, "light survives to the last bit");
    }
}

}  // namespace zlg::fuzz
