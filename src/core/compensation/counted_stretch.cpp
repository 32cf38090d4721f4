#include <zlg/core/compensation/counted_stretch.hpp>

#include <zlg/core/common/as_double.hpp>
#include <zlg/core/common/maths.hpp>
#include <zlg/core/compensation/switch_light.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// Beyond this a sum of counts is not exact as a double.
constexpr std::int64_t max_counts = std::int64_t{1} << 52;

void see_detuning(CountedStretchState& s, double sq_lambda2) noexcept {
    if (!(sq_lambda2 > 0.0 && is_finite(sq_lambda2))) return;
    if (s.min_sq_lambda2 == 0.0 || sq_lambda2 < s.min_sq_lambda2) s.min_sq_lambda2 = sq_lambda2;
    if (sq_lambda2 > s.max_sq_lambda2) s.max_sq_lambda2 = sq_lambda2;
}

void add_half(const CompensationConstants& gyro, CountedStretchState& s, const HalfRecord& half) noexcept {
    see_detuning(s, detuning_sq(gyro, half));
    const RecordedSquare recorded = recorded_square(gyro, half);
    if (!recorded.known) s.seen = false;
    s.deficit_lambda2 += half.bias_sign * half.mode * recorded.mean_sq_lambda2;
    s.deficit_variance_lambda4 += recorded.variance_lambda4;
    if (!half.loop_closed) s.known_before = false;
    if (!half.loop_closed || half.mode != s.mode) s.broken = true;
    if (!half.valid) return count_up(s.uncovered);
    if (half.span - 1 != s.uncovered) s.broken = true;
    s.uncovered = 0;
    // Unsigned, so that even wild counts wrap instead of being undefined.
    s.counts =
        static_cast<std::int64_t>(static_cast<std::uint64_t>(s.counts) + static_cast<std::uint64_t>(half.counts));
    if (s.counts > max_counts || s.counts < -max_counts) s.broken = true;
}

void begin(CountedStretchState& s, std::int8_t mode, const EdgeShiftState& edges, const Border& border) noexcept {
    s.start_border = border;
    s.broken = false;
    s.seen = true;
    s.deficit_lambda2 = s.deficit_variance_lambda4 = 0.0;
    s.mode = mode;
    s.counts = s.area_ticks = 0;
    s.start = edges;
}

// Without shifts exactly K c.
double angle(const CompensationConstants& gyro, const CountedStretchState& s, Hertz bias, const HalfRecord& last,
             EdgeShiftState& edges) noexcept {
    const double counts = counts_and_parts(s.counts, parts_between(s.start_border, border_of(last)));
    const double area = plateau_per_tick(gyro, bias) * as_double(s.area_ticks);
    edges = s.start;
    return even_angle(gyro, edges, counts, area, last.edge_offset_ticks, as_double(s.n_ticks));
}

}  // namespace

double detuning_sq(const CompensationConstants& gyro, const HalfRecord& half) noexcept {
    return half.detuning_sq_lambda2 > 0.0 ? about(gyro.centre, moments_of(gyro, half)) : 0.0;
}

CountedStretch step(const CompensationConstants& gyro, CountedStretchState& state, const HalfRecord& first,
                    const HalfRecord& second, Hertz bias, const EdgeShiftState& edges_before, EdgeShiftState& edges,
                    const Border& start_border) noexcept {
    if (state.n_ticks == 0) begin(state, first.mode, edges_before, start_border);
    ++state.n_ticks;
    add_half(gyro, state, first);
    add_half(gyro, state, second);
    const std::int64_t middle = first.edge_offset_ticks;
    state.area_ticks += first.bias_sign * first.mode * (middle - edges_before.offset_ticks);
    state.area_ticks += second.bias_sign * second.mode * (second.edge_offset_ticks - middle);
    if (state.uncovered > 0) return {};
    CountedStretch out;
    // Without either nothing bounds the false drift.
    if (!state.broken && (state.known_before || state.seen))
        out = {state.n_ticks, angle(gyro, state, bias, second, edges),
               most_loss(gyro.bend, state.max_sq_lambda2) - most_loss(gyro.bend, state.min_sq_lambda2)};
    state.n_ticks = 0;
    const double last_sq_lambda2 = detuning_sq(gyro, second);
    if (last_sq_lambda2 > 0.0 && is_finite(last_sq_lambda2))
        state.min_sq_lambda2 = state.max_sq_lambda2 = last_sq_lambda2;
    return out;
}

void begin_anew(CountedStretchState& state, double detuning_sq_lambda2) noexcept {
    state.n_ticks = 0;
    state.uncovered = 0;
    state.known_before = true;
    const bool is_known = detuning_sq_lambda2 > 0.0 && is_finite(detuning_sq_lambda2);
    state.min_sq_lambda2 = state.max_sq_lambda2 = is_known ? detuning_sq_lambda2 : 0.0;
}

}  // namespace zlg::core
