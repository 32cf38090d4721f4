#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <filesystem>
#include <zlg/logs/angle_layout.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/log_kind.hpp>
#include <zlg/logs/raw_layout.hpp>

#include <zlg/logs/file_nature.hpp>
#include "hdf5/hdf5_source.hpp"

namespace zlg::logs {

namespace {

LogKind kind_of_hdf5(const std::string& path) {
    const hdf5::Source source{path};
    if (source.has(RawTable::group)) return LogKind::raw_hdf5;
    if (source.has(AngleTable::group)) return LogKind::angle_hdf5;
    return LogKind::unknown;
}

}  // namespace

void require_regular_file(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) fail_io("open", path, errno);
    if (S_ISDIR(status.st_mode)) throw IoError(fmt::format("cannot read {}: it is a folder", path));
    if (!S_ISREG(status.st_mode)) throw IoError(fmt::format("cannot read {}: it is no regular file", path));
}

LogKind recognise(const std::string& path) {
    require_regular_file(path);
    if (has_hdf5_signature(path)) return kind_of_hdf5(path);
    return recognise_text(path);
}

LogFormat format_of(const std::string& path) {
    const std::string suffix = std::filesystem::path{path}.extension();
    if (suffix == ".csv") return LogFormat::csv;
    if (suffix == ".h5" || suffix == ".hdf5") return LogFormat::hdf5;
    throw IoError(
        fmt::format("cannot create {}: the suffix '{}' names no format; allowed is .csv, .h5 or .hdf5", path, suffix));
}

}  // namespace zlg::logs
