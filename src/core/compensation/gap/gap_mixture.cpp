#include <zlg/core/compensation/gap_mixture.hpp>

#include <span>

#include <zlg/core/common/maths.hpp>

#include "mixture_models.hpp"
#include "motion_shapes.hpp"
#include "tridiagonal.hpp"

namespace zlg::core {
namespace {

// What a stage does, with its cost in thousands of instructions for 13 points or more. A shape that covers the window is
// reduced in one stage and its sizes are added in the next.
enum class Work : std::uint8_t { begin, turn, quiet, reduction, sizes, conclusion };

struct Stage {
    Work work;
    std::uint8_t shape = 0;
};

// In an order that fills the halves well between the last point of a gap and the tick in which its correction is due.
constexpr std::array stages = std::to_array<Stage>({
    {Work::begin},    {Work::quiet, 0}, {Work::quiet, 1},   {Work::quiet, 2},     {Work::quiet, 3},
    {Work::quiet, 4}, {Work::quiet, 5}, {Work::quiet, 6},   {Work::quiet, 7},     {Work::turn},
    {Work::quiet, 0}, {Work::quiet, 1}, {Work::quiet, 2},   {Work::quiet, 3},     {Work::reduction, 0},
    {Work::sizes, 0}, {Work::quiet, 4}, {Work::quiet, 5},   {Work::reduction, 1}, {Work::sizes, 1},
    {Work::quiet, 6}, {Work::quiet, 7}, {Work::conclusion},
});

// The same where nothing was learnt: only what covers the window, in the order of time.
constexpr std::array stages_of_any = std::to_array<Stage>({
    {Work::begin},
    {Work::reduction, 0},
    {Work::sizes, 0},
    {Work::reduction, 1},
    {Work::sizes, 1},
    {Work::reduction, 2},
    {Work::sizes, 2},
    {Work::reduction, 3},
    {Work::sizes, 3},
    {Work::reduction, 4},
    {Work::sizes, 4},
    {Work::reduction, 5},
    {Work::sizes, 5},
    {Work::reduction, 6},
    {Work::sizes, 6},
    {Work::conclusion},
});

std::span<const Stage> stages_of(const GapMixture& m) noexcept {
    return m.learnt ? std::span<const Stage>{stages} : std::span<const Stage>{stages_of_any};
}

std::span<const Shape> full_of(const GapMixture& m) noexcept {
    return m.learnt ? std::span<const Shape>{full_motion} : std::span<const Shape>{any_motion};
}

double prior_of_each(const GapMixture& m) noexcept {
    return m.learnt ? (1.0 - prior_of_nothing) / (n_models * prior_of_nothing)
                    : (1.0 - prior_of_rest) / (n_models_of_any * prior_of_rest);
}

constexpr std::array<std::int8_t, 6> cost{18, 20, 0, 46, 30, 5};
constexpr std::array<std::int8_t, 6> cost_of_few{14, 14, 0, 26, 24, 5};
constexpr std::array<std::int8_t, quiet_shapes> cost_of_quiet{9, 8, 6, 5, 9, 8, 6, 5};
constexpr int few_points = 12;

// A model may be so many times more probable, as a logarithm, before the sums are scaled anew.
constexpr double most_log_weight = 300.0;

void scale(double factor, MixtureColumn& column) noexcept {
    for (double& x : column) x *= factor;
}

// A weight as it counts in the variance: (3).
double coarse(const GapMixture& m, double weight) noexcept {
    return m.learnt ? square_root(square_root(weight)) : weight;
}

void rescale(double log_unit, GapMixture& m) noexcept {
    MixtureSums& s = m.sums;
    const double keep = maths::exp(s.log_unit - log_unit);
    s.log_unit = log_unit;
    s.weight *= keep;
    s.off *= keep;
    s.off_sq *= keep;
    s.variance *= keep;
    s.rate *= keep;
    scale(keep, s.dual);
    scale(keep, s.reversed_dual);
    for (MixtureColumn& column : s.added) scale(keep, column);
    const double keep_coarse = coarse(m, keep);
    s.coarse_weight *= keep_coarse;
    s.coarse_off *= keep_coarse;
    s.coarse_off_sq *= keep_coarse;
    s.coarse_variance *= keep_coarse;
}

void add(const MixtureModel& model, double weight, GapMixture& m) noexcept {
    const double off = model.value - m.nothing.value;
    MixtureSums& s = m.sums;
    s.weight += weight;
    s.off += weight * off;
    s.off_sq += weight * off * off;
    s.variance += weight * model.variance;
    s.rate += weight * model.rate;
    const double in_variance = coarse(m, weight);
    s.coarse_weight += in_variance;
    s.coarse_off += in_variance * off;
    s.coarse_off_sq += in_variance * off * off;
    s.coarse_variance += in_variance * model.variance;
}

// Sums over the sizes of one shape, of s^2 L^T u in its coordinates as well.
struct ShapeSums {
    double weight = 0.0, rate = 0.0;
    MixtureColumn dual{}, by_size{};
};

// All sizes of one shape.
void add_sizes(const Shape& shape, GapMixture& m, ShapeSums& sums) noexcept {
    const double prior = maths::log(prior_of_each(m));
    Bidiagonal b;
    MixtureColumn y{};
    double s2 = shape.least * m.smallest;
    for (int k = 0; k < shape.n; ++k, s2 *= shape.step) {
        const MixtureModel model = solve(m, s2, b);
        const double log_weight = prior + 0.5 * (model.log_evidence - m.nothing.log_evidence);
        if (!is_finite(log_weight)) continue;
        if (log_weight > m.sums.log_unit + most_log_weight) {
            const double keep = maths::exp(m.sums.log_unit - log_weight);
            rescale(log_weight, m);
            sums.weight *= keep;
            sums.rate *= keep;
            scale(keep, sums.dual);
            scale(keep, sums.by_size);
        }
        const double weight = maths::exp(log_weight - m.sums.log_unit);
        add(model, weight, m);
        sums.weight += weight;
        sums.rate += weight * model.rate;
        dual_of(m.shape, b, model.rate, y);
        const double by_size = weight * s2;
#pragma GCC unroll 2
        for (unsigned i = 0; i < m.shape.n; ++i) {
            sums.dual[i] += weight * y[i];
            sums.by_size[i] += by_size * y[i];
        }
    }
}

// The shape at hand.
//
// added  receives the sum of s^2 L^T u, where it is not null.
void add_shape(const Shape& shape, MixtureColumn* added, GapMixture& m) noexcept {
    const ShapeColumns& c = m.shape;
    if (c.n == 0) return;
    ShapeSums sums;
    add_sizes(shape, m, sums);
    for (unsigned i = 0; i < c.first; ++i) m.sums.dual[i] += sums.weight * m.value[i] - sums.rate * m.ones[i];
    reflect_back(c.reflections, c.n, sums.dual);
    for (unsigned i = 0; i < c.n; ++i) m.sums.dual[c.first + i] += sums.dual[i];
    if (added == nullptr) return;
    reflect_back(c.reflections, c.n, sums.by_size);
    *added = sums.by_size;
}

// Factor of C + E in the order of the present stages; H, z and k in its coordinates.
void factorize(const MotionCovariance& covariance, GapMixture& m) noexcept {
    const MixturePoints& p = m.points;
    const auto n = static_cast<unsigned>(p.n);
    m.factor.n = 0;
    MixtureColumn ones{};
    MixtureColumn value{};
    MixtureColumn with_sum{};
    double largest = 0.0;
    for (unsigned i = 0; i < n; ++i) {
        MixtureColumn row{};
        for (unsigned k = 0; k <= i; ++k) row[k] = covariance_of(m, i, k);
        if (!add_row(m.factor, row)) m.failed = true;
        if (m.failed) return;
        const double inverse = row_of(m.factor, i)[i];
        if (inverse > largest) largest = inverse;
        const unsigned own = point_of(m, i);
        ones[i] = 1.0;
        value[i] = p.value[own];
        with_sum[i] = -p.error_with_all[own];
        for (int j = 0; j < p.n_gap; ++j) with_sum[i] += covariance.of_ticks(p.place[own], p.n_side + j);
    }
    m.ones = forward(m.factor, ones);
    m.value = forward(m.factor, value);
    m.with_sum = forward(m.factor, with_sum);
    m.smallest = 1.0 / (largest * largest);
    m.nothing = nothing_added(m);
}

void begin(const MotionCovariance& covariance, GapMixture& m) noexcept {
    const MixturePoints& p = m.points;
    m.sum_variance = p.error_variance;
    for (int a = p.n_side; a < p.n_side + p.n_gap; ++a) {
        m.sum_variance += covariance.of_ticks(a, a);
        for (int b = p.n_side; b < a; ++b) m.sum_variance += 2.0 * covariance.of_ticks(b, a);
    }
    m.reversed = m.learnt;
    factorize(covariance, m);
    if (p.n < 3 || !is_finite(m.smallest)) m.failed = true;
}

// From reversed time to the order of time.
void turn_round(const MotionCovariance& covariance, GapMixture& m) noexcept {
    const MixtureColumn dual = backward(m.factor, m.sums.dual);
    for (unsigned i = 0; i < static_cast<unsigned>(m.points.n); ++i) m.sums.reversed_dual[point_of(m, i)] = dual[i];
    m.sums.dual = {};
    m.reversed = false;
    factorize(covariance, m);
}

void conclude(const MotionCovariance& covariance, GapMixture& m) noexcept {
    const MixturePoints& p = m.points;
    const auto n = static_cast<unsigned>(p.n);
    const double of_nothing = maths::exp(-m.sums.log_unit);
    const double per_weight = 1.0 / (of_nothing + m.sums.weight);
    MixtureEstimate& e = m.estimate;
    e.nothing = of_nothing * per_weight;
    e.off_arcsec = m.sums.off * per_weight;
    if (m.sums.coarse_weight > 0.0) {
        const double others = m.sums.weight * per_weight;
        const double in_part = against_nothing(e);
        const double per_coarse = in_part * others / m.sums.coarse_weight;
        const double per_fine = (1.0 - in_part) * per_weight;
        e.coarse_off_arcsec = m.sums.coarse_off * per_coarse + m.sums.off * per_fine;
        e.coarse_off_arcsec2 = m.sums.coarse_off_sq * per_coarse + m.sums.off_sq * per_fine;
        e.variance_arcsec2 = m.sums.coarse_variance * per_coarse + m.sums.variance * per_fine;
    }
    e.dual = backward(m.factor, m.sums.dual);
    for (unsigned i = 0; i < n; ++i) e.dual[i] += m.sums.reversed_dual[i];
    scale(per_weight, e.dual);
    for (int j = 0; j < p.n_gap; ++j) {
        double value = per_weight * m.sums.rate;
        for (unsigned i = 0; i < n; ++i) value += covariance.of_ticks(p.place[i], p.n_side + j) * e.dual[i];
        e.value_arcsec[static_cast<unsigned>(j)] = value;
    }
    const std::span<const Shape> full = full_of(m);
    for (unsigned s = 0; s < full.size(); ++s) {
        const MixtureColumn dual = backward(m.factor, m.sums.added[s]);
        const Added a{.shape = full[s]};
        for (int j = 0; j < p.n_gap; ++j)
            for (unsigned i = 0; i < n; ++i)
                e.value_arcsec[static_cast<unsigned>(j)] += per_weight * a.of(p.place[i], p.n_side + j) * dual[i];
    }
    e.known = is_finite(e.coarse_off_arcsec2 + e.variance_arcsec2 + m.nothing.value + e.value_arcsec[0]);
}

}  // namespace

void add_point(const MotionCovariance& covariance, GapMixture& mixture, int place, double value_arcsec,
               const MixtureColumn& error) noexcept {
    MixturePoints& p = mixture.points;
    const auto n = static_cast<unsigned>(p.n);
    if (n == mixture_unknowns) return;
    p.place[n] = static_cast<std::int8_t>(place);
    p.value[n] = value_arcsec;
    for (unsigned k = 0; k <= n; ++k)
        mixture.covariance[n * (n + 1) / 2 + k] = covariance.of_ticks(p.place[k], place) + error[k];
    ++p.n;
}

bool is_done(const GapMixture& mixture) noexcept {
    return mixture.failed || static_cast<std::size_t>(mixture.stage) >= stages_of(mixture).size();
}

int cost_of_stage(const GapMixture& mixture) noexcept {
    const Stage stage = stages_of(mixture)[static_cast<unsigned>(mixture.stage)];
    if (stage.work == Work::quiet) return cost_of_quiet[stage.shape];
    const auto work = static_cast<unsigned>(stage.work);
    return mixture.points.n > few_points ? cost[work] : cost_of_few[work];
}

void advance(const MotionCovariance& covariance, GapMixture& mixture) noexcept {
    const Stage stage = stages_of(mixture)[static_cast<unsigned>(mixture.stage++)];
    const unsigned k = stage.shape;
    if (stage.work == Work::begin) return begin(covariance, mixture);
    if (stage.work == Work::turn) return turn_round(covariance, mixture);
    if (stage.work == Work::conclusion) return conclude(covariance, mixture);
    const bool is_quiet = stage.work == Work::quiet;
    const Shape& shape = is_quiet ? quiet_motion[k] : full_of(mixture)[k];
    if (stage.work != Work::sizes) reduce(shape, mixture);
    if (stage.work == Work::reduction) return;
    prepare(shape, mixture);
    add_shape(shape, is_quiet ? nullptr : &mixture.sums.added[k], mixture);
}

}  // namespace zlg::core
