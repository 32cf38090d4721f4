#include <zlg/logs/wire_rows.hpp>

#include <limits>
#include <utility>

#include <zlg/wire/command.hpp>

namespace zlg::logs {
namespace {

// A gyro that has settled no tick by then is none of ours.
constexpr std::int64_t latest_first_row = 4096;

// A line that repeats what it has carried goes back by no more messages.
constexpr std::int32_t most_behind = 256;

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
    end_segment();
    segment_.reset();
}

bool WireRows::next(core::AngleRow& row) {
    if (waiting_.empty()) return false;
    Run& run = waiting_.front();
    row = run.row;
    row.tick = next_tick_++;
    // Only the first of equal rows begins anew.
    run.row.flags &= ~std::uint32_t{flag_restarted};
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
    if (!is_new(message)) return;
    if (reply) ++summary_.n_replies;
    if (status) {
        ++summary_.n_status;
        status_ = *status;
    }
    if (telemetry) take(*telemetry);
}

// Begins a segment where the gyro has started; false for a message that came before.
bool WireRows::is_new(const wire::Message& message) {
    if (segment_ && segment_->session == message.session) {
        const auto steps = static_cast<std::int32_t>(message.sequence - segment_->sequence);
        // A start begins with number 0; what is a little behind, and not near that, comes again from a line that repeats.
        const bool behind = steps < 0 && steps >= -most_behind && message.sequence >= std::uint32_t{most_behind};
        if (steps == 0 || behind) {
            ++summary_.n_repeated;
            return false;
        }
        if (steps > 0) {
            summary_.n_lost_messages += static_cast<std::uint32_t>(steps - 1);
            segment_->sequence = message.sequence;
            return true;
        }
    }
    if (segment_) {
        end_segment();
        ++summary_.n_restarts;
        restarted_ = true;
    }
    segment_ = Segment{.session = message.session, .sequence = message.sequence};
    return true;
}

void WireRows::take(const wire::Telemetry& t) {
    ++summary_.n_telemetry;
    if (!tick_s_) tick_s_ = t.tick_s;
    std::int64_t tick = t.tick;
    if (segment_->has_tick) {
        const auto last = static_cast<std::uint32_t>(segment_->tick);
        tick = segment_->tick + static_cast<std::int32_t>(t.tick - last);
        const bool back = tick < segment_->tick || (t.has_tick && tick == segment_->tick);
        if (back || tick - segment_->tick > max_lost_rows) {
            // Measuring has begun anew, or so long ago that it may have.
            end_segment();
            ++summary_.n_restarts;
            restarted_ = true;
            segment_ = Segment{.session = segment_->session, .sequence = segment_->sequence};
            tick = t.tick;
        }
    }
    if (!segment_->has_tick) begin_rows(t, tick);
    if (!segment_->has_tick) return;
    segment_->tick = tick;
    segment_->angle = t.angle;
    if (t.has_tick && tick >= segment_->next_row)
        segment_->told.insert_or_assign(tick, Told{t.dtheta_arcsec, t.mode, t.flags});
    if (t.has_settled) take_settled(t, tick);
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
    s.told.erase(s.told.begin(), s.told.lower_bound(s.next_row));
}

// Rows up to `end_row`, of which the sums are known and, of some, what was told in real time.
void WireRows::fill(std::int64_t end_row, double dtheta_sum_arcsec, double correction_arcsec) {
    Segment& s = *segment_;
    const auto n = end_row - s.next_row;
    const auto end = s.told.lower_bound(end_row);
    std::int64_t n_unknown = n;
    for (auto told = s.told.begin(); told != end; ++told) {
        dtheta_sum_arcsec -= told->second.dtheta_arcsec;
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
    for (auto told = s.told.begin(); told != end; ++told) {
        put_rows(share_arcsec, mode_, flag_lost, told->first - s.next_row);
        put_rows(told->second.dtheta_arcsec, told->second.mode, told->second.flags, 1);
        s.next_row = told->first + 1;
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
    if (std::exchange(restarted_, false)) waiting_.back().row.flags |= flag_restarted;
}

}  // namespace zlg::logs
