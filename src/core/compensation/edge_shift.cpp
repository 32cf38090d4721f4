#include <zlg/core/compensation/edge_shift.hpp>

#include <zlg/core/common/maths.hpp>

namespace zlg::core {
namespace {

// A temperature that is damage would make this of the bias, and the area overflow.
constexpr double max_plateau_hz = 1e15;

double believed_plateau_hz(const EdgeShiftConfig& config, Hertz bias) noexcept {
    const double plateau_hz = config.plateau_ratio * bias.value();
    return plateau_hz < max_plateau_hz && plateau_hz > -max_plateau_hz ? plateau_hz : 0.0;
}

void follow(EdgeShiftState& state, double turn_counts, double beyond_arcsec) noexcept {
    state.follows = true;
    state.turn_counts = turn_counts;
    state.beyond_arcsec = beyond_arcsec;
}

// One double for the sum of all; what it lacks is left for the next.
double sum(ExactSum& left, double counted, double area, double given, double beyond) noexcept {
    left.add(area);
    left.add(given);
    left.add(beyond);
    const double whole = counted + left.value();
    left.add(counted);
    left.add(-whole);
    if (is_finite(whole)) return whole;
    left = {};
    return counted;
}

}  // namespace

EdgeShiftFault check(const EdgeShiftConfig& c) noexcept {
    if (!(c.timer.value() >= 1.0 && c.timer.value() <= 1e15)) return EdgeShiftFault::timer;
    if (!(c.plateau_ratio >= 1.0 && c.plateau_ratio <= 2.0)) return EdgeShiftFault::plateau_ratio;
    if (!(c.tick.value() > 0.0 && is_finite(c.tick.value()))) return EdgeShiftFault::tick;
    if (!(c.scale.value() > 0.0 && is_finite(c.scale.value()))) return EdgeShiftFault::scale;
    return EdgeShiftFault::none;
}

bool is_possible(const EdgeShiftConfig& config, std::int32_t edge_offset_ticks) noexcept {
    const auto offset = static_cast<double>(edge_offset_ticks);
    const double limit = 0.25 * config.tick.value() * config.timer.value();
    return offset == 0.0 || (offset < limit && offset > -limit);
}

double plateau_per_tick(const EdgeShiftConfig& config, Hertz bias) noexcept {
    return believed_plateau_hz(config, bias) / config.timer.value();
}

EdgeShiftOutput step(const EdgeShiftConfig& config, EdgeShiftState& state, const EdgeShiftInput& input) noexcept {
    const auto counts = as_double(input.counts);
    const double counted_arcsec = config.scale.value() * counts;
    const std::int64_t start = state.offset_ticks, middle = input.offset_middle_ticks, end = input.offset_end_ticks;
    state.offset_ticks = input.offset_end_ticks;
    if (start == 0 && middle == 0 && end == 0) {
        follow(state, counts, 0.0);
        return {.value_arcsec = counted_arcsec};
    }
    const std::int64_t first = middle - start;
    const std::int64_t second = end - middle;
    const double per_tick = plateau_per_tick(config, input.bias);
    const double area = per_tick * static_cast<double>(input.sign_first * first + input.sign_second * second);

    // Of a tick: a time of so many ticks of the timer.
    const auto part = [&](std::int64_t t) {
        return static_cast<double>(t) / (config.tick.value() * config.timer.value());
    };
    const double turn = (counts - area) / (1.0 + part(end - start));
    const double turn_at_end = state.follows ? turn + 0.5 * (turn - state.turn_counts) : turn;
    const double beyond_arcsec = config.scale.value() * turn_at_end * part(end);
    const double given_arcsec = state.follows ? state.beyond_arcsec : config.scale.value() * turn * part(start);

    EdgeShiftOutput out;
    out.value_arcsec =
        sum(state.left_arcsec, counted_arcsec, -config.scale.value() * area, given_arcsec, -beyond_arcsec);
    out.known_excess_counts = per_tick * static_cast<double>(input.sign_first * first - input.sign_second * second) +
                              turn * part(first - second);
    follow(state, turn, beyond_arcsec);
    return out;
}

void break_off(EdgeShiftState& state) noexcept { state = {.offset_ticks = state.offset_ticks}; }

}  // namespace zlg::core
