#include <zlg/logs/wire_order.hpp>

#include <algorithm>

#include <zlg/wire/crc.hpp>

namespace zlg::logs {
namespace {

// Of each run so many messages are remembered, from sequence 0: those by which a start without a new session shows.
constexpr std::uint32_t head_messages = 1024;
constexpr std::uint64_t is_there = std::uint64_t{1} << 32;
constexpr std::size_t max_runs = 64;
constexpr std::size_t max_others = 256;

// A message that is ahead of so many that follow it has not been overtaken: it is not the gyro's.
constexpr int max_between = 4;

// A run is longer than the numbers that can be compared.
constexpr std::uint32_t max_behind = std::uint32_t{1} << 30;

// Signed, for both wrap.
std::int32_t steps(std::uint32_t from, std::uint32_t to) { return static_cast<std::int32_t>(to - from); }

}  // namespace

bool WireOrder::continues(const Arrival& before, const Arrival& after) {
    if (after.session != before.session || after.telemetry.tick_s != before.telemetry.tick_s) return false;
    const std::int32_t messages = steps(before.sequence, after.sequence);
    const std::int32_t ticks = steps(before.telemetry.tick, after.telemetry.tick);
    const std::int32_t min_ticks = after.telemetry.has_tick ? 1 : 0;
    return messages >= 1 && messages <= max_lost_rows && ticks >= min_ticks && ticks <= max_lost_rows;
}

bool WireOrder::may_have_sent(const Run& run, const Arrival& a) {
    if (run.session != a.session || steps(run.last, a.sequence) > 0 || steps(run.first, a.sequence) < 0) return false;
    const std::uint64_t known = a.sequence < run.head.size() ? run.head[a.sequence] : 0;
    return known == 0 || known == (is_there | a.check);
}

bool WireOrder::is_known(const Arrival& a) const {
    return std::any_of(runs_.begin(), runs_.end(), [&](const Run& run) {
        return run.session == a.session && a.sequence < run.head.size() && run.head[a.sequence] == (is_there | a.check);
    });
}

bool WireOrder::came_before(const Arrival& a) const {
    return std::any_of(runs_.begin(), runs_.end(), [&](const Run& run) { return may_have_sent(run, a); });
}

void WireOrder::put(const wire::Message& message, const wire::Telemetry& telemetry) {
    const Arrival a{.telemetry = telemetry,
                    .session = message.session,
                    .sequence = message.sequence,
                    .check = wire::crc32c(message.body)};
    const bool is_held =
        held_ && held_->session == a.session && held_->sequence == a.sequence && held_->check == a.check;
    // What goes on from the last one needs no new start to explain it.
    const bool goes_on = last_ && continues(*last_, a);
    if (is_held || is_known(a)) {
        ++summary_.n_repeated;
    } else if (held_ && continues(*held_, a) && (held_fits_ || !goes_on)) {
        commit(*held_);
        hold(a, true);
    } else if (goes_on) {
        put_between(a);
    } else if (came_before(a)) {
        ++summary_.n_repeated;
    } else {
        if (held_ && held_fits_) commit(*std::exchange(held_, std::nullopt));
        refuse_held();
        hold(a, false);
    }
}

// It continues the last one, and is not continued by it what is held: that was overtaken, or is not the gyro's.
void WireOrder::put_between(const Arrival& a) {
    if (!held_ || !continues(a, *held_) || ++n_between_ > max_between) {
        refuse_held();
        return hold(a, true);
    }
    commit(a);
    if (held_->sequence == a.sequence + 1) n_between_ = 0;
}

void WireOrder::hold(const Arrival& a, bool fits) {
    held_ = a;
    held_fits_ = fits;
    n_between_ = 0;
}

void WireOrder::refuse_held() {
    if (held_) ++summary_.n_unfitting;
    held_.reset();
}

bool WireOrder::put(const wire::Message& message) {
    const std::pair number{message.session, message.sequence};
    const bool is_old = std::any_of(runs_.begin(), runs_.end(), [&](const Run& run) {
        return run.session == message.session && steps(run.last, message.sequence) <= 0;
    });
    if (is_old || std::find(others_.begin(), others_.end(), number) != others_.end()) {
        ++summary_.n_repeated;
        return false;
    }
    if (others_.size() == max_others) others_.erase(others_.begin());
    others_.push_back(number);
    return true;
}

void WireOrder::end() {
    // One that is ahead of those that followed it has nobody who continues it.
    if (held_ && held_fits_ && n_between_ == 0) commit(*std::exchange(held_, std::nullopt));
    refuse_held();
}

bool WireOrder::next(OrderedTelemetry& ordered) {
    if (waiting_.empty()) return false;
    ordered = waiting_.front();
    waiting_.pop_front();
    return true;
}

void WireOrder::commit(const Arrival& a) {
    if (!tick_s_) tick_s_ = a.telemetry.tick_s;
    if (a.telemetry.tick_s != *tick_s_) {
        ++summary_.n_other_tick;
        summary_.other_tick_s = a.telemetry.tick_s;
        return;
    }
    const Continuation continuation = last_ && continues(*last_, a) ? Continuation::next : begin(a);
    count_lost(a);
    remember(a);
    last_ = a;
    waiting_.push_back({a.telemetry, continuation});
}

// It does not continue the last one, if there was one.
Continuation WireOrder::begin(const Arrival& a) {
    const bool is_same_run =
        last_ && a.session == last_->session && !runs_.empty() && steps(runs_.back().last, a.sequence) > 0;
    if (is_same_run)
        return steps(last_->telemetry.tick, a.telemetry.tick) > 0 ? Continuation::outage : Continuation::restart;
    runs_.push_back({.session = a.session, .first = a.sequence, .last = a.sequence});
    if (runs_.size() > max_runs) runs_.pop_front();
    return last_ ? Continuation::restart : Continuation::next;
}

// Between two of one run; what else came meanwhile is not lost.
void WireOrder::count_lost(const Arrival& a) {
    const auto is_up_to_it = [&](const auto& other) {
        return other.first == a.session && steps(other.second, a.sequence) > 0;
    };
    const std::int32_t gap = steps(runs_.back().last, a.sequence) - 1;
    const auto n_others = std::count_if(others_.begin(), others_.end(), [&](const auto& other) {
        return is_up_to_it(other) && steps(runs_.back().last, other.second) > 0;
    });
    if (gap > n_others) summary_.n_lost_messages += static_cast<std::uint64_t>(gap - n_others);
    others_.erase(std::remove_if(others_.begin(), others_.end(), is_up_to_it), others_.end());
}

void WireOrder::remember(const Arrival& a) {
    Run& run = runs_.back();
    run.last = a.sequence;
    if (run.last - run.first > max_behind) run.first = run.last - max_behind;
    if (a.sequence >= head_messages) return;
    run.head.resize(head_messages);
    run.head[a.sequence] = is_there | a.check;
}

}  // namespace zlg::logs
