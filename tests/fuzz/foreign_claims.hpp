#pragma once
// A file of another program, looked at and read under any mapping: refused with a reason, or rows that a log can hold.

#include <cmath>
#include <string>

#include <zlg/logs/error.hpp>
#include <zlg/logs/imported.hpp>

#include "bytes.hpp"
#include "claim.hpp"
#include "scratch.hpp"

namespace zlg::fuzz {

// Bytes at the head of an input that say how the rest is read.
inline constexpr std::size_t mapping_bytes = 4;

inline logs::Mapping any_mapping(Bytes& bytes) {
    constexpr const char* axes[] = {"axis=1",   "axis=2",        "axis=3", "axis=w", "axis=[\"1\", \"2\"]",
                                    "counts=1", "counts=counts", ""};
    constexpr const char* times[] = {"time=none", "time=1", "time_unit=ms", "time_unit=s"};
    constexpr const char* units[] = {"unit=deg/h", "unit=arcsec", "unit=counts", "unit=rad/s"};
    constexpr const char* holds[] = {"holds=rate", "holds=increment", "holds=angle", ""};
    constexpr const char* others[] = {"rate_hz=100",  "missing=-9999", "decimal=comma", "separator=semicolon",
                                      "skip_lines=1", "comment=%",     "half=1",        ""};
    logs::Mapping mapping;
    const auto say = [&mapping](const char* pair) {
        if (*pair != '\0') logs::apply_mapping_pair(mapping, pair);
    };
    const auto first = bytes.take<std::uint8_t>(), second = bytes.take<std::uint8_t>(),
               third = bytes.take<std::uint8_t>();
    say(axes[first % 8]);
    say(times[first / 8 % 4]);
    say(units[second % 4]);
    say(holds[second / 4 % 4]);
    say(others[third % 8]);
    say(others[third / 8 % 8]);
    if (bytes.flag())
        for (const char* pair :
             {"bias_sign=2", "mode=always:1", "loop_closed=always:1", "scale_arcsec=2", "tick_s=0.02"})
            say(pair);
    return mapping;
}

inline void claim_rows(const logs::ForeignLook& look) {
    if (look.makes == logs::Makes::raw) {
        const logs::ImportedRaw made = logs::imported_raw(look);
        claim(made.rows.size() >= 2, "a raw log has a tick");
        for (const core::HalfRecord& row : made.rows) {
            claim(row.bias_sign == 1 || row.bias_sign == -1, "a half has a sign of its bias");
            claim(row.mode == 1 || row.mode == -1, "a half has a mode");
        }
        return;
    }
    for (const logs::ImportedAxis& axis : logs::imported_axes(look).axes) {
        claim(std::isfinite(axis.rate_hz) && axis.rate_hz > 0.0, "rows have a rate");
        logs::angle_rows(axis, [](const core::AngleRow& row) {
            claim(std::isfinite(row.dtheta_arcsec) && std::isfinite(row.dtheta_final_arcsec), "an angle is a number");
        });
    }
}

inline void claim_foreign(const std::string& path, const logs::Mapping& mapping) {
    try {
        const logs::ForeignLook look = logs::look_at_foreign(path, mapping);
        claim(look.may_be.size() == look.table.columns.size(), "each column may be something");
        if (look.missing.empty()) claim_rows(look);
    } catch (const logs::FormatError&) {
        // It is no table.
    } catch (const logs::MappingError&) {
        // It is one, and what it means is not said.
    }
}

// The bytes behind those of the mapping as a file.
inline void claim_foreign(const std::uint8_t* data, std::size_t size, const char* name) {
    const std::size_t head = std::min(size, mapping_bytes);
    Bytes bytes{data, head};
    const logs::Mapping mapping = any_mapping(bytes);
    claim_foreign(scratch().write(name, data + head, size - head), mapping);
}

}  // namespace zlg::fuzz
