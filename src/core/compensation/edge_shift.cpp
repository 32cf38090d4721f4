#include <zlg/core/compensation/edge_shift.hpp>

#include <zlg/core/common/maths.hpp>
#include <zlg/core/compensation/border.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// A temperature that is damage would make this of the bias, and the area overflow.
constexpr double max_plateau_hz = 1e15;

void follow(EdgeShiftState& state, double turn_counts, double beyond_arcsec) noexcept {
    state.follows = true;
    state.turn_counts = turn_counts;
    state.beyond_arcsec = beyond_arcsec;
}

// The sum as one double; its rounding residual is kept for the next tick.
double sum(ExactSum& residual, double counted, double area, double given, double beyond) noexcept {
    residual.add(area);
    residual.add(given);
    residual.add(beyond);
    const double whole = counted + residual.value();
    residual.add(counted);
    residual.add(-whole);
    if (is_finite(whole)) return whole;
    residual = {};
    return counted;
}

}  // namespace

bool is_possible(const CompensationConstants& gyro, std::int32_t edge_offset_ticks) noexcept {
    const auto offset = static_cast<double>(edge_offset_ticks);
    const double limit = 0.25 * gyro.tick.value() * gyro.timer.value();
    return offset == 0.0 || (offset < limit && offset > -limit);
}

double plateau_per_tick(const CompensationConstants& gyro, Hertz bias) noexcept {
    const double plateau_hz = gyro.plateau_ratio * bias.value();
    return is_within(plateau_hz, -max_plateau_hz, max_plateau_hz) ? plateau_hz / gyro.timer.value() : 0.0;
}

double even_angle(const CompensationConstants& gyro, EdgeShiftState& state, double counts, double area,
                  std::int32_t end_ticks, double n_ticks) noexcept {
    const double scale = gyro.scale.value();
    // Of a tick: a time of so many ticks of the timer.
    const double timer_ticks = gyro.tick.value() * gyro.timer.value();
    const double start = state.offset_ticks / timer_ticks, end = end_ticks / timer_ticks;
    const double turn = (counts - area) / (n_ticks + (end - start));
    const double turn_at_end = state.follows ? turn + n_ticks / (n_ticks + 1.0) * (turn - state.turn_counts) : turn;
    const double beyond_arcsec = scale * turn_at_end * end;
    const double given_arcsec = state.follows ? state.beyond_arcsec : scale * turn * start;
    state.offset_ticks = end_ticks;
    follow(state, turn, beyond_arcsec);
    return sum(state.residual_arcsec, scale * counts, -scale * area, given_arcsec, -beyond_arcsec);
}

EdgeShiftOutput step(const CompensationConstants& gyro, EdgeShiftState& state, const HalfRecord& first,
                     const HalfRecord& second, std::int32_t parts) noexcept {
    const double counts = counts_and_parts(first.counts + second.counts, parts);
    const std::int64_t start = state.offset_ticks, middle = first.edge_offset_ticks, end = second.edge_offset_ticks;
    if (start == 0 && middle == 0 && end == 0) {
        follow(state, counts, 0.0);
        return {.value_arcsec = gyro.scale.value() * counts};
    }
    // With the signs of the bias: by so many ticks of the timer either half is longer.
    const std::int64_t one = first.bias_sign * first.mode * (middle - start);
    const std::int64_t other = second.bias_sign * second.mode * (end - middle);
    const double per_tick = plateau_per_tick(gyro, bias_at(gyro, Celsius{first.temperature_c}));
    const double area = per_tick * static_cast<double>(one + other);
    EdgeShiftOutput out{.value_arcsec = even_angle(gyro, state, counts, area, second.edge_offset_ticks, 1.0)};
    out.known_excess_counts =
        per_tick * static_cast<double>(one - other) +
        state.turn_counts * (static_cast<double>(2 * middle - start - end) / (gyro.tick.value() * gyro.timer.value()));
    return out;
}

void break_off(EdgeShiftState& state) noexcept { state = {.offset_ticks = state.offset_ticks}; }

}  // namespace zlg::core
