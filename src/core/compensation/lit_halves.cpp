#include <zlg/core/compensation/lit_halves.hpp>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"
#include "compensation/relock/relock_light.hpp"

namespace zlg::core {
namespace {

// (2). The first is that of a laser, whose chi at 0.22 wavelength is 1.4 % less than at the centre.
constexpr double law_error_ratio = 0.015;
constexpr double reading_error_lambda = 0.002;

// Square of the number of standard deviations beyond which a second difference is not that of the motion, and the part of
// the bias in a half below which nothing is called inconsistent: a first manoeuvre must not look so.
constexpr double limit_sq = 25.0;
constexpr double tolerated_bias_ratio = 0.02;

// The same beyond which what a difference is larger counts as a rotation that no point of the gap has seen whole.
constexpr double turn_sq = 9.0;

struct Reading {
    bool known = false;
    LitHalf half{};
};

Reading reading(const CompensationConstants& gyro, const LitTick& t, const HalfRecord& half, const Border& from,
                const Border& to) noexcept {
    const RecordedSquare recorded = recorded_square(gyro, half);
    Reading out;
    if (!recorded.known) return out;
    const int sign = half.bias_sign * half.mode;
    const double unit =
        gyro.chi * bias_at(gyro, Celsius{half.temperature_c}).value() * gyro.scale.value() * 0.5 * gyro.tick.value();
    const double d = unit * (recorded.mean_sq_lambda2 > 0.0 ? recorded.mean_sq_lambda2 : 0.0);
    const double common = square_root(square(law_error_ratio * d) + 4.0 * square(reading_error_lambda) * unit * d);
    out.half.value_arcsec =
        gyro.scale.value() * counts_and_parts(half.counts, parts_between(from, to)) - sign * t.bias_arcsec;
    out.half.correction_arcsec = sign * unit * recorded.mean_sq_lambda2;
    out.half.variance_arcsec2 = square(unit) * recorded.variance_lambda4;
    out.half.common_arcsec = sign * common;
    out.known = is_finite(out.half.value_arcsec + out.half.correction_arcsec) &&
                is_finite(out.half.variance_arcsec2 + square(common));
    return out;
}

double corrected(const LitHalf& half) noexcept { return half.value_arcsec + half.correction_arcsec; }

void remember(LitHalvesState& s, double off_arcsec2) noexcept {
    if (off_arcsec2 > s.turned_arcsec2) s.turned_arcsec2 = off_arcsec2;
}

// Whether three halves in a row go together. The outer ones have the same sign of the bias: their difference, to which the
// common error adds hardly anything, shows a rotation that is much less than what refuses a half.
bool fit(LitHalvesState& s, const LitTick& t, const LitHalf& a, const LitHalf& b, const LitHalf& c,
         double motion_arcsec2) noexcept {
    const double of_outer = a.variance_arcsec2 + c.variance_arcsec2;
    const double outer = square(corrected(a) - corrected(c));
    remember(s, outer - turn_sq * (t.difference_arcsec2 + of_outer + square(a.common_arcsec - c.common_arcsec)));
    const double difference = corrected(a) - 2.0 * corrected(b) + corrected(c);
    const double common = a.common_arcsec - 2.0 * b.common_arcsec + c.common_arcsec;
    const double variance = motion_arcsec2 + square(common) + of_outer + 4.0 * b.variance_arcsec2;
    const double limit = limit_sq * variance + square(tolerated_bias_ratio * t.bias_arcsec);
    if (square(difference) <= limit) return true;
    remember(s, square(difference));
    return false;
}

void keep_last(LitHalvesState& s, int n) noexcept {
    for (int k = 0; k < n; ++k) s.half[static_cast<unsigned>(k)] = s.half[static_cast<unsigned>(s.n - n + k)];
    if (n < s.n) s.first_is_whole = false;
    s.n = n;
}

bool is_usable(const LitHalvesState& s, const LitTick& t, const HalfRecord& half, const Border& from,
               const Border& to) noexcept {
    if (!(half.lit && !half.loop_closed && half.valid && half.span == 1)) return false;
    if (!s.starts_even || half.edge_offset_ticks != 0 || t.bias_arcsec == 0.0) return false;
    return !t.with_phase || ((from.is_known() || s.n == 0) && to.is_known());
}

void add(const CompensationConstants& gyro, LitHalvesState& s, const LitTick& t, const HalfRecord& half,
         const Border& from, const Border& to, double motion_arcsec2) noexcept {
    const bool usable = is_usable(s, t, half, from, to);
    s.starts_even = half.edge_offset_ticks == 0;
    const Reading read = usable ? reading(gyro, t, half, from, to) : Reading{};
    // A longer row belongs to a gap that is not estimated from half-ticks.
    if (!read.known || s.n == max_lit_halves || half.mode != s.mode) {
        s.n = 0;
        s.turned_arcsec2 = 0.0;
    }
    s.mode = half.mode;
    if (!read.known) return;
    // By phase a half that comes out of the dark is read to a count: no point, but it tells whether something turned.
    if (s.n == 0) s.first_is_whole = t.with_phase && !from.is_known();
    const auto n = static_cast<unsigned>(s.n);
    if (n >= 2 && !fit(s, t, s.half[n - 2], s.half[n - 1], read.half, motion_arcsec2)) keep_last(s, 1);
    s.half[static_cast<unsigned>(s.n)] = read.half;
    if (s.first_is_whole && s.n == 0) s.half[0].variance_arcsec2 += rounding_arcsec2(gyro);
    ++s.n;
}

}  // namespace

double second_difference_arcsec2(const MotionCovariance& covariance) noexcept {
    const auto c = [&](int a, int b) { return covariance.of_samples(a, b); };
    return c(0, 0) + 4.0 * c(1, 1) + c(2, 2) - 4.0 * (c(0, 1) + c(1, 2)) + 2.0 * c(0, 2);
}

void add_gap_tick(const CompensationConstants& gyro, LitHalvesState& state, const LitTick& tick, bool begins,
                  double motion_arcsec2) noexcept {
    if (begins) {
        state.n = 0;
        state.turned_arcsec2 = 0.0;
        state.starts_even = false;
    }
    const Border middle = border_of(tick.first);
    add(gyro, state, tick, tick.first, tick.start, middle, motion_arcsec2);
    add(gyro, state, tick, tick.second, middle, border_of(tick.second), motion_arcsec2);
    state.end_tick = tick.tick + 1;
}

void end_gap(const CompensationConstants& gyro, LitHalvesState& state, const LitTick& tick, double motion_arcsec2,
             double drift_arcsec) noexcept {
    if (tick.first.mode != state.mode || !state.starts_even) state.n = 0;
    if (state.n == 0) return;
    const Border middle = border_of(tick.first);
    const Reading first = reading(gyro, tick, tick.first, tick.start, middle);
    const Reading second = reading(gyro, tick, tick.second, middle, border_of(tick.second));
    const auto ends_well = [&](const LitHalf& a, const LitHalf& b, const LitHalf& c) {
        return fit(state, tick, a, b, c, motion_arcsec2);
    };
    const auto n = static_cast<unsigned>(state.n);
    if (first.known && n >= 2 && !ends_well(state.half[n - 2], state.half[n - 1], first.half)) keep_last(state, 1);
    if (first.known && second.known &&
        !ends_well(state.half[static_cast<unsigned>(state.n - 1)], first.half, second.half))
        state.n = 0;
    if (state.n > 0 && state.first_is_whole) keep_last(state, state.n - 1);
    for (int k = 0; k < state.n; ++k) state.half[static_cast<unsigned>(k)].value_arcsec -= 0.5 * drift_arcsec;
}

}  // namespace zlg::core
