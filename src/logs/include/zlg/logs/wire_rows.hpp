#pragma once
// The angle log out of a gyro's line: rows from whatever bytes arrive, and what was lost on the way.
//
// Each message brings the row of a settled tick, and the sums of both columns up to it. So a loss takes the rows, but
// not the angle: the missing rows share what the sums have grown by. What was reported of such a tick in real time is
// kept.

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>

#include <zlg/core/records.hpp>
#include <zlg/logs/wire_order.hpp>
#include <zlg/wire/frame.hpp>
#include <zlg/wire/status.hpp>
#include <zlg/wire/telemetry.hpp>

namespace zlg::logs {

// Bits of a row's flags beside core::AngleFlag.
enum WireFlag : std::uint32_t {
    flag_lost = 1u << 16,        // dtheta did not arrive: an equal share of the angle that was lost with it
    flag_final_lost = 1u << 17,  // nor did dtheta_final: dtheta, with a share of the corrections; sigma is inf
    flag_restarted = 1u << 18,   // first row after a start of the gyro: its turn meanwhile is in no row
    flag_outage = 1u << 19,  // first row after more than max_lost_rows were lost: they, and their turn, are in no row
};

struct WireSummary : OrderSummary {
    std::uint64_t n_bytes = 0;
    std::uint64_t n_telemetry = 0;  // messages that were taken
    std::uint64_t n_status = 0;
    std::uint64_t n_replies = 0;
    std::uint64_t n_refused = 0;        // whole frames that hold what no gyro sends
    std::uint64_t n_damaged = 0;        // pieces between zeros that are no whole frame of this line's version
    std::uint64_t n_foreign = 0;        // of these: whole, but of another version
    std::uint64_t n_damaged_bytes = 0;  // and their bytes
    std::uint64_t n_rows = 0;
    std::uint64_t n_lost_rows = 0;        // with flag_lost
    std::uint64_t n_final_lost_rows = 0;  // with flag_final_lost
    std::uint64_t n_restarts = 0;
    std::uint64_t n_outages = 0;  // of more than max_lost_rows; in all of them:
    std::uint64_t n_outage_ticks = 0;
    double outage_arcsec = 0.0;
    double angle_arcsec = 0.0;  // sum of dtheta of all rows
};

class WireRows {
public:
    // Any bytes, in pieces of any length. Rows that follow from them wait in `next`: a message brings 2 max_lost_rows
    // at most. Each is taken when the next one shows that it fits.
    void take(std::span<const std::uint8_t> bytes);

    // Nothing more comes: the ticks that are not settled follow as rows too, with flag_final_lost.
    void end();

    // The next row, its tick counted from 0 without holes; false where none waits.
    bool next(core::AngleRow& row);

    [[nodiscard]] const WireSummary& summary() const { return summary_; }

    // Length of a tick, the same in all rows; nothing before the first of them.
    [[nodiscard]] std::optional<double> tick_s() const { return order_.tick_s(); }
    [[nodiscard]] const std::optional<wire::Status>& status() const { return status_; }  // the last one

private:
    // Reported in real time of a tick that is not settled.
    struct Reported {
        double dtheta_arcsec;
        std::int8_t mode;
        std::uint32_t flags;
        std::uint64_t angle;  // up to and with it
    };
    // Equal rows.
    struct Run {
        core::AngleRow row;
        std::int64_t n;
    };
    // From one restart or outage to the next.
    struct Segment {
        bool has_tick = false;            // the next ones are known
        std::int64_t tick = 0;            // of the last message
        std::uint64_t angle = 0;          // with that tick
        std::int64_t next_row = 0;        // tick
        std::uint64_t settled_angle = 0;  // before that row
        std::uint64_t settled_final_angle = 0;
        std::map<std::int64_t, Reported> reported{};  // from next_row on
    };

    // Where the last row before an outage was.
    struct Outage {
        std::int64_t tick;
        std::uint64_t angle;
    };

    void take(const wire::Message& message);
    void pass_on();
    void take(const OrderedTelemetry& ordered);
    std::int64_t begin_segment(const OrderedTelemetry& ordered);
    void begin_rows(const wire::Telemetry& telemetry, std::int64_t tick);
    void take_settled(const wire::Telemetry& telemetry, std::int64_t tick);
    void write_overdue(std::int64_t tick);
    void fill(std::int64_t end_row, double dtheta_sum_arcsec, double correction_arcsec);
    void end_segment();
    void put(const core::AngleRow& row, std::int64_t n);

    wire::Receiver receiver_{};
    WireOrder order_{};
    std::optional<Segment> segment_{};
    std::optional<Outage> outage_{};  // that the next row ends
    std::uint32_t first_flags_ = 0;   // of the next row alone
    std::int8_t mode_ = 1;            // of the last row
    std::deque<Run> waiting_{};
    std::optional<wire::Status> status_{};
    WireSummary summary_{};
    std::int64_t next_tick_ = 0;
};

}  // namespace zlg::logs
