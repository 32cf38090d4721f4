#include <zlg/core/compensation/switch_estimate.hpp>

#include <memory>

#include <zlg/core/common/maths.hpp>

#include "bank_kernel.hpp"
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

// One number for each point.
using PointValues = std::array<double, most_window_points>;

struct MeanVariance {
    double mean = 0.0;
    double variance = 0.0;
};

// A number that is asked for, before anything was read.
struct Target {
    double halves = 0.0;  // so many times the unknown rate is in it
    double variance = 0.0;
    PointValues with{};  // covariance with the points

    void add(double size, const Target& other) noexcept {
        halves += size * other.halves;
        variance += size * other.variance;
        for (std::size_t a = 0; a < with.size(); ++a) with[a] += size * other.with[a];
    }
};

// What the estimate is made from.
struct Problem {
    const SwitchWindow& window;
    const RelockScale& scale;
    Triangle v;       // V of all rows
    Triangle errors;  // E of the points after the gap
    WindowReadings readings{};
    int n = 0;                                     // points
    std::array<int, most_window_rows> rows{};      // of each
    std::array<int, most_window_rows> point_of{};  // of each row that was read
    int n_before = 0;                              // points before the gap
    PointValues level{}, reading{};                // halves of each point, and its angle about the mean rate

    void number_points() noexcept {
        for (int r = 0; r < window.n_rows; ++r) {
            if (!row_of(window, r).read) continue;
            n_before += !row_of(window, r).after_gap;
            point_of[static_cast<unsigned>(r)] = n;
            rows[static_cast<unsigned>(n++)] = r;
        }
    }
    // Of a point after the gap with another point: what the error of a reading before the gap is has nothing to do with
    // it.
    [[nodiscard]] double error(int a, int b) const noexcept {
        return a < n_before || b < n_before ? 0.0 : errors.at(a - n_before, b - n_before);
    }
    [[nodiscard]] int row(int point) const noexcept { return rows[static_cast<unsigned>(point)]; }
    [[nodiscard]] int point(int row) const noexcept { return point_of[static_cast<unsigned>(row)]; }

    // Covariance of what is wanted of two rows: the motion of one that was not read, the error of one that was.
    [[nodiscard]] double wanted(int r, int s) const noexcept {
        const bool read = row_of(window, r).read;
        if (read != row_of(window, s).read) return 0.0;
        return read ? error(point(r), point(s)) : v.at(r, s);
    }
    // The angle of a row that is wanted: of motion that was not read, less the error of what was.
    [[nodiscard]] Target target(int r) const noexcept {
        const WindowRow& row = row_of(window, r);
        Target target{.halves = row.read ? 0.0 : width(row), .variance = wanted(r, r)};
        for (int a = 0; a < n; ++a)
            target.with[static_cast<unsigned>(a)] =
                row.read ? -error(point(r), a) : v.at(r, rows[static_cast<unsigned>(a)]);
        return target;
    }
    // What is known of it beside that.
    [[nodiscard]] double known_arcsec(int r) const noexcept {
        const WindowRow& row = row_of(window, r);
        return row.read ? readings.angle_arcsec[static_cast<unsigned>(r)] : width(row) * readings.rate_arcsec;
    }
    [[nodiscard]] double known_arcsec() const noexcept {
        double sum = 0.0;
        for (int r = 0; r < window.n_rows; ++r)
            if (row_of(window, r).wanted) sum += known_arcsec(r);
        return sum;
    }
    // Covariance of a row with all that is wanted.
    [[nodiscard]] double with_all(int r) const noexcept {
        double sum = 0.0;
        for (int s = 0; s < window.n_rows; ++s)
            if (row_of(window, s).wanted) sum += wanted(r, s);
        return sum;
    }
    // The angle of all that is wanted.
    [[nodiscard]] Target target() const noexcept {
        Target all;
        for (int r = 0; r < window.n_rows; ++r) {
            if (!row_of(window, r).wanted) continue;
            all.add(1.0, target(r));
            for (int s = 0; s < r; ++s)
                if (row_of(window, s).wanted) all.variance += 2.0 * wanted(r, s);
        }
        return all;
    }
    // What a kernel adds to it.
    [[nodiscard]] Target target(const BankKernel& kernel) const noexcept {
        Target sum;
        for (int u = 0; u < window.n_rows; ++u) {
            if (!is_bridged(row_of(window, u))) continue;
            for (int a = 0; a < n; ++a) sum.with[static_cast<unsigned>(a)] += kernel.at(u, row(a));
            for (int w = 0; w < window.n_rows; ++w)
                if (is_bridged(row_of(window, w))) sum.variance += kernel.at(u, w);
        }
        return sum;
    }
    // V of the points.
    void copy_points(Triangle into) const noexcept {
        for (int a = 0; a < n; ++a)
            for (int b = 0; b <= a; ++b) into.row(a)[b] = v.row(row(a))[row(b)];
    }
};

// E, and with it C + E of the points.
void add_errors(const CompensationConstants& gyro, EstimateRoom& room, Problem& p) noexcept {
    const ReadingErrors e{gyro, p.window, p.scale, room.halves, p.readings};
    for (int a = 0; a < p.n; ++a) {
        for (int b = 0; b <= a; ++b) {
            const double error = e.of(p.row(a), p.row(b));
            p.v.row(p.row(a))[p.row(b)] += error;
            if (b >= p.n_before) p.errors.row(a - p.n_before)[b - p.n_before] = error;
        }
        const auto at = static_cast<unsigned>(a);
        p.level[at] = width(row_of(p.window, p.row(a)));
        p.reading[at] = p.readings.angle_arcsec[static_cast<unsigned>(p.row(a))] - p.level[at] * p.readings.rate_arcsec;
    }
}

// Generalised least squares with an unknown level, by one factor.
class Regression {
public:
    // factor  V of the points; receives its factor.
    Regression(const Problem& p, Triangle factor) noexcept
        : n_{p.n}, factor_{factor}, level_{p.level}, reading_{p.reading} {
        double trace = 0.0;
        for (int a = 0; a < n_; ++a) trace += factor.row(a)[a];
        for (int a = 0; a < n_; ++a) factor.row(a)[a] += rounding_of_trace * trace;
        is_known_ = factorise(factor, reciprocal_.data(), n_);
        if (!is_known_) return;
        eliminate(factor, reciprocal_.data(), n_, level_.data());
        eliminate(factor, reciprocal_.data(), n_, reading_.data());
        weight_ = dot(level_.data(), level_.data(), n_);
        rate_ = dot(level_.data(), reading_.data(), n_) / weight_;
    }

    // False: V is not positive definite.
    [[nodiscard]] bool is_known() const noexcept { return is_known_; }

    // Logarithm of the restricted likelihood.
    [[nodiscard]] double evidence() const noexcept {
        const double misfit = dot(reading_.data(), reading_.data(), n_) - rate_ * rate_ * weight_;
        return -0.5 * (misfit + maths::log(weight_)) + log_of_product(reciprocal_.data(), n_);
    }

    // As the two below need it: what of the halves the points do not hold, and the covariances by the factor.
    void reduce(Target& t) const noexcept {
        eliminate(factor_, reciprocal_.data(), n_, t.with.data());
        t.halves -= dot(level_.data(), t.with.data(), n_);
    }
    [[nodiscard]] double mean(const Target& t) const noexcept {
        return t.halves * rate_ + dot(reading_.data(), t.with.data(), n_);
    }
    // prior  covariance before anything was read.
    [[nodiscard]] double covariance(double prior, const Target& t, const Target& u) const noexcept {
        return prior - dot(t.with.data(), u.with.data(), n_) + t.halves * u.halves / weight_;
    }
    [[nodiscard]] MeanVariance of(Target t) const noexcept {
        reduce(t);
        return {mean(t), covariance(t.variance, t, t)};
    }

private:
    int n_;
    Triangle factor_;
    PointValues reciprocal_{}, level_, reading_;
    bool is_known_ = false;
    double weight_ = 0.0;
    double rate_ = 0.0;
};

// What one member says.
struct MemberEstimate {
    double evidence = 0.0;  // logarithm of its restricted likelihood
    MeanVariance angle{};   // arcsec, arcsec^2
    MeanVariance scale{};   // shift of the scale of chi f0

    [[nodiscard]] bool is_possible() const noexcept {
        return is_finite(evidence + angle.mean + angle.variance + scale.mean + scale.variance) && angle.variance >= 0.0;
    }
};

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
        if (!member.is_possible()) return;
        if (member.evidence > best_evidence_) {
            const double keep = maths::exp(best_evidence_ - member.evidence);
            for (double* const x : {&sum, &largest_, &angle.variance, &scale.variance}) *x *= keep;
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
//
// unit  of their sizes.
Mixture mixture_of(const Problem& problem, const Target& all, bool is_learnt, std::span<const BankMember> bank,
                   double unit, Triangle factor, Pause pause) noexcept {
    Mixture mixture;
    Target scale{.variance = problem.scale.variance};
    for (int a = 0; a < problem.n; ++a)
        scale.with[static_cast<unsigned>(a)] =
            -problem.scale.variance * problem.readings.false_arcsec[static_cast<unsigned>(problem.row(a))];
    // factor  holds V of the points.
    const auto add = [&](double prior, const Target& angle, const Candidate& candidate) {
        const Regression points{problem, factor};
        if (points.is_known()) mixture.add(prior, {points.evidence(), points.of(angle), points.of(scale)}, candidate);
    };
    const double of_learnt = is_learnt ? prior_of_learnt : prior_of_unknown;
    const double of_member = (1.0 - of_learnt) / static_cast<double>(bank.size() * motion_sizes.size());
    problem.copy_points(factor);
    add(of_learnt, all, {});
    for (std::size_t b = 0; b < bank.size(); ++b) {
        const BankKernel kernel{bank[b], problem.window};
        if (!kernel.is_there()) continue;
        const Target walked = problem.target(kernel);
        for (const double size : motion_sizes) {
            if (pause != nullptr) pause();
            kernel.add({problem.rows.data(), static_cast<std::size_t>(problem.n)}, problem.v, size * unit, factor);
            Target angle = all;
            angle.add(size * unit, walked);
            add(of_member, angle, {b, size * unit});
        }
    }
    return mixture;
}

// The variance of a half that its neighbours do not foretell: the smallest squared pivot of V. 0: V has no factor.
double smallest_pivot(const Problem& problem, Triangle factor) noexcept {
    PointValues reciprocal{};
    problem.copy_points(factor);
    if (!factorise(factor, reciprocal.data(), problem.n)) return 0.0;
    double least = infinity;
    for (int a = 0; a < problem.n; ++a)
        if (square(factor.row(a)[a]) < least) least = square(factor.row(a)[a]);
    return least;
}

// V with the kernel of the likeliest member.
void add_likeliest(const Candidate& likeliest, std::span<const BankMember> bank, Problem& problem) noexcept {
    if (!(likeliest.size > 0.0)) return;
    std::array<int, most_window_rows> all{};
    for (int r = 0; r < problem.window.n_rows; ++r) all[static_cast<unsigned>(r)] = r;
    const BankKernel kernel{bank[likeliest.member], problem.window};
    kernel.add({all.data(), static_cast<std::size_t>(problem.window.n_rows)}, problem.v, likeliest.size, problem.v);
}

// The rows, given the angle and the variance of all of them together: one more estimate, by the covariance of the
// likeliest member, which V now has.
//
// return  false where that is not positive definite.
bool spread(const Problem& problem, Triangle factor, SwitchEstimate& result) noexcept {
    const SwitchWindow& window = problem.window;
    problem.copy_points(factor);
    const Regression points{problem, factor};
    if (!points.is_known()) return false;
    Target all = problem.target();
    points.reduce(all);
    const double of_all = points.covariance(all.variance, all, all);
    const double off = result.angle_arcsec - points.mean(all) - problem.known_arcsec();
    const double beyond = result.variance_arcsec2 - of_all;
    Target before;
    for (int r = 0; r < window.n_rows; ++r) {
        if (!row_of(window, r).wanted) continue;
        Target row = problem.target(r);
        points.reduce(row);
        RowEstimate& found = result.row[static_cast<unsigned>(r)];
        found.share = of_all > 0.0 ? points.covariance(problem.with_all(r), row, all) / of_all : 0.0;
        found.angle_arcsec = problem.known_arcsec(r) + points.mean(row) + found.share * off;
        const double variance = points.covariance(row.variance, row, row) + square(found.share) * beyond;
        found.variance_arcsec2 = variance > 0.0 ? variance : 0.0;
        if (r > 0 && row_of(window, r - 1).wanted)
            found.with_before_arcsec2 = points.covariance(problem.wanted(r, r - 1), row, before) +
                                        found.share * result.row[static_cast<unsigned>(r - 1)].share * beyond;
        before = row;
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
    problem.number_points();
    if (problem.n > most_window_points || problem.n - problem.n_before > most_points_after) return result;
    // Of another configuration: what is learnt is shorter.
    if (window.n_halves > motion.length * motion.step_halves) return result;
    learnt_covariance(gyro, window, motion, problem.v);
    add_errors(gyro, room, problem);
    std::construct_at(&room.factor);
    add_roundings(gyro, window, problem.readings, scale.value, problem.v);
    const double unit = smallest_pivot(problem, factor);
    if (!(unit > 0.0)) return result;
    const bool is_learnt = motion.n_windows >= few_windows;
    const Mixture mixture = mixture_of(problem, problem.target(), is_learnt, bank, unit, factor, pause);
    if (!(mixture.sum > 0.0)) return result;
    result.angle_arcsec = mixture.angle.mean + problem.known_arcsec();
    result.variance_arcsec2 = mixture.angle.variance / mixture.sum;
    if (square(mixture.scale.mean) <= most_shift_sq * scale.variance) {
        const double variance = mixture.scale.variance / mixture.sum;
        result.scale.value = scale.value + mixture.scale.mean;
        result.scale.variance = (variance < scale.variance ? variance : scale.variance) + scale_wander;
    }
    add_likeliest(mixture.likeliest, bank, problem);
    result.known = spread(problem, factor, result);
    return result;
}

}  // namespace zlg::core
