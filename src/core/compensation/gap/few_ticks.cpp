#include "few_ticks.hpp"

#include <zlg/core/common/maths.hpp>

#include "compensation/motion/rounding_law.hpp"
#include "compensation/motion/smooth_prior.hpp"
#include "gap_interpolation.hpp"
#include "gap_points.hpp"
#include "gap_rounding.hpp"

namespace zlg::core {
namespace {

constexpr int side_points = 6;

// Rates with the spectrum 1/(1 + (f/f0)^4) + floor, f in 1/tick, integrated over half-ticks; by distance in half-ticks, for a
// tick of variance 1. f0 = 0.0125, floor 1e-7; f0 = 0.05, floor 1e-4; white.
constexpr Window slow{0.250094854613, 0.249905145387, 0.249352888616, 0.248456464975, 0.247235809882, 0.245710269843,
                      0.243898603518, 0.241818985348, 0.239489009849, 0.236925696555, 0.234145495553, 0.231164293568,
                      0.227997420574, 0.224659656871, 0.221165240619, 0.217527875761, 0.213760740335, 0.209876495116,
                      0.205887292569, 0.201804786082, 0.197640139449, 0.193404036577, 0.189106691379, 0.18475785785,
                      0.180366840282, 0.175942503599, 0.171493283801, 0.167027198479, 0.162551857394, 0.158074473124,
                      0.153601871526, 0.149140502793, 0.144696451707, 0.14027544799,  0.135882878298, 0.131523794151,
                      0.1272029253,   0.122924687945};
constexpr Window rough{0.5};

// Sizes of each, over the scatter of the ticks: of a slow motion they show little.
struct Shape {
    const Window* by_halves;
    double least;
    double step;
    int n;
};
constexpr Shape shapes[] = {{&slow, 1.0, 100.0, 3}, {&smooth_prior, 0.1, 10.0, 4}, {&rough, 0.1, 10.0, 2}};

using Data = GapDataOf<some_unknowns>;

struct Places {
    int n = 0;
    std::array<int, some_unknowns> index{};
    std::array<double, some_unknowns> relock_arcsec2{};
};

Places places_of(const GapBridgeState& state, const Gap& gap, std::int64_t end, int n_side, Data& data) noexcept {
    Places p;
    for (int k = 0; k < 2 * n_side; ++k) {
        const int place = place_of(k, n_side, static_cast<int>(gap.n));
        const std::int64_t tick = gap.first_tick - n_side + place;
        if (tick < 0 || tick >= end || tick < end - history_ticks) continue;
        const HistoryTick& entry = at(state, tick);
        if (!entry.measured || !is_finite(entry.variance_arcsec2)) continue;
        const auto n = static_cast<unsigned>(p.n++);
        p.index[n] = place;
        data.value[n] = entry.row.dtheta_final_arcsec;
        if (k < n_side) continue;
        p.relock_arcsec2[n] = entry.relock_variance_arcsec2;
        data.error_with_all[n] = entry.relock_variance_arcsec2;
        data.error_variance += entry.relock_variance_arcsec2;
    }
    return p;
}

// One motion: what it says, and the logarithm of how probable it makes the points.
struct Member {
    GapEstimateOf<some_unknowns> estimate{};
    double log_evidence = 0.0;
};

Member solve_member(const OptimalBridgeConfig& config, const GapBridgeState& state, int n_gap, int n_side,
                    const Places& places, const Data& data) noexcept {
    GapProblemOf<some_unknowns> problem{.n_gap = n_gap, .n_side = n_side};
    const MotionCovariance covariance{config, state.learning.moments, fast_memory, 1.0};
    double diagonal = 1.0;
    for (unsigned k = 0; k < static_cast<unsigned>(places.n); ++k) {
        ColumnOf<some_unknowns> error{};
        error[k] = places.relock_arcsec2[k];
        add_point(covariance, problem, places.index[k], error);
        if (problem.failed) return {};
        diagonal *= problem.factor.lower[k * (k + 3) / 2];
    }
    GapSolutionOf<some_unknowns> solution;
    while (!solution.done) advance(covariance, problem, data, solution);
    Member m{.estimate = solution.estimate};
    const double squares = m.estimate.innovation_ratio * (places.n - 1);
    m.log_evidence =
        natural_log(diagonal * diagonal / (solution.rates.information > 0.0 ? solution.rates.information : 1.0)) -
        squares;
    return m;
}

// Sum of a mixture whose weights are known only up to a factor.
class Mixture {
public:
    void add(const Member& member, const Gap& gap, const std::array<double, max_gap_ticks>& value_arcsec) noexcept {
        if (!member.estimate.known || !is_finite(member.log_evidence)) return;
        if (!(total_ > 0.0) || member.log_evidence > most_) {
            const double keep = total_ > 0.0 ? exponential(0.5 * (most_ - member.log_evidence)) : 0.0;
            total_ *= keep;
            sum_ *= keep;
            for (double& x : ticks_) x *= keep;
            most_ = member.log_evidence;
        }
        const double weight = exponential(0.5 * (member.log_evidence - most_));
        total_ += weight;
        double beside = 0.0;
        for (unsigned j = 0; j < static_cast<unsigned>(gap.n); ++j) {
            const double off = member.estimate.value_arcsec[j] - value_arcsec[j];
            beside += off;
            ticks_[j] += weight * (member.estimate.variance_arcsec2[j] + off * off);
        }
        sum_ += weight * (member.estimate.sum_variance_arcsec2 + beside * beside);
    }

    [[nodiscard]] FewTicks result() const noexcept {
        FewTicks out{.known = total_ > 0.0 && is_finite(sum_)};
        if (!out.known) return out;
        out.sum_variance_arcsec2 = sum_ / total_;
        for (unsigned j = 0; j < ticks_.size(); ++j) out.variance_arcsec2[j] = ticks_[j] / total_;
        return out;
    }

private:
    double total_ = 0.0, sum_ = 0.0, most_ = 0.0;
    std::array<double, max_gap_ticks> ticks_{};
};

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
    const int n_gap = static_cast<int>(gap.n);
    const int n_side = points_a_side(n_gap) < side_points ? points_a_side(n_gap) : side_points;
    Data data;
    const Places places = places_of(state, gap, end, n_side, data);
    if (places.n < 2) return {};
    const double step = config.optimal.counter_step.value();
    const double seen = scatter(data.value.data(), places.n) + 1e-4 * step * step;
    OptimalBridgeConfig presumed{.learns = false, .counter_step = config.optimal.counter_step};
    Mixture mixture;
    for (const Shape& shape : shapes) {
        double size = shape.least * seen;
        for (int k = 0; k < shape.n; ++k, size *= shape.step) {
            for (unsigned i = 0; i < presumed.prior_arcsec2.size(); ++i)
                presumed.prior_arcsec2[i] = size * (*shape.by_halves)[i];
            mixture.add(solve_member(presumed, state, n_gap, n_side, places, data), gap, value_arcsec);
        }
    }
    FewTicks found = mixture.result();
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
