#pragma once
// Every claim about a log of any kind.

#include "angle_claims.hpp"
#include "raw_claims.hpp"

namespace zlg::fuzz {

// What the file is taken for, or nothing where it is refused.
inline std::optional<logs::LogKind> recognised(const std::string& path) {
    try {
        return logs::recognise(path);
    } catch (const logs::FormatError&) {
        return std::nullopt;
    } catch (const logs::IoError&) {
        return std::nullopt;
    }
}

// A file may be read as what it is not.
inline void claim_log(const std::string& path) {
    (void)recognised(path);
    if (const std::optional<RawLog> log = read_raw(path)) claim_raw_survives(*log);
    if (const std::optional<AngleLog> log = read_angles(path)) claim_angles_survive(*log);
}

}  // namespace zlg::fuzz
