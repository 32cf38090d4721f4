#pragma once
// The angle log of a source that cannot be asked again: it grows as rows come, and what was flushed stays whatever
// happens.

#include <chrono>
#include <optional>
#include <string>

#include <zlg/core/records.hpp>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/settings.hpp>

namespace zlg::cli {

// The log begins when the length of a tick is known.
class AngleRecording {
public:
    // source  as it is named in messages.
    //
    // errors  UsageError for an unknown suffix; logs::IoError: the file exists.
    AngleRecording(std::string source, std::string out, bool force);

    // settings  of the first row.
    //
    // errors  those of logs::AngleWriter.
    void write(const core::AngleRow& row, double tick_s, const logs::Settings& settings);
    void flush_now_and_then();

    // errors  logs::IoError, also where no row has come.
    void close();

    [[nodiscard]] std::string part_path() const;

private:
    std::string source_;
    std::string out_;
    bool force_;
    std::optional<logs::AngleWriter> angles_;
    std::chrono::steady_clock::time_point flushed_{};
};

}  // namespace zlg::cli
