#pragma once
// The angle log out of a gyro's line: rows from whatever bytes arrive, and what was lost on the way.
//
// Each message brings the row of a settled tick, and the sums of both columns up to it. So a loss takes the rows, but not
// the angle: the missing rows share what the sums have grown by. What was told of such a tick in real time is kept.

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>

#include <zlg/core/records.hpp>
#include <zlg/wire/frame.hpp>
#include <zlg/wire/status.hpp>
#include <zlg/wire/telemetry.hpp>

namespace zlg::logs {

// Bits of a row's flags beside core::AngleFlag.
enum WireFlag : std::uint32_t {
    flag_lost = 1u << 16,        // dtheta did not arrive: an equal share of the angle that was lost with it
    flag_final_lost = 1u << 17,  // nor did dtheta_final: dtheta, with a share of the corrections; sigma is inf
    flag_restarted = 1u << 18,   // first row after a start of the gyro: its turn meanwhile is in no row
};

// Rows that may be missing in a row of messages and are still filled in: 23 hours of ticks of 5 ms. After more the log goes
// on as after a restart.
inline constexpr std::int64_t max_lost_rows = std::int64_t{1} << 24;

struct WireSummary {
    std::uint64_t n_bytes = 0;
    std::uint64_t n_telemetry = 0;  // messages that were taken
    std::uint64_t n_status = 0;
    std::uint64_t n_replies = 0;
    std::uint64_t n_lost_messages = 0;  // by the sequence numbers
    std::uint64_t n_repeated = 0;       // messages that came again, not taken
    std::uint64_t n_refused = 0;        // whole frames that hold what no gyro sends
    std::uint64_t n_damaged = 0;        // pieces between zeros that are no whole frame of this line's version
    std::uint64_t n_foreign = 0;        // of these: whole, but of another version
    std::uint64_t n_damaged_bytes = 0;  // and their bytes
    std::uint64_t n_rows = 0;
    std::uint64_t n_lost_rows = 0;        // with flag_lost
    std::uint64_t n_final_lost_rows = 0;  // with flag_final_lost
    std::uint64_t n_restarts = 0;
    double angle_arcsec = 0.0;  // sum of dtheta of all rows
};

class WireRows {
public:
    // Any bytes, in pieces of any length. Rows that follow from them wait in `next`.
    void take(std::span<const std::uint8_t> bytes);

    // Nothing more comes: the ticks that are not settled follow as rows too, with flag_final_lost.
    void end();

    // The next row, its tick counted from 0 without holes; false where none waits.
    bool next(core::AngleRow& row);

    [[nodiscard]] const WireSummary& summary() const { return summary_; }

    // Length of a tick, as the first message has it; nothing before.
    [[nodiscard]] std::optional<double> tick_s() const { return tick_s_; }
    [[nodiscard]] const std::optional<wire::Status>& status() const { return status_; }  // the last one

private:
    // Told in real time of a tick that is not settled.
    struct Told {
        double dtheta_arcsec;
        std::int8_t mode;
        std::uint32_t flags;
    };
    // Equal rows.
    struct Run {
        core::AngleRow row;
        std::int64_t n;
    };
    // From one start of the gyro to the next.
    struct Segment {
        std::uint16_t session = 0;
        std::uint32_t sequence = 0;       // of the last message
        bool has_tick = false;            // the next ones are known
        std::int64_t tick = 0;            // of the last message
        std::uint64_t angle = 0;          // with that tick
        std::int64_t next_row = 0;        // tick
        std::uint64_t settled_angle = 0;  // before that row
        std::uint64_t settled_final_angle = 0;
        std::map<std::int64_t, Told> told{};  // from next_row on
    };

    void take(const wire::Message& message);
    bool is_new(const wire::Message& message);
    void take(const wire::Telemetry& telemetry);
    void begin_rows(const wire::Telemetry& telemetry, std::int64_t tick);
    void take_settled(const wire::Telemetry& telemetry, std::int64_t tick);
    void fill(std::int64_t end_row, double dtheta_sum_arcsec, double correction_arcsec);
    void end_segment();
    void put(const core::AngleRow& row, std::int64_t n);

    wire::Receiver receiver_{};
    std::optional<Segment> segment_{};
    bool restarted_ = false;  // the next row is the first after a restart
    std::int8_t mode_ = 1;    // of the last row
    std::deque<Run> waiting_{};
    std::optional<double> tick_s_{};
    std::optional<wire::Status> status_{};
    WireSummary summary_{};
    std::int64_t next_tick_ = 0;
};

}  // namespace zlg::logs
