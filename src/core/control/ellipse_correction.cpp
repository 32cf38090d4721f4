#include <zlg/core/control/ellipse_correction.hpp>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// Of the memory, at each new block. The weights 1, 3/4, 9/16 .. average the noise as seven whole blocks do, 896
// samples: the errors of the map put sqrt(6/896) = 1/12 of the phase noise of one sample into the phase.
constexpr double kept = 0.75;

// What is learnt within three minutes belongs together.
constexpr std::int32_t max_block_halves = 1 << 16;

constexpr double max_offset = 0.5;
constexpr double max_axis = 2.0;

constexpr unsigned n_terms = 5;

// Powers of c and s in the terms of (2).
constexpr std::array<unsigned, n_terms> power_c{2, 1, 0, 1, 0};
constexpr std::array<unsigned, n_terms> power_s{0, 1, 2, 0, 1};

constexpr unsigned place_of(unsigned c, unsigned s) noexcept { return (c + s) * (c + s + 1) / 2 + s; }

void add(PowerSums& sums, const QuadratureSample& x) noexcept {
    std::array<double, 5> c{1.0};
    std::array<double, 5> s{1.0};
    for (unsigned k = 1; k < 5; ++k) {
        c[k] = c[k - 1] * x.c;
        s[k] = s[k - 1] * x.s;
    }
    for (unsigned degree = 0; degree < 5; ++degree)
        for (unsigned k = 0; k <= degree; ++k) sums[place_of(degree - k, k)] += c[degree - k] * s[k];
}

int octant(const QuadratureSample& p) noexcept {
    const bool steep = size(p.s) > size(p.c);
    return (p.s < 0.0 ? 4 : 0) + (p.c < 0.0 ? 2 : 0) + (steep ? 1 : 0);
}

using Terms = std::array<double, n_terms>;

// Least squares by Cholesky's factor of the normal equations. False where the samples do not tell the terms.
bool solve(const PowerSums& sums, Terms& term) noexcept {
    std::array<Terms, n_terms> factor{};
    Terms y{};
    for (unsigned i = 0; i < n_terms; ++i) {
        double rest = sums[place_of(power_c[i], power_s[i])];
        for (unsigned j = 0; j <= i; ++j) {
            const double whole = sums[place_of(power_c[i] + power_c[j], power_s[i] + power_s[j])];
            double x = whole;
            for (unsigned k = 0; k < j; ++k) x -= factor[i][k] * factor[j][k];
            if (j == i && !(x > 1e-9 * whole)) return false;
            factor[i][j] = j == i ? square_root(x) : x / factor[j][j];
            if (j < i) rest -= factor[i][j] * y[j];
        }
        y[i] = rest / factor[i][i];
    }
    for (unsigned i = n_terms; i-- > 0;) {
        double x = y[i];
        for (unsigned k = i + 1; k < n_terms; ++k) x -= factor[k][i] * term[k];
        term[i] = x / factor[i][i];
    }
    return true;
}

bool is_axis(double x) noexcept { return x >= 1.0 / max_axis && x <= max_axis; }

// Map of the ellipse (2): its centre, and the triangular (Cholesky) root of its quadratic form, chosen so that the
// cosine depends on c alone.
bool map_of(const Terms& t, EllipseMap& map, double& form) noexcept {
    const double determinant = 4.0 * t[0] * t[2] - t[1] * t[1];
    if (!(t[0] > 0.0 && determinant > 0.0)) return false;
    map.c0 = (t[1] * t[4] - 2.0 * t[2] * t[3]) / determinant;
    map.s0 = (t[1] * t[3] - 2.0 * t[0] * t[4]) / determinant;
    form = 1.0 + t[0] * map.c0 * map.c0 + t[1] * map.c0 * map.s0 + t[2] * map.s0 * map.s0;
    map.ss = square_root(t[2] / form);
    map.sc = 0.5 * t[1] / form / map.ss;
    map.cc = square_root(0.25 * determinant / (t[2] * form));
    return size(map.c0) <= max_offset && size(map.s0) <= max_offset && is_axis(map.cc) && is_axis(map.ss) &&
           size(map.sc) <= 1.0;
}

// A sample at radius r has left side - 1 = form (r^2 - 1) in (2), nearly 4 pi form times its phase noise in turns.
bool fit(EllipseCorrectionState& s) noexcept {
    Terms term{};
    EllipseMap map;
    double form = 1.0;
    if (!solve(s.memory, term) || !map_of(term, map, form)) return false;
    const double n = s.memory[0];
    double missed = n;
    for (unsigned k = 0; k < n_terms; ++k) missed -= term[k] * s.memory[place_of(power_c[k], power_s[k])];
    constexpr double four_pi = 12.566370614359172;
    s.noise_turns = missed > 0.0 ? square_root(missed / n) / (four_pi * form) : 0.0;
    s.map = map;
    s.learnt = true;
    return true;
}

void begin_block(EllipseCorrectionState& s) noexcept {
    s.block = {};
    s.in_bin = {};
    s.n_full = s.n_halves = 0;
}

}  // namespace

EllipseLearning learn(EllipseCorrectionState& state, const QuadratureSample& sample, int sign) noexcept {
    if (++state.n_halves > max_block_halves) begin_block(state);
    const bool is_first = state.block[0] == 0.0;
    std::int8_t& n = state.in_bin[static_cast<unsigned>(octant(on_circle(state.map, sample)) + (sign > 0 ? 8 : 0))];
    if (n >= samples_a_bin) return {};
    ++n;
    add(state.block, sample);
    state.n_full += n == samples_a_bin;
    if (state.n_full < ellipse_bins) return {.taken = true, .is_first = is_first};
    for (unsigned k = 0; k < state.memory.size(); ++k) state.memory[k] = kept * state.memory[k] + state.block[k];
    begin_block(state);
    if (!fit(state)) forget(state);
    return {.taken = true, .is_first = is_first, .completes = true};
}

void forget(EllipseCorrectionState& state) noexcept { state = {}; }

}  // namespace zlg::core
