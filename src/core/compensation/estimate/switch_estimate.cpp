#include <zlg/core/compensation/switch_estimate.hpp>

#include <memory>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"
#include "window_covariance.hpp"

namespace zlg::core {
namespace {

// Prior of the learnt motion alone: as likely as all of the bank; next to nothing before it is known from as many
// windows.
constexpr double prior_of_learnt = 0.5;
constexpr double prior_of_unknown = 0.05;

// What rounding leaves of a pivot, as a part of the trace: the largest sizes would fail without it.
constexpr double rounding_of_trace = 2e-15;

// The scale of chi f0 wanders from switch to switch by this variance.
constexpr double scale_wander = 1e-8;

// A shift of it beyond five standard deviations is that of damaged records.
constexpr double most_shift_sq = 25.0;

bool is_bridged(const WindowRow& row) noexcept { return row.wanted && !row.read; }

// What the estimate is made from.
struct Problem {
    const SwitchWindow& window;
    const RelockScale& scale;
    Triangle v;       // V of all rows
    Triangle errors;  // E of the points after the gap
    WindowReadings readings{};
    int n = 0;                                 // points
    std::array<int, most_window_rows> rows{};  // of each
    int n_before = 0;                          // points before the gap
    double wanted_halves = 0.0;                // of the rows without a reading
    double known_arcsec = 0.0;                 // of those with one

    // Of a point after the gap with another point: what the error of a reading before the gap is has nothing to do with
    // it.
    [[nodiscard]] double error(int a, int b) const noexcept {
        return a < n_before || b < n_before ? 0.0 : errors.at(a - n_before, b - n_before);
    }
    [[nodiscard]] int row(int point) const noexcept { return rows[static_cast<unsigned>(point)]; }
    [[nodiscard]] bool is_corrected(int point) const noexcept { return row_of(window, row(point)).wanted; }
};

// The rows that border V of the points: one number for each point.
using PointValues = std::array<double, most_window_points>;

struct Border {
    // Covariance with what is wanted: of the motion that was not read, less the errors of what was.
    PointValues target{};
    double target_variance = 0.0;
    PointValues level{}, reading{}, scale{};
};

// E, and with it C + E of the points.
void add_errors(const CompensationConstants& gyro, EstimateRoom& room, Problem& problem) noexcept {
    const ReadingErrors e{gyro, problem.window, problem.scale, room.halves, problem.readings};
    for (int a = 0; a < problem.n; ++a)
        for (int b = 0; b <= a; ++b) {
            const double error = e.of(problem.row(a), problem.row(b));
            problem.v.row(problem.row(a))[problem.row(b)] += error;
            if (b >= problem.n_before) problem.errors.row(a - problem.n_before)[b - problem.n_before] = error;
        }
}

void set_target(const Problem& problem, Border& border) noexcept {
    const SwitchWindow& window = problem.window;
    const int n = problem.n;
    border.target_variance = 0.0;
    for (int a = 0; a < n; ++a) {
        double sum = 0.0;
        for (int u = 0; u < window.n_rows; ++u)
            if (is_bridged(row_of(window, u))) sum += problem.v.at(u, problem.row(a));
        for (int b = problem.n_before; b < n; ++b)
            if (problem.is_corrected(b)) sum -= problem.error(a, b);
        border.target[static_cast<unsigned>(a)] = sum;
        for (int b = problem.n_before; b < n; ++b)
            if (problem.is_corrected(a) && problem.is_corrected(b)) border.target_variance += problem.error(a, b);
    }
    for (int u = 0; u < window.n_rows; ++u)
        for (int w = 0; w < window.n_rows; ++w)
            if (is_bridged(row_of(window, u)) && is_bridged(row_of(window, w)))
                border.target_variance += problem.v.at(u, w);
}

Border border_of(const Problem& problem) noexcept {
    Border border;
    set_target(problem, border);
    for (int a = 0; a < problem.n; ++a) {
        const auto at = static_cast<unsigned>(a);
        const auto r = static_cast<unsigned>(problem.row(a));
        border.level[at] = width(problem.window.row[r]);
        border.reading[at] = problem.readings.angle_arcsec[r] - border.level[at] * problem.readings.rate_arcsec;
        border.scale[at] = -problem.scale.variance * problem.readings.false_arcsec[r];
    }
    return border;
}

// Where a member walks in this window.
Walk walk_of(const BankMember& member, const SwitchWindow& window) noexcept {
    if (member.place == WalkPlace::everywhere) return {member.kind, 0, window.n_halves};
    const int behind = window.gap.last + member.halves;
    if (member.place == WalkPlace::after) return {member.kind, behind, window.n_halves};
    return {member.kind, window.gap.first - member.halves, behind};
}

Stretch reversed(const SwitchWindow& window, const Stretch& s) noexcept {
    return {window.n_halves - s.last, window.n_halves - s.first};
}

double variance_of_half(const Walk& walk, int half) noexcept { return walked(walk, {half, half + 1}).variance; }

// The largest variance of a half, or that of the middle of the window for a walk that goes both ways.
double unit_of(const BankMember& member, const Walk& walk, const SwitchWindow& window) noexcept {
    if (member.place != WalkPlace::everywhere) return variance_of_half(walk, window.n_halves - 1);
    const int middle = window.n_halves / 2;
    return 0.5 * (variance_of_half(walk, middle) + variance_of_half(walk, window.n_halves - 1 - middle));
}

// K of a member, as large as its unit: as the walks of walk_kernel.hpp have it, of a walk both ways half of each.
class Kernel {
public:
    Kernel(const BankMember& member, const SwitchWindow& window) noexcept
        : kind_{member.kind}, both_ways_{member.place == WalkPlace::everywhere} {
        const Walk walk = walk_of(member, window);
        const double unit = unit_of(member, walk, window);
        if (!(unit > 0.0)) return;
        const double part = both_ways_ ? 0.5 / unit : 1.0 / unit;
        for (int r = 0; r < window.n_rows; ++r) {
            const Stretch& halves = row_of(window, r).halves;
            set(r, part, walked(walk, halves), moment_, coefficient_);
            // Against time the later of two rows is the first.
            if (both_ways_) set(r, part, walked(walk, reversed(window, halves)), back_moment_, back_coefficient_);
        }
        is_there_ = true;
    }

    // False: it does not walk in this window.
    [[nodiscard]] bool is_there() const noexcept { return is_there_; }

    // Of two rows, the second of which is the later one, or the same.
    [[nodiscard]] double at(int early, int late) const noexcept {
        const auto e = static_cast<unsigned>(early);
        const auto l = static_cast<unsigned>(late);
        if (early == late) return variance_[l];
        double k = 0.0;
        for (unsigned m = 0; m < most_walk_terms; ++m)
            k += moment_[m][e] * coefficient_[m][l] + back_moment_[m][l] * back_coefficient_[m][e];
        return k;
    }

    // Row a of a matrix of the points and, so many times, of the kernel.
    void add_row(const Problem& problem, int a, double size, const double* v, double* to) const noexcept {
        const int r = problem.row(a);
        to[a] = v[r] + size * at(r, r);
        if (kind_ == 2)
            return both_ways_ ? add<2, true>(problem, a, size, v, to) : add<2, false>(problem, a, size, v, to);
        return both_ways_ ? add<3, true>(problem, a, size, v, to) : add<3, false>(problem, a, size, v, to);
    }

private:
    using Terms = std::array<std::array<double, most_window_rows>, most_walk_terms>;

    void set(int r, double part, const WalkedStretch& walked, Terms& moment, Terms& coefficient) noexcept {
        const auto at = static_cast<unsigned>(r);
        variance_[at] += part * walked.variance;
        for (unsigned m = 0; m < most_walk_terms; ++m) {
            moment[m][at] = part * walked.moment[m];
            coefficient[m][at] = walked.coefficient[m];
        }
    }

    // The points before it, of a walk of so many terms.
    template <unsigned n, bool both_ways>
    void add(const Problem& problem, int a, double size, const double* v, double* to) const noexcept {
        const auto late = static_cast<unsigned>(problem.row(a));
        double of_late[n];
        double back[n];
        for (unsigned m = 0; m < n; ++m) {
            of_late[m] = size * coefficient_[m][late];
            back[m] = size * back_moment_[m][late];
        }
        for (int b = 0; b < a; ++b) {
            const auto early = static_cast<unsigned>(problem.row(b));
            double sum = v[early];
            for (unsigned m = 0; m < n; ++m) sum += of_late[m] * moment_[m][early];
            if constexpr (both_ways)
                for (unsigned m = 0; m < n; ++m) sum += back[m] * back_coefficient_[m][early];
            to[b] = sum;
        }
    }

    int kind_ = 2;
    bool both_ways_ = false;
    bool is_there_ = false;
    std::array<double, most_window_rows> variance_{};
    Terms moment_{}, coefficient_{};
    Terms back_moment_{}, back_coefficient_{};
};

// The kernel's covariance of the points with what is wanted, and its variance.
struct KernelTarget {
    PointValues with{};
    double variance = 0.0;
};

KernelTarget target_of(const Problem& problem, const Kernel& kernel) noexcept {
    const SwitchWindow& window = problem.window;
    KernelTarget target;
    for (int u = 0; u < window.n_rows; ++u) {
        if (!is_bridged(row_of(window, u))) continue;
        for (int a = 0; a < problem.n; ++a) {
            const int r = problem.row(a);
            target.with[static_cast<unsigned>(a)] += r < u ? kernel.at(r, u) : kernel.at(u, r);
        }
        for (int w = 0; w <= u; ++w)
            if (is_bridged(row_of(window, w))) target.variance += (w < u ? 2.0 : 1.0) * kernel.at(w, u);
    }
    return target;
}

// V of the points, with a kernel of this size.
void build(const Problem& problem, const Kernel* kernel, double size, Triangle into) noexcept {
    for (int a = 0; a < problem.n; ++a) {
        const double* const v = problem.v.row(problem.row(a));
        double* const to = into.row(a);
        if (kernel != nullptr)
            kernel->add_row(problem, a, size, v, to);
        else
            for (int b = 0; b <= a; ++b) to[b] = v[problem.row(b)];
    }
}

struct MeanVariance {
    double mean = 0.0;
    double variance = 0.0;
};

// What one member says.
struct MemberEstimate {
    double evidence = 0.0;  // logarithm of its restricted likelihood
    MeanVariance angle{};   // arcsec, arcsec^2
    MeanVariance scale{};   // shift of the scale of chi f0
};

// With what rounding leaves of a pivot.
bool factorise_widened(Triangle v, double* reciprocal, int n) noexcept {
    double trace = 0.0;
    for (int a = 0; a < n; ++a) trace += v.row(a)[a];
    for (int a = 0; a < n; ++a) v.row(a)[a] += rounding_of_trace * trace;
    return factorise(v, reciprocal, n);
}

// Generalised least squares with an unknown level, by one factor.
//
// factor  V_m of the points, with room for the border; of no use after.
// return  false where V_m is not positive definite.
bool solve(const Problem& problem, const Border& border, const KernelTarget* kernel, double size, Triangle factor,
           MemberEstimate& found) noexcept {
    const int n = problem.n;
    PointValues reciprocal{};
    if (!factorise_widened(factor, reciprocal.data(), n)) return false;
    double* const target = factor.row(n);
    double* const level = factor.row(n + 1);
    double* const reading = factor.row(n + 2);
    double* const scale = factor.row(n + 3);
    for (int a = 0; a < n; ++a) {
        const auto at = static_cast<unsigned>(a);
        target[a] = border.target[at] + (kernel != nullptr ? size * kernel->with[at] : 0.0);
        level[a] = border.level[at];
        reading[a] = border.reading[at];
        scale[a] = border.scale[at];
    }
    const double variance = border.target_variance + (kernel != nullptr ? size * kernel->variance : 0.0);
    for (double* const row : {target, level, reading, scale}) eliminate(factor, reciprocal.data(), n, row);
    const double weight = dot(level, level, n);
    const double rate = dot(level, reading, n) / weight;
    const double level_target = dot(level, target, n);
    const double level_scale = dot(level, scale, n);
    const double misfit = dot(reading, reading, n) - rate * rate * weight;
    const double missing = problem.wanted_halves - level_target;
    found.evidence = -0.5 * (misfit + maths::log(weight)) + log_of_product(reciprocal.data(), n);
    found.angle = {problem.wanted_halves * rate + dot(reading, target, n) - rate * level_target,
                   variance - dot(target, target, n) + square(missing) / weight};
    found.scale = {dot(reading, scale, n) - rate * level_scale,
                   problem.scale.variance - dot(scale, scale, n) + square(level_scale) / weight};
    return is_finite(found.evidence) && is_finite(found.angle.mean) && found.angle.variance >= 0.0 &&
           is_finite(found.angle.variance) && is_finite(found.scale.mean) && is_finite(found.scale.variance);
}

// The variance of a half that its neighbours do not foretell: the smallest squared pivot of V. 0: V has no factor.
double smallest_pivot(const Problem& problem, Triangle factor) noexcept {
    PointValues reciprocal{};
    build(problem, nullptr, 0.0, factor);
    if (!factorise(factor, reciprocal.data(), problem.n)) return 0.0;
    double least = infinity;
    for (int a = 0; a < problem.n; ++a)
        if (square(factor.row(a)[a]) < least) least = square(factor.row(a)[a]);
    return least;
}

// Which kernel, and how large; size 0: none.
struct Candidate {
    std::size_t member = 0;
    double size = 0.0;
};

// Mean and variance of a mixture as its members come in, with weights relative to the best evidence so far (West, Comm.
// ACM 22 (1979) 532).
struct Mixture {
    Candidate likeliest{};
    double sum = 0.0;               // of the weights; 0: it is empty
    MeanVariance angle{}, scale{};  // variances times `sum`

    void add(double prior, const MemberEstimate& member, const Candidate& candidate) noexcept {
        if (member.evidence > best_evidence_) {
            const double keep = maths::exp(best_evidence_ - member.evidence);
            sum *= keep;
            largest_ *= keep;
            angle.variance *= keep;
            scale.variance *= keep;
            best_evidence_ = member.evidence;
        }
        const double weight = prior * maths::exp(member.evidence - best_evidence_);
        sum += weight;
        if (!(sum > 0.0)) return;
        take(weight, member.angle, angle);
        take(weight, member.scale, scale);
        if (!(weight > largest_)) return;
        largest_ = weight;
        likeliest = candidate;
    }

private:
    void take(double weight, const MeanVariance& of_member, MeanVariance& of_all) const noexcept {
        const double off = of_member.mean - of_all.mean;
        of_all.mean += off * (weight / sum);
        of_all.variance += weight * (of_member.variance + off * (of_member.mean - of_all.mean));
    }

    double best_evidence_ = -infinity;
    double largest_ = 0.0;  // weight
};

// The mixture of the learnt motion and of all members of the bank.
Mixture mixture_of(const Problem& problem, const Border& border, bool is_learnt, std::span<const BankMember> bank,
                   double unit, Triangle factor, Pause pause) noexcept {
    Mixture mixture;
    MemberEstimate found;
    const double of_learnt = is_learnt ? prior_of_learnt : prior_of_unknown;
    const double of_member = (1.0 - of_learnt) / static_cast<double>(bank.size() * motion_sizes.size());
    build(problem, nullptr, 0.0, factor);
    if (solve(problem, border, nullptr, 0.0, factor, found)) mixture.add(of_learnt, found, {});
    for (std::size_t b = 0; b < bank.size(); ++b) {
        const Kernel kernel{bank[b], problem.window};
        if (!kernel.is_there()) continue;
        const KernelTarget target = target_of(problem, kernel);
        for (const double size : motion_sizes) {
            if (pause != nullptr) pause();
            build(problem, &kernel, size * unit, factor);
            if (solve(problem, border, &target, size * unit, factor, found))
                mixture.add(of_member, found, {b, size * unit});
        }
    }
    return mixture;
}

// V with the kernel of the likeliest member.
void add_likeliest(const Candidate& likeliest, std::span<const BankMember> bank, Problem& problem) noexcept {
    if (!(likeliest.size > 0.0)) return;
    const Kernel kernel{bank[likeliest.member], problem.window};
    for (int r = 0; r < problem.window.n_rows; ++r)
        for (int s = 0; s <= r; ++s) problem.v.row(r)[s] += likeliest.size * kernel.at(s, r);
}

// The rows, given the angle and the variance of all of them together: one more estimate, by the covariance of the
// likeliest member, which V now has.
//
// return  false where that is not positive definite.
bool spread(const Problem& problem, Border& border, Triangle factor, SwitchEstimate& result) noexcept {
    const SwitchWindow& window = problem.window;
    const int n = problem.n;
    PointValues reciprocal{};
    build(problem, nullptr, 0.0, factor);
    if (!factorise_widened(factor, reciprocal.data(), n)) return false;
    set_target(problem, border);
    double* const target = border.target.data();
    double* const level = border.level.data();
    double* const reading = border.reading.data();
    for (double* const row : {target, level, reading}) eliminate(factor, reciprocal.data(), n, row);
    const double weight = dot(level, level, n);
    const double rate = dot(level, reading, n) / weight;
    const double of_level = dot(level, target, n);
    const double missing = problem.wanted_halves - of_level;
    const double by_mean = problem.wanted_halves * rate + dot(reading, target, n) - rate * of_level +
                           problem.wanted_halves * problem.readings.rate_arcsec + problem.known_arcsec;
    const double of_all = border.target_variance - dot(target, target, n) + missing * missing / weight;
    const double off = result.angle_arcsec - by_mean;
    PointValues with{}, with_before{};
    double missing_before = 0.0;
    double share_before = 0.0;
    int point = -1;
    for (int r = 0; r < window.n_rows; ++r) {
        const WindowRow& row = row_of(window, r);
        point += row.read;
        if (!row.wanted) continue;
        const bool follows = r > 0 && row_of(window, r - 1).wanted;
        const bool is_alike = follows && row_of(window, r - 1).read == row.read;
        double own = 0.0;
        double with_all = 0.0;
        double beside = 0.0;
        for (int a = 0; a < n; ++a)
            with[static_cast<unsigned>(a)] = row.read ? -problem.error(point, a) : problem.v.at(r, problem.row(a));
        if (row.read) {
            own = problem.error(point, point);
            if (is_alike) beside = problem.error(point, point - 1);
            for (int b = 0; b < n; ++b)
                if (problem.is_corrected(b)) with_all += problem.error(point, b);
        } else {
            own = problem.v.at(r, r);
            if (is_alike) beside = problem.v.at(r, r - 1);
            for (int s = 0; s < window.n_rows; ++s)
                if (is_bridged(row_of(window, s))) with_all += problem.v.at(r, s);
        }
        eliminate(factor, reciprocal.data(), n, with.data());
        const double halves = row.read ? 0.0 : width(row);
        const double own_level = dot(level, with.data(), n);
        const double known = row.read ? problem.readings.angle_arcsec[static_cast<unsigned>(r)]
                                      : halves * (rate + problem.readings.rate_arcsec);
        const double mean = known + dot(reading, with.data(), n) - rate * own_level;
        const double own_missing = halves - own_level;
        const double of_row = own - dot(with.data(), with.data(), n) + own_missing * own_missing / weight;
        const double common = with_all - dot(with.data(), target, n) + own_missing * missing / weight;
        const double share = of_all > 0.0 ? common / of_all : 0.0;
        const double left = of_row + share * share * (result.variance_arcsec2 - of_all);
        RowEstimate& found = result.row[static_cast<unsigned>(r)];
        found = {.angle_arcsec = mean + share * off, .variance_arcsec2 = left > 0.0 ? left : 0.0, .share = share};
        if (follows)
            found.with_before_arcsec2 = beside - dot(with.data(), with_before.data(), n) +
                                        own_missing * missing_before / weight +
                                        share * share_before * (result.variance_arcsec2 - of_all);
        with_before = with;
        missing_before = own_missing;
        share_before = share;
    }
    return true;
}

}  // namespace

SwitchEstimate estimate(const CompensationConstants& gyro, const SwitchWindow& window, const MotionMoments& motion,
                        const RelockScale& scale, EstimateRoom& room, std::span<const BankMember> bank,
                        Pause pause) noexcept {
    SwitchEstimate result{.scale = scale};
    const Triangle factor{room.factor.data()};
    Problem problem{window, scale, Triangle{room.covariance.data()}, Triangle{room.errors.data()}};
    for (int r = 0; r < window.n_rows; ++r) {
        if (!row_of(window, r).read) continue;
        problem.rows[static_cast<unsigned>(problem.n++)] = r;
        problem.n_before += !row_of(window, r).after_gap;
    }
    if (problem.n > most_window_points || problem.n - problem.n_before > most_points_after) return result;
    // Of another configuration: what is learnt is shorter.
    if (window.n_halves > motion.length * motion.step_halves) return result;
    learnt_covariance(gyro, window, motion, problem.v);
    add_errors(gyro, room, problem);
    std::construct_at(&room.factor);
    add_roundings(gyro, window, problem.readings, scale.value, problem.v);
    for (int r = 0; r < window.n_rows; ++r) {
        const WindowRow& row = row_of(window, r);
        if (is_bridged(row)) problem.wanted_halves += width(row);
        if (row.wanted && row.read) problem.known_arcsec += problem.readings.angle_arcsec[static_cast<unsigned>(r)];
    }
    Border border = border_of(problem);
    const double unit = smallest_pivot(problem, factor);
    if (!(unit > 0.0)) return result;
    const Mixture mixture = mixture_of(problem, border, motion.n_windows >= few_windows, bank, unit, factor, pause);
    if (!(mixture.sum > 0.0)) return result;
    const MeanVariance shift{mixture.scale.mean, mixture.scale.variance / mixture.sum};
    result.angle_arcsec =
        mixture.angle.mean + problem.wanted_halves * problem.readings.rate_arcsec + problem.known_arcsec;
    result.variance_arcsec2 = mixture.angle.variance / mixture.sum;
    if (square(shift.mean) <= most_shift_sq * scale.variance) {
        result.scale.value = scale.value + shift.mean;
        result.scale.variance = (shift.variance < scale.variance ? shift.variance : scale.variance) + scale_wander;
    }
    add_likeliest(mixture.likeliest, bank, problem);
    result.known = spread(problem, border, factor, result);
    return result;
}

}  // namespace zlg::core
