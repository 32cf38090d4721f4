#include <zlg/core/half_wave.hpp>

namespace zlg::core {
namespace {

double grown_variance_v2(const HalfWaveConfig& c, double variance_v2) noexcept {
    const double process_v2 = c.process_sigma.value() * c.process_sigma.value();
    const double ceiling_v2 = initial_state(c).variance_v2;
    const double grown_v2 = variance_v2 + process_v2;
    return grown_v2 < ceiling_v2 ? grown_v2 : ceiling_v2;
}

}  // namespace

HalfWaveOutput step(const HalfWaveConfig& config, HalfWaveState& state, Volts measured) noexcept {
    const double prior_v2 = grown_variance_v2(config, state.variance_v2);
    const double spread_v2 = prior_v2 + config.measurement_sigma.value() * config.measurement_sigma.value();
    const double innovation_v = measured.value() - state.estimate_v;

    const bool near_presumed = measured >= 0.5 * config.presumed && measured <= 2.0 * config.presumed;
    const bool inside_gate = innovation_v * innovation_v <= config.gate * config.gate * spread_v2;
    if (!(near_presumed && inside_gate)) {
        state.variance_v2 = prior_v2;
        return {.half_wave = Volts{state.estimate_v}, .rejected = true};
    }
    const double gain = prior_v2 / spread_v2;
    state.estimate_v += gain * innovation_v;
    state.variance_v2 = (1.0 - gain) * prior_v2;
    if (state.n_accepted < INT32_MAX) ++state.n_accepted;
    return {.half_wave = Volts{state.estimate_v}};
}

SwitchDirection choose_direction(const PiezoRange& range, Volts now, Volts half_wave) noexcept {
    const double room_up_v = range.max.value() - (now.value() + half_wave.value());
    const double room_down_v = now.value() - half_wave.value() - range.min.value();
    // With more room up than down the upper neighbour is also the one nearer to the middle.
    const bool up = room_up_v >= room_down_v;
    const double room_v = up ? room_up_v : room_down_v;
    return {.sign = static_cast<std::int8_t>(up ? 1 : -1), .out_of_range = !(room_v >= range.margin.value())};
}

}  // namespace zlg::core
