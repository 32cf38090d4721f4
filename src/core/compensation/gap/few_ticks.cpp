#include "few_ticks.hpp"

#include <zlg/core/common/maths.hpp>

#include "compensation/motion/rounding_law.hpp"
#include "compensation/motion/smooth_prior.hpp"
#include "gap_interpolation.hpp"
#include "gap_points.hpp"
#include "gap_rounding.hpp"

namespace zlg::core {
namespace {

constexpr int side_points = 4;

// Rates with the spectrum 1/(1 + (f/f0)^4) + floor, f in 1/tick, integrated over half-ticks; by distance in half-ticks, for a
// tick of variance 1. f0 = 0.0125, floor 1e-7; smooth_prior; white.
constexpr Window slow{0.250094854613, 0.249905145387, 0.249352888616, 0.248456464975, 0.247235809882, 0.245710269843,
                      0.243898603518, 0.241818985348, 0.239489009849, 0.236925696555, 0.234145495553, 0.231164293568,
                      0.227997420574, 0.224659656871, 0.221165240619, 0.217527875761, 0.213760740335, 0.209876495116,
                      0.205887292569, 0.201804786082, 0.197640139449, 0.193404036577, 0.189106691379, 0.18475785785,
                      0.180366840282, 0.175942503599, 0.171493283801, 0.167027198479, 0.162551857394, 0.158074473124,
                      0.153601871526, 0.149140502793, 0.144696451707, 0.14027544799,  0.135882878298, 0.131523794151,
                      0.1272029253,   0.122924687945};
constexpr TickWindow slow_ticks = of_ticks(slow);
constexpr TickWindow smooth_ticks = of_ticks(smooth_prior);
constexpr TickWindow rough_ticks{1.0};

// Sizes of each, over the scatter of the ticks: of a slow motion they show little.
struct Shape {
    const TickWindow* by_distance;
    double least;
    double step;
    int n;
};
constexpr Shape shapes[] = {{&slow_ticks, 1.0, 100.0, 3}, {&smooth_ticks, 0.1, 10.0, 4}, {&rough_ticks, 0.1, 10.0, 2}};

using Numbers = ColumnOf<few_unknowns>;

// The ticks beside the gap, in places from n_side before it on.
struct Places {
    int n_gap = 0, n_side = 0;
    int n = 0;
    std::array<int, few_unknowns> index{};
    Numbers value_arcsec{};
    Numbers relock_arcsec2{};
    double sum_relock_arcsec2 = 0.0;
};

Places places_of(const GapBridgeState& state, const Gap& gap, std::int64_t end, int n_side) noexcept {
    Places p{.n_gap = static_cast<int>(gap.n), .n_side = n_side};
    for (int k = 0; k < 2 * n_side; ++k) {
        const int place = place_of(k, n_side, p.n_gap);
        const std::int64_t tick = gap.first_tick - n_side + place;
        if (tick < 0 || tick >= end || tick < end - history_ticks) continue;
        const HistoryTick& entry = at(state, tick);
        if (!entry.measured || !is_finite(entry.variance_arcsec2)) continue;
        const auto n = static_cast<unsigned>(p.n++);
        p.index[n] = place;
        p.value_arcsec[n] = entry.row.dtheta_final_arcsec;
        if (k < n_side) continue;
        p.relock_arcsec2[n] = entry.relock_variance_arcsec2;
        p.sum_relock_arcsec2 += entry.relock_variance_arcsec2;
    }
    return p;
}

// Ticks from a point to the nearest one of the gap.
int distance(const Places& p, unsigned k) noexcept {
    return p.index[k] < p.n_side ? p.n_side - p.index[k] : p.index[k] - (p.n_side + p.n_gap) + 1;
}

// Covariance of two ticks as they are read, by their distance.
TickWindow as_read(const TickWindow& shape, double size, double step_arcsec) noexcept {
    TickWindow c;
    for (unsigned k = 0; k < c.size(); ++k) c[k] = size * shape[k];
    const double rounding = step_arcsec * step_arcsec / 6.0;
    c[0] += rounding;
    c[1] -= 0.5 * rounding;
    return c;
}

// What is solved for each motion, point by point: L^-1 of these, C = L L^T the covariance of the points.
enum PointColumn : unsigned { of_ones, of_values, of_gap, of_relock, n_columns };
using PointColumns = std::array<double, n_columns>;

// One motion beside the ticks.
struct Member {
    bool known = false;
    CholeskyFactorOf<few_unknowns> factor{};
    std::array<PointColumns, few_unknowns> column{};
    double information = 0.0;  // of the rate
    double rate_arcsec = 0.0;
    double log_evidence = 0.0;  // twice the logarithm of how probable it makes the points
};

double sum_over(const Member& m, PointColumn a, PointColumn b) noexcept {
    double sum = 0.0;
#pragma GCC unroll 4
    for (unsigned k = 0; k < static_cast<unsigned>(m.factor.n); ++k) sum += m.column[k][a] * m.column[k][b];
    return sum;
}

// The row of the factor that was added last, for all columns.
void eliminate(Member& m) noexcept {
    const auto k = static_cast<unsigned>(m.factor.n - 1);
    const double* const row = m.factor.lower.data() + k * (k + 1) / 2;
    PointColumns x = m.column[k];
    for (unsigned i = 0; i < k; ++i) {
#pragma GCC unroll 4
        for (unsigned c = 0; c < n_columns; ++c) x[c] -= row[i] * m.column[i][c];
    }
#pragma GCC unroll 4
    for (unsigned c = 0; c < n_columns; ++c) m.column[k][c] = row[k] * x[c];
}

// The rate, and what is left of the values without it.
void fit_rate(double diagonal, Member& m) noexcept {
    m.information = sum_over(m, of_ones, of_ones);
    m.rate_arcsec = sum_over(m, of_ones, of_values) / m.information;
    for (unsigned k = 0; k < static_cast<unsigned>(m.factor.n); ++k)
        m.column[k][of_values] -= m.rate_arcsec * m.column[k][of_ones];
    m.log_evidence = natural_log(diagonal * diagonal / m.information) - sum_over(m, of_values, of_values);
    m.known = is_finite(m.log_evidence);
}

// below  sums of the covariance over distances below k.
void factorize(const TickWindow& covariance, const std::array<double, window_ticks + 1>& below, const Places& places,
               Member& m) noexcept {
    m.known = false;
    m.factor.n = 0;
    double diagonal = 1.0;
    Numbers row{};
    for (unsigned k = 0; k < static_cast<unsigned>(places.n); ++k) {
        const double* const from = covariance.data() + places.index[k];
        for (unsigned i = 0; i <= k; ++i) row[i] = from[-places.index[i]];
        row[k] += places.relock_arcsec2[k];
        if (!add_row(m.factor, row)) return;
        diagonal *= m.factor.lower[k * (k + 3) / 2];
        const auto nearest = static_cast<unsigned>(distance(places, k));
        const double with_gap = below[nearest + static_cast<unsigned>(places.n_gap)] - below[nearest];
        m.column[k] = {1.0, places.value_arcsec[k], with_gap, places.relock_arcsec2[k]};
        eliminate(m);
    }
    fit_rate(diagonal, m);
}

struct Target {
    double value_arcsec = 0.0, variance_arcsec2 = 0.0;
};

// The angle of the gap; its variance less the errors of the re-lock correction after it.
Target solve(const TickWindow& covariance, const Places& places, Member& m) noexcept {
    std::array<double, window_ticks + 1> below;
    below[0] = 0.0;
    for (unsigned k = 0; k < covariance.size(); ++k) below[k + 1] = below[k] + covariance[k];
    factorize(covariance, below, places, m);
    if (!m.known) return {};
    double variance = places.n_gap * covariance[0] + places.sum_relock_arcsec2;
    for (int k = 1; k < places.n_gap; ++k) variance += 2.0 * (places.n_gap - k) * covariance[static_cast<unsigned>(k)];
    const double value = places.n_gap * m.rate_arcsec + sum_over(m, of_gap, of_values);
    for (unsigned k = 0; k < static_cast<unsigned>(places.n); ++k) m.column[k][of_gap] -= m.column[k][of_relock];
    const double gain = places.n_gap - sum_over(m, of_gap, of_ones);
    return {value, variance - sum_over(m, of_gap, of_gap) + gain * gain / m.information};
}

Target tick_of_gap(const TickWindow& covariance, const Places& places, const Member& m, int j) noexcept {
    Numbers with{};
    for (unsigned k = 0; k < static_cast<unsigned>(places.n); ++k) {
        const int distance = places.index[k] - (places.n_side + j);
        with[k] = covariance[static_cast<unsigned>(distance < 0 ? -distance : distance)];
    }
    const Numbers g = forward(m.factor, with);
    double value = m.rate_arcsec;
    double gain = 1.0;
    for (unsigned k = 0; k < static_cast<unsigned>(places.n); ++k) {
        value += g[k] * m.column[k][of_values];
        gain -= g[k] * m.column[k][of_ones];
    }
    return {value, covariance[0] - product(g, g, places.n) + gain * gain / m.information};
}

// Mean square of what may be wrong with an angle, by motions whose weights are known only up to a factor, and the most
// probable of them.
struct Mixture {
    double total = 0.0, sum_arcsec2 = 0.0;
    Member best{};
    TickWindow best_covariance{};
    double best_arcsec2 = 0.0;

    void add(const TickWindow& covariance, const Member& m, double mean_sq_arcsec2) noexcept {
        if (!m.known || !is_finite(mean_sq_arcsec2)) return;
        if (!best.known || m.log_evidence > best.log_evidence) {
            const double keep = best.known ? exponential(0.5 * (best.log_evidence - m.log_evidence)) : 0.0;
            total *= keep;
            sum_arcsec2 *= keep;
            best = m;
            best_covariance = covariance;
            best_arcsec2 = mean_sq_arcsec2;
        }
        const double weight = exponential(0.5 * (m.log_evidence - best.log_evidence));
        total += weight;
        sum_arcsec2 += weight * mean_sq_arcsec2;
    }
};

// The ticks of the gap are known in the proportions of the most probable motion.
FewTicks result_of(const Mixture& mixture, const Places& places,
                   const std::array<double, max_gap_ticks>& value_arcsec) noexcept {
    if (!mixture.best.known) return {};
    FewTicks out{.known = true, .sum_variance_arcsec2 = mixture.sum_arcsec2 / mixture.total};
    const double scale = out.sum_variance_arcsec2 / mixture.best_arcsec2;
    for (int j = 0; j < places.n_gap; ++j) {
        const Target tick = tick_of_gap(mixture.best_covariance, places, mixture.best, j);
        const double off = tick.value_arcsec - value_arcsec[static_cast<unsigned>(j)];
        out.variance_arcsec2[static_cast<unsigned>(j)] = scale * (tick.variance_arcsec2 + off * off);
    }
    return out;
}

FewTicks mixture_of(const Places& places, double step_arcsec, double scatter_arcsec2,
                    const std::array<double, max_gap_ticks>& value_arcsec) noexcept {
    double angle = 0.0;
    for (int j = 0; j < places.n_gap; ++j) angle += value_arcsec[static_cast<unsigned>(j)];
    Mixture mixture;
    Member m;
    for (const Shape& shape : shapes) {
        double size = shape.least * scatter_arcsec2;
        for (int k = 0; k < shape.n; ++k, size *= shape.step) {
            const TickWindow covariance = as_read(*shape.by_distance, size, step_arcsec);
            const Target gap = solve(covariance, places, m);
            const double off = gap.value_arcsec - angle;
            mixture.add(covariance, m, gap.variance_arcsec2 + off * off);
        }
    }
    return result_of(mixture, places, value_arcsec);
}

// Ticks before the gap without a break, as prefix sums.
struct Run {
    int n = 0;
    std::array<double, 2 * window_ticks> angle_arcsec{};
};

Run run_before(const GapBridgeState& state, const Gap& gap, std::int64_t end) noexcept {
    Run run;
    double sum = 0.0;
    for (std::int64_t tick = gap.first_tick - 1; tick >= 0 && tick > end - history_ticks; --tick) {
        if (!at(state, tick).measured || run.n + 1 == static_cast<int>(run.angle_arcsec.size())) break;
        sum += at(state, tick).row.dtheta_final_arcsec;
        run.angle_arcsec[static_cast<unsigned>(++run.n)] = sum;
    }
    return run;
}

// Mean square of these ticks about their mean.
double scatter_of(const Run& run) noexcept {
    std::array<double, 2 * window_ticks> ticks{};
    for (unsigned k = 0; k < static_cast<unsigned>(run.n); ++k)
        ticks[k] = run.angle_arcsec[k + 1] - run.angle_arcsec[k];
    return run.n > 0 ? scatter(ticks.data(), run.n) : 0.0;
}

// Roundings as these few ticks show them.
RoundingLaw law_of_run(const Run& run, double step) noexcept {
    const double rate = run.n > 0 ? run.angle_arcsec[static_cast<unsigned>(run.n)] / run.n : 0.0;
    std::array<double, window_ticks + 1> read{};
    for (int lag = 1; lag <= window_ticks; ++lag) {
        const auto k = static_cast<unsigned>(lag);
        // What these ticks do not show is not known: no rounding then says anything of another one.
        read[k] = step * step;
        if (lag > run.n) continue;
        double sum = 0.0;
        for (unsigned i = 0; i + k <= static_cast<unsigned>(run.n); ++i) {
            const double x = run.angle_arcsec[i + k] - run.angle_arcsec[i] - rate * lag;
            sum += x * x;
        }
        read[k] = sum / (run.n - lag + 1);
    }
    return rounding_law(step, rate, read, false, 0.0);
}

// The whole rounding in a variance is that of readings that have nothing to do with each other: put that right.
double put_right(const GapBridgeState& state, const RoundingLaw& law, const Gap& gap, int n_side, const Places& places,
                 double variance) noexcept {
    if (!(law.step_arcsec > 0.0)) return variance;
    BorderWeights weights{.gap_begin = n_side, .gap_end = n_side + static_cast<int>(gap.n)};
    for (unsigned k = 0; k < static_cast<unsigned>(places.n); ++k)
        weights.add(places.index[k], static_cast<double>(gap.n) / places.n,
                    at(state, gap.first_tick - n_side + places.index[k]).row.relock_arcsec, places.relock_arcsec2[k]);
    weights.add_edges();
    const RoundingSums sums = rounding_of(law, weights, 1, 1);
    const double right = variance + sums.broken_arcsec2 - sums.white_arcsec2;
    return right > sums.broken_arcsec2 ? right : sums.broken_arcsec2;
}

// The polynomial, tried on gaps that were measured.
struct Tries {
    double n = 0.0, sum_arcsec2 = 0.0;
};

void try_on(const GapBridgeState& state, const PolynomialFit& fit, const FitWeights& of_sum, std::int64_t n_gap,
            std::int64_t from, std::int64_t to, Tries& tries) noexcept {
    const std::int64_t first = fit.position(0) < 1 ? fit.position(0) : 1;
    const std::int64_t last = fit.position(fit.n() - 1) > n_gap ? fit.position(fit.n() - 1) : n_gap;
    for (std::int64_t origin = from - first; origin + last <= to; ++origin) {
        double error = 0.0;
        for (int k = 0; k < fit.n(); ++k)
            error += of_sum[static_cast<unsigned>(k)] * at(state, origin + fit.position(k)).row.dtheta_final_arcsec;
        for (std::int64_t j = 1; j <= n_gap; ++j) error -= at(state, origin + j).row.dtheta_final_arcsec;
        tries.sum_arcsec2 += error * error;
        tries.n += 1.0;
    }
}

// What a mixture is worth in tries, of which neighbours share most of their ticks.
constexpr double mixture_tries = 3.0;

// What the errors of the re-lock correction make of the polynomial, in the first ticks after the gap.
double relock_in(const GapBridgeState& state, const Gap& gap, std::int64_t end, int n_side, const PolynomialFit& fit,
                 const FitWeights& of_sum) noexcept {
    double sum = 0.0;
    for (std::int64_t position = gap.n + 1; position <= gap.n + n_side; ++position) {
        const std::int64_t tick = gap.first_tick - 1 + position;
        if (tick >= end || !at(state, tick).measured) continue;
        double weight = 1.0;
        for (int k = 0; k < fit.n(); ++k)
            if (fit.position(k) == position) weight += of_sum[static_cast<unsigned>(k)];
        sum += weight * weight * at(state, tick).relock_variance_arcsec2;
    }
    return sum;
}

// Of the mixture and the tries, without the roundings, which are then added as they are.
double tried(const GapBridgeConfig& config, const GapBridgeState& state, const Gap& gap, std::int64_t end, int n_side,
             const PolynomialFit& fit, const RoundingLaw& law, const Run& run, double variance) noexcept {
    const FitWeights of_sum = weights_in_sum(fit, gap.n);
    Tries tries;
    try_on(state, fit, of_sum, gap.n, gap.first_tick - run.n, gap.first_tick - 1, tries);
    std::int64_t after = gap.first_tick + gap.n;
    while (after < end && at(state, after).measured) ++after;
    try_on(state, fit, of_sum, gap.n, gap.first_tick + gap.n, after - 1, tries);
    if (!(tries.n > 0.0)) return variance;
    const RoundingSums rounding = rounding_of_fit(config, state, gap, fit, law);
    const double missed = tries.sum_arcsec2 / tries.n - rounding.continuing_arcsec2;
    const double of_tries = (missed > 0.0 ? missed : 0.0) + relock_in(state, gap, end, n_side, fit, of_sum);
    const double motion = variance - rounding.broken_arcsec2;
    const double of_mixture = motion > 0.0 ? motion : 0.0;
    return rounding.broken_arcsec2 + (mixture_tries * of_mixture + tries.n * of_tries) / (mixture_tries + tries.n);
}

// Of the re-lock beyond the points.
double relock_beyond(const GapBridgeState& state, const Gap& gap, std::int64_t end, int n_side) noexcept {
    double sum = 0.0;
    for (std::int64_t tick = gap.first_tick + gap.n + n_side; tick < end; ++tick)
        if (at(state, tick).measured) sum += at(state, tick).relock_variance_arcsec2;
    return sum;
}

}  // namespace

FewTicks judge_by_few(const GapBridgeConfig& config, const GapBridgeState& state, const Gap& gap, std::int64_t end,
                      const PolynomialFit& fit, const std::array<double, max_gap_ticks>& value_arcsec) noexcept {
    if (gap.n > max_solved_gap) return {};
    const int room = points_a_side(static_cast<int>(gap.n));
    const int n_side = room < side_points ? room : side_points;
    const Places places = places_of(state, gap, end, n_side);
    if (places.n < 2) return {};
    const double step = config.optimal.counter_step.value();
    const double seen = scatter(places.value_arcsec.data(), places.n) + 1e-4 * step * step;
    FewTicks found = mixture_of(places, step, seen, value_arcsec);
    if (!found.known) return found;
    const Run run = run_before(state, gap, end);
    const RoundingLaw law = law_of_run(run, step);
    double variance = put_right(state, law, gap, n_side, places, found.sum_variance_arcsec2);
    // A motion that has only begun is not that of these tries.
    if (!is_rough(seen, scatter_of(run) + step * step))
        variance = tried(config, state, gap, end, n_side, fit, law, run, variance);
    if (variance < found.sum_variance_arcsec2)
        for (double& x : found.variance_arcsec2) x *= variance / found.sum_variance_arcsec2;
    found.sum_variance_arcsec2 = variance + relock_beyond(state, gap, end, n_side);
    return found;
}

}  // namespace zlg::core
