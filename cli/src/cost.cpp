#include "cost.hpp"

#include <sys/statvfs.h>

#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include <zlg/logs/error.hpp>

namespace zlg::cli {
namespace {

// An estimate that is a third too high must not refuse what would fit.
constexpr double certain = 2.0 / 3.0;

std::optional<double> free_bytes(const std::string& out) {
    namespace fs = std::filesystem;
    std::error_code ignored;
    fs::path place{out.empty() ? "." : out};
    if (!fs::is_directory(place, ignored)) place = place.has_parent_path() ? place.parent_path() : fs::path{"."};
    struct statvfs disk {};
    if (::statvfs(place.c_str(), &disk) != 0) return std::nullopt;
    return static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize);
}

}  // namespace

std::string time_text(double s) {
    if (s >= 2.0 * 365.25 * 86400.0) return fmt::format("{:.3g} years", s / (365.25 * 86400.0));
    if (s >= 2.0 * 86400.0) return fmt::format("{:.3g} days", s / 86400.0);
    if (s >= 2.0 * 3600.0) return fmt::format("{:.2g} hours", s / 3600.0);
    if (s >= 120.0) return fmt::format("{:.2g} minutes", s / 60.0);
    return fmt::format("{:.2g} s", s);
}

void require_room(std::int64_t ticks, double bytes_a_tick, const std::string& out) {
    const double bytes = static_cast<double>(ticks) * bytes_a_tick;
    const std::optional<double> room = free_bytes(out);
    if (!room || certain * bytes <= *room) return;
    throw logs::IoError{
        fmt::format("{}: {:.6g} ticks need about {:.3g} GB of disk, {:.3g} GB are free; allowed is a shorter "
                    "run.duration_s or a longer gyro.tick_s",
                    out.empty() ? "--out" : out, static_cast<double>(ticks), 1e-9 * bytes, 1e-9 * *room)};
}

}  // namespace zlg::cli
