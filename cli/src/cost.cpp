#include "cost.hpp"

#include <sys/statvfs.h>

#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include <zlg/logs/error.hpp>

#include "failure.hpp"

namespace zlg::cli {
namespace {

constexpr double announced_bytes = 1e9;
constexpr double announced_s = 300.0;  // the paper recomputed, a minute or so, is no news

// An estimate that is a third too high must not refuse what would fit.
constexpr double certain = 2.0 / 3.0;

std::string size_text(double bytes) {
    if (bytes >= 1e15) return fmt::format("{:.3g} PB", bytes / 1e15);
    if (bytes >= 1e12) return fmt::format("{:.3g} TB", bytes / 1e12);
    if (bytes >= 1e9) return fmt::format("{:.3g} GB", bytes / 1e9);
    return fmt::format("{:.3g} MB", bytes / 1e6);
}

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
    throw logs::IoError{fmt::format(
        "{}: {:.6g} ticks need about {} of disk, {} are free; allowed is a shorter run.duration_s or a longer "
        "gyro.tick_s",
        out.empty() ? "--out" : out, static_cast<double>(ticks), size_text(bytes), size_text(*room))};
}

double Growth::expected_bytes(double fraction) {
    // Less may be the beginning of the file, or a block that is not yet full.
    constexpr double min_bytes = 2e6;
    std::error_code is_missing;
    const auto size = std::filesystem::file_size(part_, is_missing);
    const double written_bytes = is_missing ? 0.0 : static_cast<double>(size);
    if (written_bytes < min_bytes) return 0.0;
    const double bytes = written_bytes / fraction;
    const std::optional<double> room = free_bytes(part_);
    if (room && certain * bytes - written_bytes > *room)
        throw logs::IoError{
            fmt::format("{}: needs about {} of disk in all, {} are free", part_, size_text(bytes), size_text(*room))};
    return bytes;
}

void Growth::look(double past_s, double fraction) {
    constexpr double early_s = 1.0;
    if (is_over_ || fraction <= 0.0 || (bytes_ > 0.0 && past_s < early_s)) return;
    if (!part_.empty()) bytes_ = expected_bytes(fraction);
    if (past_s < early_s) return;
    is_over_ = true;
    const double time_s = past_s / fraction;
    if (time_s < announced_s && bytes_ < announced_bytes) return;
    const std::string disk = bytes_ > 0.0 ? fmt::format(" and {} of disk", size_text(bytes_)) : "";
    complain(fmt::format("warning: this takes about {}{}", time_text(time_s), disk));
}

}  // namespace zlg::cli
