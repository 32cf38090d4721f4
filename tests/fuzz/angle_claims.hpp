#pragma once
// What must hold of any angle log: it is refused with a reason, or its rows are as documented and survive being written
// in either format and read again.

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <zlg/core/records.hpp>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/log_kind.hpp>

#include "claim.hpp"
#include "scratch.hpp"
#include "settings.hpp"

namespace zlg::fuzz {

struct AngleLog {
    logs::AngleHeader header;
    std::vector<logs::TimedAngle> rows;
};

inline void claim_angle_row(const logs::AngleHeader& header, const logs::TimedAngle& angle, std::size_t n_before) {
    const core::AngleRow& row = angle.row;
    claim(row.tick == static_cast<std::int64_t>(n_before), "ticks have no holes");
    claim(std::isfinite(angle.t_s), "time is finite");
    claim(std::isfinite(row.dtheta_arcsec) && std::isfinite(row.dtheta_final_arcsec), "angles are finite");
    claim(row.sigma_arcsec >= 0.0, "sigma is 0 or more, or inf");
    claim(row.mode == 1 || row.mode == -1, "mode is a sign");
    claim(row.relock_arcsec == 0.0, "what is not in the log is 0");
    claim(std::isfinite(angle.truth_dtheta_arcsec) == header.has_truth, "truth is finite, or absent");
}

// Nothing where it is refused; what throws anything else than the readers' own errors ends the process.
inline std::optional<AngleLog> read_angles(const std::string& path) {
    try {
        AngleLog log;
        logs::AngleReader reader{path};
        log.header = reader.header();
        for (logs::TimedAngle angle; reader.next(angle);) {
            claim_angle_row(log.header, angle, log.rows.size());
            log.rows.push_back(angle);
        }
        claim(!log.rows.empty() || !log.header.complete, "a log without rows is refused");
        return log;
    } catch (const logs::FormatError&) {
        return std::nullopt;
    } catch (const logs::IoError&) {
        return std::nullopt;
    }
}

// The writer adds the legend of the flags and the tick, which must not be contradicted.
inline Settings others(const AngleLog& log) { return without(log.header.settings, {"flags", "tick_s", "gyro.tick_s"}); }

inline void write_angles(const std::string& path, const AngleLog& log, bool with_truth) {
    constexpr double tick_s = 0.005;
    logs::AngleWriter writer{path, tick_s, others(log), true, {.has_truth = with_truth}};
    for (const logs::TimedAngle& angle : log.rows) writer.write_timed(angle);
    writer.close();
}

inline bool same_rows(const AngleLog& a, const AngleLog& b, bool with_truth) {
    if (a.rows.size() != b.rows.size()) return false;
    for (std::size_t k = 0; k < a.rows.size(); ++k) {
        const logs::TimedAngle& x = a.rows[k];
        const logs::TimedAngle& y = b.rows[k];
        const bool same_truth = !with_truth || core::same_bits(x.truth_dtheta_arcsec, y.truth_dtheta_arcsec);
        if (!(x.row == y.row && core::same_bits(x.t_s, y.t_s) && same_truth)) return false;
    }
    return true;
}

inline void claim_angles_survive(const AngleLog& log) {
    for (const char* name : {"again.csv", "again.h5"}) {
        const std::string path = scratch().path(name);
        const bool is_csv = logs::format_of(path) == logs::LogFormat::csv;
        const bool with_truth = log.header.has_truth && !is_csv;
        if (!can_be_written(log.header.settings, !is_csv)) continue;
        write_angles(path, log, with_truth);
        const std::optional<AngleLog> again = read_angles(path);
        claim(again.has_value() || log.rows.empty(), "what was written is read");
        if (!again) continue;
        claim(again->header.warnings.empty(), "what was written is read without a warning");
        claim(same_rows(*again, log, with_truth), "rows survive to the last bit");
        claim(others(*again) == others(log), "settings survive");
    }
}

}  // namespace zlg::fuzz
