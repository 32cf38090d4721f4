#include <zlg/logs/wire_rows.hpp>

#include <limits>
#include <utility>

#include <zlg/wire/command.hpp>

namespace zlg::logs {
namespace {

// A gyro that has settled no tick by then is none of ours.
constexpr std::int64_t latest_first_row = 4096;

// The reading of a register before `arcsec` was added to it.
std::uint64_t before(std::uint64_t reading, double arcsec) {
    // Rounded, where the register itself was cut off below.
    wire::AngleRegister r{reading, std::uint64_t{1} << 63};
    r.add(-arcsec);
    return r.high;
}

core::AngleRow settled_row(const wire::Telemetry& t) {
    return {.dtheta_arcsec = t.settled_dtheta_arcsec,
            .dtheta_final_arcsec = t.settled_final_arcsec,
            .sigma_arcsec = t.settled_sigma_arcsec,
            .mode = t.settled_mode,
            .flags = t.settled_flags};
}

}  // namespace

void WireRows::take(std::span<const std::uint8_t> bytes) {
    summary_.n_bytes += bytes.size();
    wire::Message message;
    while (wire::receive(receiver_, bytes, message)) take(message);
    summary_.n_damaged += std::exchange(receiver_.n_damaged, 0u);
    summary_.n_foreign += std::exchange(receiver_.n_foreign, 0u);
    summary_.n_damaged_bytes += std::exchange(receiver_.n_skipped, 0u);
}

void WireRows::end() {
    // A frame without its end is damaged too.
    if (receiver_.n_held > 0) {
        ++summary_.n_damaged;
        summary_.n_damaged_bytes += std::exchange(receiver_.n_held, 0u);
    }
    order_.end();
    pass_on();
    end_segment();
    segment_.reset();
}

bool WireRows::next(core::AngleRow& row) {
    if (waiting_.empty()) return false;
    Run& run = waiting_.front();
    row = run.row;
    row.tick = next_tick_++;
    // Only the first of equal rows begins anew.
    run.row.flags &= ~std::uint32_t{flag_restarted | flag_outage};
    if (--run.n == 0) waiting_.pop_front();
    return true;
}

void WireRows::take(const wire::Message& message) {
    const auto telemetry = wire::telemetry_in(message);
    const auto status = wire::status_in(message);
    const bool reply = wire::reply_in(message).has_value();
    if (!telemetry && !status && !reply) {
        ++summary_.n_refused;
        return;
    }
    if (telemetry) {
        order_.put(message, *telemetry);
    } else if (order_.put(message)) {
        summary_.n_replies += reply ? 1u : 0u;
        summary_.n_status += status ? 1u : 0u;
        if (status) status_ = *status;
    }
    pass_on();
}

void WireRows::pass_on() {
    OrderedTelemetry ordered;
    while (order_.next(ordered)) take(ordered);
    static_cast<OrderSummary&>(summary_) = order_.summary();
}

// The message's tick, in the numbers of the segment that it belongs to.
std::int64_t WireRows::begin_segment(const OrderedTelemetry& ordered) {
    const wire::Telemetry& t = ordered.telemetry;
    const bool goes_on = segment_ && segment_->has_tick && ordered.continuation != Continuation::restart;
    const std::int64_t tick =
        goes_on ? segment_->tick + static_cast<std::int32_t>(t.tick - static_cast<std::uint32_t>(segment_->tick))
                : t.tick;
    if (segment_ && ordered.continuation == Continuation::next) return tick;
    end_segment();
    if (ordered.continuation == Continuation::restart) {
        ++summary_.n_restarts;
        first_flags_ |= flag_restarted;
        outage_.reset();
    } else if (goes_on) {
        ++summary_.n_outages;
        first_flags_ |= flag_outage;
        outage_ = Outage{.tick = segment_->tick, .angle = segment_->angle};
    }
    segment_ = Segment{};
    return tick;
}

void WireRows::take(const OrderedTelemetry& ordered) {
    const wire::Telemetry& t = ordered.telemetry;
    ++summary_.n_telemetry;
    const std::int64_t tick = begin_segment(ordered);
    if (!segment_->has_tick) begin_rows(t, tick);
    if (!segment_->has_tick) return;
    segment_->tick = tick;
    segment_->angle = t.angle;
    if (t.has_tick && tick >= segment_->next_row)
        segment_->reported.insert_or_assign(tick, Reported{t.dtheta_arcsec, t.mode, t.flags, t.angle});
    if (t.has_settled) take_settled(t, tick);
    write_overdue(tick);
}

// With the oldest tick of which there will be a row.
void WireRows::begin_rows(const wire::Telemetry& t, std::int64_t tick) {
    Segment& s = *segment_;
    if (t.has_settled) {
        s.next_row = tick - t.settled_age_ticks;
        s.settled_angle = before(t.settled_angle, t.settled_dtheta_arcsec);
        s.settled_final_angle = before(t.settled_final_angle, t.settled_final_arcsec);
    } else if (tick > latest_first_row) {
        return;
    }
    s.has_tick = true;
    if (!outage_) return;
    summary_.n_outage_ticks += static_cast<std::uint64_t>(s.next_row - outage_->tick - 1);
    summary_.outage_arcsec += wire::turned_arcsec(outage_->angle, s.settled_angle);
    outage_.reset();
}

void WireRows::take_settled(const wire::Telemetry& t, std::int64_t tick) {
    Segment& s = *segment_;
    const std::int64_t settled = tick - t.settled_age_ticks;
    if (settled < s.next_row) return;
    if (settled > s.next_row) {
        const double dtheta_sum_arcsec =
            wire::turned_arcsec(s.settled_angle, before(t.settled_angle, t.settled_dtheta_arcsec));
        const double final_sum_arcsec =
            wire::turned_arcsec(s.settled_final_angle, before(t.settled_final_angle, t.settled_final_arcsec));
        fill(settled, dtheta_sum_arcsec, final_sum_arcsec - dtheta_sum_arcsec);
    }
    put(settled_row(t), 1);
    s.next_row = settled + 1;
    s.settled_angle = t.settled_angle;
    s.settled_final_angle = t.settled_final_angle;
    s.reported.erase(s.reported.begin(), s.reported.lower_bound(s.next_row));
}

// What is not settled by now never will be: so nothing waits for ever, neither in memory nor for the file.
void WireRows::write_overdue(std::int64_t tick) {
    Segment& s = *segment_;
    auto report = s.reported.upper_bound(tick - wire::max_settled_age_ticks);
    if (report == s.reported.begin()) return;
    --report;
    const auto [row, angle] = std::pair{report->first, report->second.angle};
    const double sum_arcsec = wire::turned_arcsec(s.settled_angle, angle);
    fill(row + 1, sum_arcsec, 0.0);
    s.settled_angle = angle;
    // The rows have the same sum in both columns.
    s.settled_final_angle = before(s.settled_final_angle, -sum_arcsec);
    s.reported.erase(s.reported.begin(), s.reported.lower_bound(s.next_row));
}

// Rows up to `end_row`, of which the sums are known and, of some, what was reported in real time.
void WireRows::fill(std::int64_t end_row, double dtheta_sum_arcsec, double correction_arcsec) {
    Segment& s = *segment_;
    const auto n = end_row - s.next_row;
    const auto end = s.reported.lower_bound(end_row);
    std::int64_t n_unknown = n;
    for (auto report = s.reported.begin(); report != end; ++report) {
        dtheta_sum_arcsec -= report->second.dtheta_arcsec;
        --n_unknown;
    }
    const double share_arcsec = n_unknown > 0 ? dtheta_sum_arcsec / static_cast<double>(n_unknown) : 0.0;
    const double added_arcsec = correction_arcsec / static_cast<double>(n);
    const auto put_rows = [&](double dtheta_arcsec, std::int8_t mode, std::uint32_t flags, std::int64_t count) {
        put({.dtheta_arcsec = dtheta_arcsec,
             .dtheta_final_arcsec = dtheta_arcsec + added_arcsec,
             .sigma_arcsec = std::numeric_limits<double>::infinity(),
             .mode = mode,
             .flags = flags | flag_final_lost},
            count);
    };
    for (auto report = s.reported.begin(); report != end; ++report) {
        put_rows(share_arcsec, mode_, flag_lost, report->first - s.next_row);
        put_rows(report->second.dtheta_arcsec, report->second.mode, report->second.flags, 1);
        s.next_row = report->first + 1;
    }
    put_rows(share_arcsec, mode_, flag_lost, end_row - s.next_row);
    s.next_row = end_row;
}

// Ticks whose settled rows nobody will send any more.
void WireRows::end_segment() {
    if (!segment_ || !segment_->has_tick || segment_->tick < segment_->next_row) return;
    fill(segment_->tick + 1, wire::turned_arcsec(segment_->settled_angle, segment_->angle), 0.0);
}

void WireRows::put(const core::AngleRow& row, std::int64_t n) {
    if (n <= 0) return;
    mode_ = row.mode;
    const auto count = static_cast<std::uint64_t>(n);
    summary_.n_rows += count;
    summary_.n_lost_rows += (row.flags & flag_lost) != 0 ? count : 0;
    summary_.n_final_lost_rows += (row.flags & flag_final_lost) != 0 ? count : 0;
    summary_.angle_arcsec += static_cast<double>(n) * row.dtheta_arcsec;
    waiting_.push_back({row, n});
    waiting_.back().row.flags |= std::exchange(first_flags_, 0u);
}

}  // namespace zlg::logs
