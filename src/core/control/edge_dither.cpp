#include <zlg/core/control/edge_dither.hpp>

#include <zlg/core/common/as_double.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// Uniform in [0, 1): SplitMix64, a counter with a good mixer, so that the state is one number.
double draw(const EdgeDitherConfig& c, EdgeDitherState& s) noexcept {
    std::uint64_t x = c.seed * 0xd1342543de82ef95u + ++s.draws * 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    x ^= x >> 31;
    return static_cast<double>(x >> 11) * 0x1p-53;
}

std::int32_t to_ticks(const EdgeDitherConfig& c, double cycles) noexcept {
    const double ticks = cycles * c.cycle_ticks;
    return static_cast<std::int32_t>(ticks < 0.0 ? ticks - 0.5 : ticks + 0.5);
}

constexpr double shift_of_period[4] = {0.0, 0.5, 0.5, 0.0};

DitherLaw law_of(const EdgeDitherConfig& c, const EdgeDitherState& s) noexcept {
    if (c.method == DitherMethod::automatic) return s.wanted;
    return c.method == DitherMethod::random ? DitherLaw::random : DitherLaw::paired;
}

// p_k: a new period begins. b is centred so that no edge moves by more than one cycle.
std::int32_t begin_period(const EdgeDitherConfig& c, EdgeDitherState& s) noexcept {
    s.period = (s.period + 1) & 3;
    if (s.period == 0) s.law = law_of(c, s);
    if (s.law == DitherLaw::random) {
        s.base = draw(c, s) - 0.5;
        s.swing = s.period % 2 == 0 ? draw(c, s) - 0.5 : -s.swing;
        return to_ticks(c, s.base);
    }
    if (s.period == 0) {
        s.base = draw(c, s) - 0.75;
        s.swing = draw(c, s) < 0.5 ? 0.25 : -0.25;
    } else {
        s.swing = -s.swing;
    }
    return to_ticks(c, s.base + shift_of_period[s.period]);
}

// q_k. Before the first period there is nothing to end.
std::int32_t end_positive(const EdgeDitherConfig& c, const EdgeDitherState& s) noexcept {
    if (s.period < 0) return 0;
    const double shift = s.law == DitherLaw::paired ? shift_of_period[s.period] : 0.0;
    return to_ticks(c, s.base + shift + s.swing);
}

// The net counts are those of a half of nominal length.
void count(const EdgeDitherConfig& c, EdgeDitherState& s, std::int8_t next_sign, const RateReading& in) noexcept {
    RateCounts& r = s.counted;
    ++r.n_halves;
    if (!in.counted) return;
    const std::int32_t excess_ticks = -next_sign * (s.end_ticks - s.start_ticks);
    const double net = as_double(in.counts) - in.helicity * (excess_ticks / c.cycle_ticks);
    const std::size_t beat = next_sign * in.helicity < 0;
    r.sum[beat] += net;
    ++r.n[beat];
}

// The law that the last measurement asks for.
DitherLaw wanted_law(const EdgeDitherConfig& c, const RateCounts& r, DitherLaw law) noexcept {
    if (2 * r.n[0] < c.rate_periods || 2 * r.n[1] < c.rate_periods) return law;
    const double counts_per_period = r.sum[1] / r.n[1] + r.sum[0] / r.n[0];
    const double rate_arcsec_s = size(counts_per_period * c.scale_arcsec / c.tick_s);
    if (rate_arcsec_s > c.random_above_arcsec_s) return DitherLaw::random;
    return rate_arcsec_s < c.paired_below_arcsec_s ? DitherLaw::paired : law;
}

}  // namespace

std::int32_t step(const EdgeDitherConfig& config, EdgeDitherState& state, std::int8_t next_sign,
                  const RateReading& reading) noexcept {
    if (config.method == DitherMethod::none) return 0;
    count(config, state, next_sign, reading);
    if (state.counted.n_halves >= 2 * config.rate_periods) {
        state.wanted = wanted_law(config, state.counted, state.wanted);
        state.counted = {};
    }
    // A negative half is ended by the reversal that begins a positive one.
    const std::int32_t next = next_sign < 0 ? begin_period(config, state) : end_positive(config, state);
    state.start_ticks = state.end_ticks;
    state.end_ticks = next;
    return next;
}

}  // namespace zlg::core
