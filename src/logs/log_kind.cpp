#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <string_view>
#include <zlg/logs/angle_layout.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/log_kind.hpp>
#include <zlg/logs/raw_layout.hpp>

#include "csv/csv_head.hpp"
#include "hdf5/hdf5_source.hpp"
#include "signature.hpp"

namespace zlg::logs {

namespace {

void refuse_what_cannot_be_read_twice(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) {
        throw IoError(fmt::format("cannot open {}: {}", path, std::strerror(errno)));
    }
    if (S_ISDIR(status.st_mode)) throw IoError(fmt::format("cannot read {}: it is a folder", path));
    if (!S_ISREG(status.st_mode)) throw IoError(fmt::format("cannot read {}: it is no regular file", path));
}

std::ptrdiff_t hits(const CsvHead& head, std::initializer_list<std::string_view> known) {
    return std::ranges::count_if(head.names, [&](const std::string& name) {
        return std::ranges::find(known, std::string_view{name}) != known.end();
    });
}

LogKind kind_of_hdf5(const std::string& path) {
    const hdf5::Source source{path};
    if (source.has(RawTable::group)) return LogKind::raw_hdf5;
    if (source.has(AngleTable::group)) return LogKind::angle_hdf5;
    return LogKind::unknown;
}

}  // namespace

LogKind recognise(const std::string& path) {
    refuse_what_cannot_be_read_twice(path);
    if (has_hdf5_signature(path)) return kind_of_hdf5(path);
    try {
        LineReader lines{path};
        const CsvHead head = read_head(lines);
        const auto raw = hits(head, {"half", "bias_sign", "counts", "loop_closed"});
        const auto angle = hits(head, {"tick", "t_s", "dtheta_arcsec", "dtheta_final_arcsec", "sigma_arcsec", "flags"});
        if (raw >= 2 && raw > angle) return LogKind::raw_csv;
        if (angle >= 2 && angle > raw) return LogKind::angle_csv;
    } catch (const FormatError&) {
        // Not the text of a log: that is the answer, not a failure.
    }
    return LogKind::unknown;
}

LogFormat format_of(const std::string& path) {
    const std::string suffix = std::filesystem::path{path}.extension();
    if (suffix == ".csv") return LogFormat::csv;
    if (suffix == ".h5" || suffix == ".hdf5") return LogFormat::hdf5;
    throw IoError(
        fmt::format("cannot create {}: the suffix '{}' names no format; allowed is .csv, .h5 or .hdf5", path, suffix));
}

}  // namespace zlg::logs
