#include <zlg/core/control/half_wave.hpp>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"
#include "common/pair.hpp"

namespace zlg::core {
namespace {

// r_i. A switch turns by one U, so a play of more than U/2 never moves in steady operation: the last one is for
// voltages that were not reached before. Six thresholds, spaced by hand about logarithmically.
constexpr std::array<double, n_plays> threshold{0.02, 0.05, 0.1, 0.2, 0.35, 0.6};

enum Place : std::size_t { direct, by_temperature, constant, first_play };

constexpr double half_lambda = 0.5;

double over_u(const HalfWaveConfig& c, const HalfWaveState& s, Volts v) noexcept {
    return (clamp(c.range, v).value() - s.origin_v) / c.half_wave.value();
}

// (2) for plays i and i + 1.
[[gnu::always_inline]] inline Pair play_output(const double* position, std::size_t i, double voltage) noexcept {
    const Pair at = load(position + i);
    const Pair lowest = voltage - load(threshold.data() + i);
    const Pair highest = voltage + load(threshold.data() + i);
    return lesser(greater(at, lowest), highest);
}

double above_reference_c(const HalfWaveConfig& c, Celsius temperature) noexcept {
    return is_finite(temperature.value()) ? limited((temperature - c.reference).value(), 200.0) : 0.0;
}

// Prior variances of the weights: w0 is known to a tenth, and each play's share of it; k to 0.002/C. That of b, 0.01
// wavelength, was set by hand.
constexpr double a_tenth = square(half_lambda * 0.1);
constexpr StrokeWeights prior_variance{
    a_tenth, square(half_lambda * 0.002), square(0.01), a_tenth, a_tenth, a_tenth, a_tenth, a_tenth, a_tenth};

// Of one length, and its true change from one switch to the next; a length farther off than the gate is an outlier.
constexpr double measurement_sigma_lambda = 0.001;
constexpr double process_sigma_lambda = 0.001;
constexpr double gate_deviations = 5.0;

// Q of (3): the process noise is shared by w0 and b; k is a constant of the piezo. The plays have a tenth of it, so
// that an error of the first loops is not kept for ever. No variance grows beyond its prior.
void add_process_noise(HalfWaveState& s) noexcept {
    constexpr double added = 0.5 * square(process_sigma_lambda);
    for (std::size_t j = 0; j < n_stroke_weights; ++j) {
        if (j == by_temperature || !(s.covariance[j][j] < prior_variance[j])) continue;
        s.covariance[j][j] += j < first_play ? added : 0.1 * added;
    }
}

double dot(const StrokeWeights& a, const StrokeWeights& b) noexcept {
    Pair sum{};
    for (std::size_t j = 0; j + 1 < n_stroke_weights; j += 2) sum += load(a.data() + j) * load(b.data() + j);
    return sum[0] + sum[1] + a[n_stroke_weights - 1] * b[n_stroke_weights - 1];
}

// The sum of (1) over the plays, for a move that ends at this voltage.
double hysteresis_length(const HalfWaveState& s, double voltage) noexcept {
    Pair length{};
    for (std::size_t i = 0; i < n_plays; i += 2) {
        const Pair moved = play_output(s.play.data(), i, voltage) - load(s.play.data() + i);
        length += load(s.weight.data() + first_play + i) * moved;
    }
    return length[0] + length[1];
}

// The slope of (4): that of a long move, in which every play follows. The slope of L is between that without plays and
// this, so each iteration multiplies the error by at most the share of the plays in it. Limited to half to twice the
// nominal 1/2.
double total_slope(const HalfWaveState& s, double direct_slope) noexcept {
    double slope = direct_slope;
    for (std::size_t i = 0; i < n_plays; ++i) slope += s.weight[first_play + i];
    return slope > 0.25 ? (slope < 1.0 ? slope : 1.0) : 0.25;
}

void reset_covariance(HalfWaveState& s) noexcept {
    s.covariance = {};
    for (std::size_t j = 0; j < n_stroke_weights; ++j) s.covariance[j][j] = prior_variance[j];
}

StrokeWeights gain_of(const HalfWaveState& s) noexcept {
    StrokeWeights gain;
    for (std::size_t j = 0; j < n_stroke_weights; ++j) gain[j] = dot(s.covariance[j], s.regressor);
    return gain;
}

}  // namespace

HalfWaveState initial_state(const HalfWaveConfig& config, Volts start) noexcept {
    HalfWaveState s;
    s.origin_v = clamp(config.range, start).value();
    s.weight[direct] = half_lambda;
    reset_covariance(s);
    s.length_variance_lambda2 = prior_variance[direct];
    return s;
}

void follow(const HalfWaveConfig& config, HalfWaveState& state, Volts piezo) noexcept {
    if (!plausible(config.range, piezo)) return;
    const double v = over_u(config, state, piezo);
    for (std::size_t i = 0; i < n_plays; i += 2) store(state.play.data() + i, play_output(state.play.data(), i, v));
}

Volts predicted_move(const HalfWaveConfig& config, const HalfWaveState& state, std::int8_t sign, Volts from,
                     Celsius temperature) noexcept {
    const double v0 = over_u(config, state, from);
    const double slope = state.weight[direct] + state.weight[by_temperature] * above_reference_c(config, temperature);
    const double steepness = total_slope(state, slope);
    double move = sign;
    for (int round = 0; round < 4; ++round) {
        const double length = state.weight[constant] + slope * move + hysteresis_length(state, v0 + move);
        move += (sign * half_lambda - length) / steepness;
        const double size_of = limited(sign * move, 2.0);
        move = sign * (size_of > 0.5 ? size_of : 0.5);
    }
    return move * config.half_wave;
}

void begin_move(const HalfWaveConfig& config, HalfWaveState& state, Volts from) noexcept {
    state.start = over_u(config, state, from);
    state.start_play = state.play;
    state.pending = false;
}

void arrive(const HalfWaveConfig& config, HalfWaveState& state, std::int8_t sign, Volts piezo, Wavelengths detuning,
            Celsius temperature) noexcept {
    const double miss = detuning.value();
    state.pending = plausible(config.range, piezo) && limited(miss, half_lambda) == miss;
    if (!state.pending) return;
    const double move = over_u(config, state, piezo) - state.start;
    state.regressor[direct] = move;
    state.regressor[by_temperature] = move * above_reference_c(config, temperature);
    state.regressor[constant] = 1.0;
    for (std::size_t i = 0; i < n_plays; ++i) {
        state.regressor[first_play + i] = state.play[i] - state.start_play[i];
    }
    state.length_lambda = sign * half_lambda + miss;
    state.length_sigma_lambda = square_root(square(measurement_sigma_lambda) + square(0.1 * miss));
    add_process_noise(state);
}

bool confirm(HalfWaveState& state, bool neighbour) noexcept {
    const bool measured = state.pending && neighbour;
    state.pending = false;
    if (!measured) return true;
    const double variance = square(state.length_sigma_lambda);
    StrokeWeights gain = gain_of(state);
    double known = dot(state.regressor, gain);
    const double innovation = state.length_lambda - dot(state.regressor, state.weight);
    const std::int8_t side = innovation * state.length_lambda > 0.0 ? 1 : -1;
    const bool inside = square(innovation) <= square(gate_deviations) * (known + variance);
    if (!inside && state.outlier_side != side) {
        state.outlier_side = side;
        return false;
    }
    // The covariance no longer holds: a second outlier, or h^T P h < 0 by rounding. It restarts from its prior.
    if (!inside || !(known >= 0.0)) {
        reset_covariance(state);
        gain = gain_of(state);
        known = dot(state.regressor, gain);
    }
    state.outlier_side = 0;
    state.length_variance_lambda2 = known * variance / (known + variance);
    for (std::size_t i = 0; i < n_stroke_weights; ++i) {
        const double k = gain[i] / (known + variance);
        state.weight[i] += k * innovation;
        for (std::size_t j = 0; j < n_stroke_weights; ++j) state.covariance[i][j] -= k * gain[j];
    }
    return true;
}

}  // namespace zlg::core
