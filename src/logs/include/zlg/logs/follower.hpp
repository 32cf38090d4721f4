#pragma once
// The rows of a gyro's line, each as soon as it is known.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <zlg/core/records.hpp>
#include <zlg/logs/byte_source.hpp>
#include <zlg/logs/settings.hpp>
#include <zlg/logs/wire_rows.hpp>

namespace zlg::logs {

inline constexpr int default_baud = 921600;

class Follower {
public:
    // source, baud  as ByteSource has them.
    // duration_s    end after rows of so long; nothing: when the source ends. A clock is the caller's, who calls
    // `stop`.
    //
    // errors  those of ByteSource; SourceError: a duration that is not within 0..1e9 s.
    Follower(const std::string& source, int baud, std::optional<double> duration_s);

    // nothing: none was known within 50 ms, or yet of the bytes that were there.
    enum class Next { row, nothing, end };

    // errors  IoError.
    [[nodiscard]] Next next(core::AngleRow& row);

    // Reads no more; the rows of what has arrived follow.
    void stop();

    [[nodiscard]] const WireRows& rows() const { return rows_; }
    [[nodiscard]] std::int64_t n_rows() const { return n_rows_; }        // that `next` has given
    [[nodiscard]] double angle_arcsec() const { return angle_arcsec_; }  // and the sum of their dtheta

private:
    [[nodiscard]] bool is_full() const;
    void take_bytes();

    ByteSource source_;
    std::optional<double> duration_s_;
    WireRows rows_;
    std::vector<std::uint8_t> buffer_;
    std::span<const std::uint8_t> left_;  // of the buffer
    bool is_stopped_ = false;
    std::int64_t n_rows_ = 0;
    double angle_arcsec_ = 0.0;
};

// What stands above such rows in an angle log: the names of their flags.
[[nodiscard]] Settings line_settings();

}  // namespace zlg::logs
