#include <zlg/core/control/reading_monitor.hpp>

#include <zlg/core/common/as_double.hpp>
#include <zlg/core/control/monitor_limits.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// Two wrong readings in a row can be one disturbance that spans both; the same error four times over is none.
constexpr std::int32_t agreeing_debounce = 4;

// Longer than the longest gap that is bridged, wherever it begins in a tick.
constexpr std::int32_t held_halves = 36;

// Halves in a row with less than half of the bias: no disturbance of readings lasts so long (the coil current, where it
// is measured, shows it at once).
constexpr std::int32_t lost_debounce_halves = 16;

// A counter that cannot follow stops near the end of its range; more than that is no count of a fringe.
constexpr double stop_from = 0.98;
constexpr double stop_to = 1.05;

std::int64_t difference(std::uint64_t a, std::uint64_t b) noexcept { return static_cast<std::int64_t>(a - b); }

// T - P.
double apart(const ReadingMonitorState& s, const ReadingMonitorInput& in, std::int32_t m) noexcept {
    const double bias = m % 2 != 0 ? in.beat_sign * in.bias_counts : 0.0;
    return as_double(difference(in.reading, s.good)) - m * s.rate_counts - bias;
}

// T and P agree within this: the bias is known to a sixth, the rate may go on changing as it last did; half of the bias
// at most.
bool has_returned(const ReadingMonitorState& s, const ReadingMonitorInput& in, std::int32_t m) noexcept {
    if (!s.rate_known || !in.agrees) return false;
    const double bias = in.bias_counts > min_bias_counts ? in.bias_counts : min_bias_counts;
    const double some = bias / 6.0 + 0.5 * s.change_counts * m * (m + 1);
    const double most = 0.5 * bias;
    return size(apart(s, in, m)) <= (some < most ? some : most);
}

// From here on the next differences begin.
void begin(ReadingMonitorState& s, const ReadingMonitorInput& in) noexcept {
    s.good = in.reading;
    s.mode = in.mode;
    s.n_since = 0;
    s.countable = true;
    s.suspected = s.over_range = false;
    s.n_agreeing = s.n_watched = s.n_lost = 0;
}

void follow_rate(ReadingMonitorState& s, const ReadingMonitorInput& in, std::int64_t counts) noexcept {
    const double rate = as_double(counts) - in.beat_sign * in.bias_counts;
    s.change_counts = s.rate_known ? size(rate - s.rate_counts) : 0.0;
    s.rate_counts = rate;
    s.rate_known = true;
}

// More counts than m halves can have.
bool is_over(const ReadingMonitorInput& in, std::int64_t counts, std::int32_t m, double part) noexcept {
    return size(as_double(counts)) > part * in.max_counts * m;
}

bool is_at_stop(const ReadingMonitorInput& in, std::int64_t counts, std::int32_t m) noexcept {
    return is_over(in, counts, m, stop_from) && !is_over(in, counts, m, stop_to);
}

// The half as it is by itself, from the reading before.
ReadingMonitorOutput alone(ReadingMonitorState& s, const ReadingMonitorInput& in) noexcept {
    ReadingMonitorOutput out;
    if (s.has_last) {
        out.trusted = true;
        out.counts = difference(in.reading, s.last);
        follow_rate(s, in, out.counts);
    } else {
        s.rate_known = false;
    }
    begin(s, in);
    return out;
}

ReadingMonitorOutput whole(ReadingMonitorState& s, const ReadingMonitorInput& in) noexcept {
    const ReadingMonitorOutput out{
        .trusted = true, .span = s.n_since + 1, .counts = difference(in.reading, s.good), .continues = true};
    s.rate_known = false;
    if (s.has_last) follow_rate(s, in, difference(in.reading, s.last));
    begin(s, in);
    return out;
}

void suspect(ReadingMonitorState& s, const ReadingMonitorInput& in) noexcept {
    s.suspected = true;
    s.n_agreeing = s.n_watched = s.n_lost = 0;
    s.impossible = s.n_since == 0 && is_over(in, difference(in.reading, s.good), 1, stop_to);
}

// A half of those that wait for a judgement.
void watch(ReadingMonitorState& s, const ReadingMonitorInput& in) noexcept {
    count_up(s.n_watched);
    count_row(s.n_agreeing, in.agrees);
    if (debounced(s.n_lost, in.bias_lost, lost_debounce_halves)) s.countable = false;
    if (s.has_last && is_at_stop(in, difference(in.reading, s.last), 1)) s.over_range = true;
}

ReadingMonitorOutput decide(ReadingMonitorState& s, const ReadingMonitorInput& in) noexcept {
    const std::int32_t m = s.n_since + 1;
    const std::int64_t counts = difference(in.reading, s.good);
    if (!s.suspected) {
        // By its difference to the reading before, where there is one.
        const bool odd = in.suspicious && s.has_last;
        if (!odd && (m == 1 || !is_over(in, counts, m, 1.0))) return whole(s, in);
        suspect(s, in);
        s.over_range = is_at_stop(in, counts, m);
        return {};
    }
    watch(s, in);
    if (!s.countable) return {};
    if (!s.over_range && has_returned(s, in, m)) return whole(s, in);
    // Readings that never agree so long are a motion that leaves the band again and again.
    const bool waited = s.n_watched >= held_halves && in.agrees;
    if (s.n_agreeing < agreeing_debounce && !waited) return {};
    if (s.over_range) return m > held_halves ? alone(s, in) : ReadingMonitorOutput{};
    // What no gyro can turn was none of its rotation.
    return s.impossible || is_over(in, counts, m, 1.0) ? alone(s, in) : whole(s, in);
}

ReadingMonitorOutput decide_or_begin(ReadingMonitorState& s, const ReadingMonitorInput& in) noexcept {
    if (!in.follows) s.has_last = s.countable = false;
    // The first half of a loop that closes: its start was read, whatever the counter did before.
    if (!s.countable && in.countable && in.suspicious && s.has_last && !s.over_range) {
        begin(s, in);
        s.good = s.last;
    }
    ReadingMonitorOutput out;
    if (s.countable) out = decide(s, in);
    if (s.countable) return out;
    // What the counter may have lost is missing on the other side of a switch, too, and so is what it loses within one.
    const bool at_stop = s.has_last && is_at_stop(in, difference(in.reading, s.last), 1);
    if (at_stop) s.suspected = s.over_range = true;
    const bool held = s.over_range && (at_stop || s.n_since < held_halves);
    return held ? ReadingMonitorOutput{} : alone(s, in);
}

}  // namespace

void leave_to_next(ReadingMonitorState& state, const ReadingMonitorOutput& output) noexcept {
    state.good -= static_cast<std::uint64_t>(output.counts);
    state.n_since = output.span;
}

ReadingMonitorOutput step(ReadingMonitorState& state, const ReadingMonitorInput& input) noexcept {
    state.countable = state.countable && input.countable && input.mode == state.mode;
    ReadingMonitorOutput out;
    if (input.read) {
        out = decide_or_begin(state, input);
        state.last = input.reading;
    } else {
        state.n_agreeing = 0;
    }
    state.has_last = input.read;
    // Of a half that is waited for, or was missed.
    if (state.suspected || !input.read) count_up(state.n_since);
    return out;
}

}  // namespace zlg::core
