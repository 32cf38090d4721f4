#include <zlg/core/control/half_wave.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

double grown_variance_v2(const HalfWaveConfig& c, double variance_v2) noexcept {
    const double process_v2 = c.process_sigma.value() * c.process_sigma.value();
    const double ceiling_v2 = initial_state(c).variance_v2;
    const double grown_v2 = variance_v2 + process_v2;
    return grown_v2 < ceiling_v2 ? grown_v2 : ceiling_v2;
}

// Measurement update, its prior variance given.
void update(const HalfWaveConfig& c, HalfWaveState& s, double innovation_v, double prior_v2) noexcept {
    const double gain = prior_v2 / (prior_v2 + c.measurement_sigma.value() * c.measurement_sigma.value());
    s.estimate_v += gain * innovation_v;
    s.variance_v2 = (1.0 - gain) * prior_v2;
    s.outlier_side = 0;
    count_up(s.n_accepted);
}

}  // namespace

HalfWaveOutput step(const HalfWaveConfig& config, HalfWaveState& state, Volts measured) noexcept {
    const double prior_v2 = grown_variance_v2(config, state.variance_v2);
    const double spread_v2 = prior_v2 + config.measurement_sigma.value() * config.measurement_sigma.value();
    const double innovation_v = measured.value() - state.estimate_v;
    const double innovation_v2 = innovation_v * innovation_v;

    const bool near_presumed = measured >= 0.5 * config.presumed && measured <= 2.0 * config.presumed;
    const bool inside_gate = innovation_v2 <= config.gate * config.gate * spread_v2;
    const std::int8_t side = innovation_v > 0.0 ? 1 : -1;
    if (near_presumed && inside_gate) {
        update(config, state, innovation_v, prior_v2);
    } else if (near_presumed && state.outlier_side == side) {
        update(config, state, innovation_v, innovation_v2);
    } else {
        state.variance_v2 = prior_v2;
        if (near_presumed) state.outlier_side = side;
        return {.half_wave = Volts{state.estimate_v}, .rejected = true};
    }
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
