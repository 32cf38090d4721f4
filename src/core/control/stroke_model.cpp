#include <zlg/core/control/stroke_model.hpp>

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

double over_u(const StrokeModelConfig& c, const StrokeModelState& s, Volts v) noexcept {
    return (clamp(c.range, v).value() - s.origin_v) / c.half_wave.value();
}

// (2) for plays i and i + 1.
[[gnu::always_inline]] inline Pair play_output(const double* position, std::size_t i, double voltage) noexcept {
    const Pair at = load(position + i);
    const Pair lowest = voltage - load(threshold.data() + i);
    const Pair highest = voltage + load(threshold.data() + i);
    return lesser(greater(at, lowest), highest);
}

double above_reference_c(const StrokeModelConfig& c, Celsius temperature) noexcept {
    return is_finite(temperature.value()) ? limited((temperature - c.reference).value(), 200.0) : 0.0;
}

// Prior variances of the weights. That of b, 0.01 wavelength, was set by hand.
StrokeWeights prior_variance(const StrokeModelConfig& c) noexcept {
    StrokeWeights v{};
    v[direct] = square(half_lambda * c.half_wave_sigma_ratio);
    v[by_temperature] = square(half_lambda * c.temperature_sigma_per_c);
    v[constant] = square(0.01);
    for (std::size_t i = 0; i < n_plays; ++i) v[first_play + i] = square(half_lambda * c.play_sigma_ratio);
    return v;
}

// Q of (3): the process noise is shared by w0 and b; k is a constant of the piezo. No variance grows beyond `most`, its
// prior.
void add_process_noise(const StrokeModelConfig& c, StrokeModelState& s, const StrokeWeights& most) noexcept {
    const double added = 0.5 * square(c.process_sigma.value());
    for (const std::size_t j : {std::size_t{direct}, std::size_t{constant}}) {
        if (s.covariance[j][j] < most[j]) s.covariance[j][j] += added;
    }
    // The plays too, a tenth as fast, so that an error of the first loops is not kept for ever.
    for (std::size_t j = first_play; j < n_stroke_weights; ++j) {
        if (s.covariance[j][j] < most[j]) s.covariance[j][j] += 0.1 * added;
    }
}

double dot(const StrokeWeights& a, const StrokeWeights& b) noexcept {
    Pair sum{};
    for (std::size_t j = 0; j + 1 < n_stroke_weights; j += 2) sum += load(a.data() + j) * load(b.data() + j);
    return sum[0] + sum[1] + a[n_stroke_weights - 1] * b[n_stroke_weights - 1];
}

// The sum of (1) over the plays, for a move that ends at this voltage.
double hysteresis_length(const StrokeModelState& s, const std::array<double, n_plays>& play, double voltage) noexcept {
    Pair length{};
    for (std::size_t i = 0; i < n_plays; i += 2) {
        const Pair moved = play_output(play.data(), i, voltage) - load(play.data() + i);
        length += load(s.weight.data() + first_play + i) * moved;
    }
    return length[0] + length[1];
}

// The slope of (4): that of a long move, in which every play follows. The slope of L is between that without plays and
// this, so each iteration multiplies the error by at most the share of the plays in it. Limited to half to twice the
// nominal 1/2.
double total_slope(const StrokeModelState& s, double direct_slope) noexcept {
    double slope = direct_slope;
    for (std::size_t i = 0; i < n_plays; ++i) slope += s.weight[first_play + i];
    return slope > 0.25 ? (slope < 1.0 ? slope : 1.0) : 0.25;
}

void reset_covariance(const StrokeModelConfig& c, StrokeModelState& s) noexcept {
    const StrokeWeights variance = prior_variance(c);
    s.covariance = {};
    for (std::size_t j = 0; j < n_stroke_weights; ++j) s.covariance[j][j] = variance[j];
}

// One row of P h.
void gain_row(StrokeModelState& s) noexcept {
    const auto row = static_cast<std::size_t>(s.n_gain++);
    s.gain[row] = dot(s.covariance[row], s.regressor);
}

// One row of P - K h^T P.
void correct_row(StrokeModelState& s) noexcept {
    const auto row = static_cast<std::size_t>(s.n_corrected++);
    const double k = s.gain[row] / s.spread;
    for (std::size_t j = 0; j < n_stroke_weights; ++j) s.covariance[row][j] -= k * s.gain[j];
}

// One row of pending work, in the order in which the results are needed; false: there is none.
bool work(StrokeModelState& s) noexcept {
    constexpr auto rows = static_cast<std::int8_t>(n_stroke_weights);
    if (s.n_corrected < rows) {
        correct_row(s);
    } else if (s.pending && s.n_gain < rows) {
        gain_row(s);
    } else {
        return false;
    }
    return true;
}

void finish(StrokeModelState& s) noexcept {
    while (work(s)) {
    }
}

// P restarts from its prior, and the gain of this measurement with it.
void restart(const StrokeModelConfig& c, StrokeModelState& s) noexcept {
    reset_covariance(c, s);
    for (std::size_t i = 0; i < n_stroke_weights; ++i) s.gain[i] = s.covariance[i][i] * s.regressor[i];
    s.spread = dot(s.regressor, s.gain) + square(s.length_sigma_lambda);
}

}  // namespace

StrokeModelState initial_state(const StrokeModelConfig& config, Volts start) noexcept {
    StrokeModelState s;
    s.origin_v = clamp(config.range, start).value();
    s.weight[direct] = half_lambda;
    reset_covariance(config, s);
    return s;
}

void follow(const StrokeModelConfig& config, StrokeModelState& state, Volts piezo) noexcept {
    (void)work(state);
    if (!plausible(config.range, piezo)) return;
    const double v = over_u(config, state, piezo);
    for (std::size_t i = 0; i < n_plays; i += 2) store(state.play.data() + i, play_output(state.play.data(), i, v));
}

Volts predicted_move(const StrokeModelConfig& config, const StrokeModelState& state, std::int8_t sign, Volts from,
                     Celsius temperature) noexcept {
    return predicted_move(config, state, state.play, sign, from, temperature);
}

Volts predicted_move(const StrokeModelConfig& config, const StrokeModelState& state,
                     const std::array<double, n_plays>& play, std::int8_t sign, Volts from,
                     Celsius temperature) noexcept {
    const double v0 = over_u(config, state, from);
    const double slope = state.weight[direct] + state.weight[by_temperature] * above_reference_c(config, temperature);
    const double steepness = total_slope(state, slope);
    double move = sign;
    for (int round = 0; round < 4; ++round) {
        const double length = state.weight[constant] + slope * move + hysteresis_length(state, play, v0 + move);
        move += (sign * half_lambda - length) / steepness;
        const double size_of = limited(sign * move, 2.0);
        move = sign * (size_of > 0.5 ? size_of : 0.5);
    }
    return move * config.half_wave;
}

void begin_move(const StrokeModelConfig& config, StrokeModelState& state, Volts from) noexcept {
    finish(state);
    state.start = over_u(config, state, from);
    state.start_play = state.play;
    state.pending = false;
}

void arrive(const StrokeModelConfig& config, StrokeModelState& state, const StrokeArrival& arrival) noexcept {
    const double miss = arrival.detuning.value();
    finish(state);
    state.pending = plausible(config.range, arrival.piezo) && limited(miss, half_lambda) == miss;
    if (!state.pending) return;
    const double move = over_u(config, state, arrival.piezo) - state.start;
    state.regressor[direct] = move;
    state.regressor[by_temperature] = move * above_reference_c(config, arrival.temperature);
    state.regressor[constant] = 1.0;
    for (std::size_t i = 0; i < n_plays; ++i) {
        state.regressor[first_play + i] = state.play[i] - state.start_play[i];
    }
    state.length_lambda = arrival.sign * half_lambda + miss;
    const double sigma_sq = square(config.measurement_sigma.value()) + square(0.1 * miss);
    state.length_sigma_lambda = square_root(sigma_sq);
    add_process_noise(config, state, prior_variance(config));
    state.n_gain = 0;
}

bool confirm(const StrokeModelConfig& config, StrokeModelState& state, bool neighbour) noexcept {
    if (state.pending) finish(state);
    const bool measured = state.pending && neighbour;
    state.pending = false;
    if (!measured) return true;
    const double known = dot(state.regressor, state.gain);
    state.spread = known + square(state.length_sigma_lambda);
    const double innovation = state.length_lambda - dot(state.regressor, state.weight);
    const std::int8_t side = innovation * state.length_lambda > 0.0 ? 1 : -1;
    const bool inside = square(innovation) <= square(config.gate) * state.spread;
    if (!inside && state.outlier_side != side) {
        state.outlier_side = side;
        return false;
    }
    // The covariance no longer holds: a second outlier, or h^T P h < 0 by rounding.
    if (!inside || !(known >= 0.0)) restart(config, state);
    state.outlier_side = 0;
    for (std::size_t i = 0; i < n_stroke_weights; ++i) state.weight[i] += state.gain[i] / state.spread * innovation;
    state.n_corrected = 0;
    count_up(state.n_learnt);
    return true;
}

}  // namespace zlg::core
