#pragma once
// A gyro that speaks over a line, and what the log of it should hold.

#include <zlg/logs/wire_rows.hpp>

#include "test.hpp"

namespace zlg::logs {

using Bytes = std::vector<std::uint8_t>;
inline constexpr double inf = std::numeric_limits<double>::infinity();
inline constexpr int delay_ticks = 7;

// A gyro that turns unevenly; what is settled of a tick comes `delay_ticks` later.
class Gyro {
public:
    explicit Gyro(std::uint16_t session = 1, std::uint32_t sequence = 0, std::int64_t first_tick = 0,
                  double amplitude_arcsec = 100.0)
        : sender_{.session = session, .sequence = sequence},
          tick_{first_tick},
          first_tick_{first_tick},
          amplitude_arcsec_{amplitude_arcsec} {}

    Bytes tick() {
        const core::AngleRow row{
            .tick = tick_,
            .dtheta_arcsec = std::floor(amplitude_arcsec_ * std::sin(0.1 * static_cast<double>(tick_))) + 0.25,
            .dtheta_final_arcsec =
                std::floor(1.01 * amplitude_arcsec_ * std::sin(0.1 * static_cast<double>(tick_))) + 0.125,
            .sigma_arcsec = 1.5,
            .mode = static_cast<std::int8_t>(tick_ % 40 < 20 ? 1 : -1),
            .flags = static_cast<std::uint32_t>(tick_ % 5)};
        rows.push_back(row);
        core::AngleSample sample{.tick = tick_, .dtheta_arcsec = row.dtheta_arcsec, .flags = row.flags};
        if (tick_ - first_tick_ >= delay_ticks) {
            sample.has_final = true;
            sample.final_row = rows[rows.size() - 1 - delay_ticks];
        }
        ++tick_;
        return bytes_of(
            telemetry_of(state_, sample,
                         {.mode = row.mode,
                          .tick_s = tick_s,
                          .time = {.timer_ticks = 50'000u * static_cast<std::uint64_t>(tick_ - first_tick_)}}));
    }
    Bytes drain() {
        Bytes all;
        const std::size_t n = std::min<std::size_t>(rows.size(), delay_ticks);
        for (std::size_t k = rows.size() - n; k < rows.size(); ++k) {
            const Bytes one = bytes_of(telemetry_of(state_, rows[k], {.tick_s = 0.005}));
            all.insert(all.end(), one.begin(), one.end());
        }
        return all;
    }
    Bytes status() { return bytes_of(wire::Status{.tick_s = 0.005, .scale_arcsec = 3.0}); }

    double tick_s = 0.005;
    std::vector<core::AngleRow> rows;  // of all ticks, from first_tick on

private:
    template <class T> Bytes bytes_of(const T& message) {
        const wire::Frame frame = frame_of(sender_, message);
        return {frame.view().begin(), frame.view().end()};
    }

    wire::Sender sender_;
    wire::TelemetryState state_{};
    std::int64_t tick_;
    std::int64_t first_tick_;
    double amplitude_arcsec_;
};

inline std::vector<core::AngleRow> rows_of(WireRows& rows) {
    std::vector<core::AngleRow> all;
    core::AngleRow row;
    while (rows.next(row)) all.push_back(row);
    return all;
}

inline double sum(const std::vector<core::AngleRow>& rows, double core::AngleRow::*column) {
    double total = 0.0;
    for (const core::AngleRow& row : rows) total += row.*column;
    return total;
}

inline void expect_numbered(const std::vector<core::AngleRow>& rows) {
    for (std::size_t k = 0; k < rows.size(); ++k) ASSERT_EQ(rows[k].tick, static_cast<std::int64_t>(k));
}

}  // namespace zlg::logs
