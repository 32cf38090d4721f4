#include "angle_recording.hpp"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include <zlg/logs/error.hpp>

#include "options.hpp"

namespace zlg::cli {

AngleRecording::AngleRecording(std::string source, std::string out, bool force)
    : source_{std::move(source)}, out_{std::move(out)}, force_{force} {
    (void)log_format(out_);
    if (!force_ && std::filesystem::exists(std::filesystem::symlink_status(out_)))
        throw logs::IoError{fmt::format("{} exists; use --force to overwrite", out_)};
}

void AngleRecording::write(const core::AngleRow& row, double tick_s, const logs::Settings& settings) {
    if (!angles_)
        angles_.emplace(out_, tick_s, settings, force_,
                        logs::AngleWriterOptions{.keep_part = true, .keep_csv_part = true});
    angles_->write(row);
}

void AngleRecording::flush_now_and_then() {
    constexpr std::chrono::milliseconds flush_every{500};
    const auto now = std::chrono::steady_clock::now();
    if (!angles_ || now - flushed_ < flush_every) return;
    angles_->flush();
    flushed_ = now;
}

void AngleRecording::close() {
    if (!angles_)
        throw logs::IoError{fmt::format("{}: not one message of a gyro in it; {} is not written", source_, out_)};
    angles_->close();
}

std::string AngleRecording::part_path() const { return angles_ ? angles_->part_path() : std::string{}; }

}  // namespace zlg::cli
