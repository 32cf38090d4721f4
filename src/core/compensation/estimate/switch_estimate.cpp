#include <zlg/core/compensation/switch_estimate.hpp>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"
#include "window_covariance.hpp"

namespace zlg::core {
namespace {

// Prior of the learnt motion alone: as likely as all of the bank; next to nothing before it is known from as many windows.
constexpr double prior_of_learnt = 0.5;
constexpr double prior_of_unknown = 0.05;
constexpr double few_windows = 25.0;

// What rounding leaves of a pivot, as a part of the trace: the largest sizes would fail without it.
constexpr double rounding_of_trace = 2e-15;

// The scale of chi f0 wanders from switch to switch by this variance.
constexpr double scale_wander = 1e-8;

// A shift of it beyond five standard deviations is that of damaged records.
constexpr double most_shift_sq = 25.0;

constexpr int most_members = 1 + static_cast<int>(motion_bank.size() * motion_sizes.size());

// Sum of logarithms of numbers that may be very small or large, with few logarithms.
class LogOfProduct {
public:
    void add(double x) noexcept {
        product_ *= x;
        if (product_ < 1e-200 || product_ > 1e200) fold();
    }
    [[nodiscard]] double value() noexcept {
        fold();
        return sum_;
    }

private:
    void fold() noexcept {
        sum_ += maths::log(product_);
        product_ = 1.0;
    }
    double product_ = 1.0;
    double sum_ = 0.0;
};

// The points, then the rows that border their factor.
struct Layout {
    int n = 0;                                // points
    std::array<int, most_window_rows> row{};  // of each point
    [[nodiscard]] int target() const noexcept { return n; }
    [[nodiscard]] int level() const noexcept { return n + 1; }
    [[nodiscard]] int reading() const noexcept { return n + 2; }
    [[nodiscard]] int scale() const noexcept { return n + 3; }
};

const WindowRow& row_of(const SwitchWindow& window, int r) noexcept { return window.row[static_cast<unsigned>(r)]; }

double width(const WindowRow& row) noexcept { return row.halves.last - row.halves.first; }

Layout layout_of(const SwitchWindow& window) noexcept {
    Layout layout;
    for (int r = 0; r < window.n_rows; ++r)
        if (row_of(window, r).read) layout.row[static_cast<unsigned>(layout.n++)] = r;
    return layout;
}

// Covariance of a row with what is wanted: the motion of the rows that were not read, less the errors of those that were.
double with_wanted(const SwitchWindow& window, Triangle motion, Triangle errors, int r) noexcept {
    double sum = 0.0;
    for (int s = 0; s < window.n_rows; ++s) {
        const WindowRow& row = row_of(window, s);
        if (row.wanted) sum += row.read ? -errors.at(r, s) : motion.at(r, s);
    }
    return sum;
}

bool is_bridged(const WindowRow& row) noexcept { return row.wanted && !row.read; }
bool is_corrected(const WindowRow& row) noexcept { return row.wanted && row.read; }

// What the estimate is made from: C + D R D^T and E of all rows, the readings, and the points among them.
struct Problem {
    const SwitchWindow& window;
    const RelockScale& scale;
    Triangle motion;
    Triangle errors;
    WindowReadings readings{};
    Layout layout{};
    double wanted_halves = 0.0;  // of the rows without a reading
    double known_arcsec = 0.0;   // of those with one
};

// V of the points, the row of what is wanted with its variance, and the right-hand sides.
void assemble(const Problem& problem, Triangle base) noexcept {
    const SwitchWindow& window = problem.window;
    const Layout& layout = problem.layout;
    double variance = 0.0;
    for (int r = 0; r < window.n_rows; ++r) {
        const WindowRow& row = row_of(window, r);
        for (int s = 0; s < window.n_rows; ++s) {
            if (is_bridged(row) && is_bridged(row_of(window, s))) variance += problem.motion.at(r, s);
            if (is_corrected(row) && is_corrected(row_of(window, s))) variance += problem.errors.at(r, s);
        }
    }
    for (int a = 0; a < layout.n; ++a) {
        const int r = layout.row[static_cast<unsigned>(a)];
        for (int b = 0; b <= a; ++b) {
            const int s = layout.row[static_cast<unsigned>(b)];
            base.row(a)[b] = problem.motion.row(r)[s] + problem.errors.row(r)[s];
        }
        const double halves = width(row_of(window, r));
        const auto at = static_cast<unsigned>(r);
        base.row(layout.target())[a] = with_wanted(window, problem.motion, problem.errors, r);
        base.row(layout.level())[a] = halves;
        base.row(layout.reading())[a] = problem.readings.angle_arcsec[at] - halves * problem.readings.rate_arcsec;
        base.row(layout.scale())[a] = -problem.scale.variance * problem.readings.false_arcsec[at];
    }
    base.row(layout.target())[layout.n] = variance;
}

// Where a member walks in this window.
Walk walk_of(const BankMember& member, const SwitchWindow& window) noexcept {
    switch (member.place) {
        case WalkPlace::beside:
            return {member.kind, window.gap.first - member.halves, window.gap.last + member.halves};
        case WalkPlace::after:
            return {member.kind, window.gap.last + member.halves, window.n_halves};
        case WalkPlace::everywhere:
            break;
    }
    return {member.kind, 0, window.n_halves};
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

// K of a member, as large as its unit.
class Kernel {
public:
    Kernel(const BankMember& member, const SwitchWindow& window) noexcept
        : both_ways_{member.place == WalkPlace::everywhere} {
        const Walk walk = walk_of(member, window);
        const double unit = unit_of(member, walk, window);
        if (!(unit > 0.0)) return;
        part_ = both_ways_ ? 0.5 / unit : 1.0 / unit;
        for (int r = 0; r < window.n_rows; ++r) {
            const Stretch& halves = row_of(window, r).halves;
            forward_[static_cast<unsigned>(r)] = walked(walk, halves);
            if (both_ways_) backward_[static_cast<unsigned>(r)] = walked(walk, reversed(window, halves));
        }
    }

    // False: it does not walk in this window.
    [[nodiscard]] bool is_there() const noexcept { return part_ > 0.0; }

    // Of two rows.
    [[nodiscard]] double at(int r, int s) const noexcept {
        const auto early = static_cast<unsigned>(r < s ? r : s);
        const auto late = static_cast<unsigned>(r < s ? s : r);
        double k = r == s ? forward_[late].variance : covariance(forward_[early], forward_[late]);
        if (both_ways_) k += r == s ? backward_[late].variance : covariance(backward_[late], backward_[early]);
        return part_ * k;
    }

private:
    bool both_ways_ = false;
    double part_ = 0.0;
    std::array<WalkedStretch, most_window_rows> forward_;
    std::array<WalkedStretch, most_window_rows> backward_;
};

// The kernel of the points, and its row of what is wanted with the variance.
void lay_out(const Kernel& kernel, const SwitchWindow& window, const Layout& layout, Triangle into) noexcept {
    double* const target = into.row(layout.target());
    target[layout.n] = 0.0;
    for (int a = 0; a < layout.n; ++a) {
        const int r = layout.row[static_cast<unsigned>(a)];
        for (int b = 0; b <= a; ++b) into.row(a)[b] = kernel.at(r, layout.row[static_cast<unsigned>(b)]);
        target[a] = 0.0;
        for (int u = 0; u < window.n_rows; ++u)
            if (is_bridged(row_of(window, u))) target[a] += kernel.at(u, r);
    }
    for (int u = 0; u < window.n_rows; ++u)
        for (int w = 0; w < window.n_rows; ++w)
            if (is_bridged(row_of(window, u)) && is_bridged(row_of(window, w))) target[layout.n] += kernel.at(u, w);
}

// What one member says.
struct MemberEstimate {
    double evidence = 0.0;  // logarithm of its restricted likelihood
    double angle_arcsec = 0.0;
    double variance_arcsec2 = 0.0;
    double scale = 0.0;  // shift of the scale of chi f0
    double scale_variance = 0.0;
};

// Generalised least squares with an unknown level, by one factor.
//
// factor  V_m and its border, as `assemble` lays them out; of no use after.
// return  false where V_m is not positive definite.
bool solve(const Layout& layout, double wanted_halves, double scale_variance, Triangle factor,
           MemberEstimate& found) noexcept {
    const int n = layout.n;
    std::array<double, most_window_rows> reciprocal{};
    double trace = 0.0;
    for (int a = 0; a < n; ++a) trace += factor.row(a)[a];
    for (int a = 0; a < n; ++a) factor.row(a)[a] += rounding_of_trace * trace;
    const double variance = factor.row(n)[n];
    if (!factorise(factor, reciprocal.data(), n)) return false;
    double* const target = factor.row(layout.target());
    double* const level = factor.row(layout.level());
    double* const reading = factor.row(layout.reading());
    double* const scale = factor.row(layout.scale());
    for (double* const row : {target, level, reading, scale}) eliminate(factor, reciprocal.data(), n, row);
    const double weight = dot(level, level, n);
    const double rate = dot(level, reading, n) / weight;
    const double level_target = dot(level, target, n);
    const double level_scale = dot(level, scale, n);
    LogOfProduct pivots;
    for (int a = 0; a < n; ++a) pivots.add(reciprocal[static_cast<unsigned>(a)]);
    const double misfit = dot(reading, reading, n) - rate * rate * weight;
    found.evidence = -0.5 * (misfit + maths::log(weight)) + pivots.value();
    found.angle_arcsec = wanted_halves * rate + dot(reading, target, n) - rate * level_target;
    found.variance_arcsec2 = variance - dot(target, target, n) + square(wanted_halves - level_target) / weight;
    found.scale = dot(reading, scale, n) - rate * level_scale;
    found.scale_variance = scale_variance - dot(scale, scale, n) + square(level_scale) / weight;
    return is_finite(found.evidence) && is_finite(found.angle_arcsec) && found.variance_arcsec2 >= 0.0 &&
           is_finite(found.variance_arcsec2) && is_finite(found.scale) && is_finite(found.scale_variance);
}

// Mean and variance of a mixture.
struct Moments2 {
    double mean = 0.0;
    double variance = 0.0;
};

class Mixture {
public:
    void add(double prior, const MemberEstimate& member) noexcept {
        member_[static_cast<unsigned>(n_)] = member;
        weight_[static_cast<unsigned>(n_++)] = prior;
    }
    [[nodiscard]] int size() const noexcept { return n_; }

    // Priors become weights, by the evidence.
    void weigh() noexcept {
        double best = -infinity;
        for (int m = 0; m < n_; ++m)
            if (member_[static_cast<unsigned>(m)].evidence > best) best = member_[static_cast<unsigned>(m)].evidence;
        double sum = 0.0;
        for (unsigned m = 0; m < static_cast<unsigned>(n_); ++m)
            sum += weight_[m] *= maths::exp(member_[m].evidence - best);
        for (double& weight : weight_) weight /= sum;
    }
    // The member of the largest weight.
    [[nodiscard]] int best() const noexcept {
        int found = 0;
        for (int m = 1; m < n_; ++m)
            if (weight(m) > weight(found)) found = m;
        return found;
    }
    // Of the member that was added as the m-th.
    [[nodiscard]] double weight(int m) const noexcept { return weight_[static_cast<unsigned>(m)]; }

    [[nodiscard]] Moments2 of(double MemberEstimate::*mean, double MemberEstimate::*variance) const noexcept {
        Moments2 result;
        for (int m = 0; m < n_; ++m) result.mean += weight(m) * (member_[static_cast<unsigned>(m)].*mean);
        for (int m = 0; m < n_; ++m) {
            const MemberEstimate& member = member_[static_cast<unsigned>(m)];
            result.variance += weight(m) * (member.*variance + square(member.*mean - result.mean));
        }
        return result;
    }

private:
    int n_ = 0;
    std::array<double, most_members> weight_{};
    std::array<MemberEstimate, most_members> member_{};
};

// V_m and its border: the base, and the kernel as large as this.
void build(const Layout& layout, Triangle base, Triangle kernel, double size, Triangle into) noexcept {
    const double* const from = base.row(0);
    double* const to = into.row(0);
    const std::size_t with_target = triangle_size(layout.n + 1);
    const std::size_t all = triangle_size(layout.n + 4);
    if (size > 0.0) {
        const double* const more = kernel.row(0);
        for (std::size_t k = 0; k < with_target; ++k) to[k] = from[k] + size * more[k];
    } else {
        for (std::size_t k = 0; k < with_target; ++k) to[k] = from[k];
    }
    for (std::size_t k = with_target; k < all; ++k) to[k] = from[k];
}

// The variance of a half that its neighbours do not foretell: the smallest squared pivot of V. 0: V has no factor.
double smallest_pivot(const Layout& layout, Triangle base, Triangle factor) noexcept {
    std::array<double, most_window_rows> reciprocal{};
    build(layout, base, base, 0.0, factor);
    if (!factorise(factor, reciprocal.data(), layout.n)) return 0.0;
    double least = infinity;
    for (int a = 0; a < layout.n; ++a)
        if (square(factor.row(a)[a]) < least) least = square(factor.row(a)[a]);
    return least;
}

// Which kernel, and how large: of each member of the mixture after the first.
struct Candidate {
    std::size_t kernel = 0;
    double size = 0.0;
};

// The rows, given the angle and the variance of all of them together: one more estimate, by the covariance of the likeliest member.
//
// base    V of that covariance, and its border
// motion  of `problem`: the kernel of that member is in it, too
void spread(const Problem& problem, Triangle base, Triangle factor, SwitchEstimate& result) noexcept {
    const Layout& layout = problem.layout;
    const SwitchWindow& window = problem.window;
    std::array<double, most_window_rows> reciprocal{};
    build(layout, base, base, 0.0, factor);
    const int n = layout.n;
    if (!factorise(factor, reciprocal.data(), n)) return;
    double* const target = factor.row(layout.target());
    double* const level = factor.row(layout.level());
    double* const reading = factor.row(layout.reading());
    const double variance = target[n];
    for (double* const row : {target, level, reading}) eliminate(factor, reciprocal.data(), n, row);
    const double weight = dot(level, level, n);
    const double rate = dot(level, reading, n) / weight;
    const double of_level = dot(level, target, n);
    const double missing = problem.wanted_halves - of_level;
    const double by_mean = problem.wanted_halves * rate + dot(reading, target, n) - rate * of_level +
                           problem.wanted_halves * problem.readings.rate_arcsec + problem.known_arcsec;
    const double of_all = variance - dot(target, target, n) + missing * missing / weight;
    const double off = result.angle_arcsec - by_mean;
    for (int r = 0; r < window.n_rows; ++r) {
        const WindowRow& row = row_of(window, r);
        if (!row.wanted) continue;
        std::array<double, most_window_rows> with{};
        for (int a = 0; a < n; ++a) {
            const int s = layout.row[static_cast<unsigned>(a)];
            with[static_cast<unsigned>(a)] = row.read ? -problem.errors.at(r, s) : problem.motion.at(r, s);
        }
        double with_all = 0.0;
        for (int s = 0; s < window.n_rows; ++s) {
            if (row.read && is_corrected(row_of(window, s))) with_all += problem.errors.at(r, s);
            if (!row.read && is_bridged(row_of(window, s))) with_all += problem.motion.at(r, s);
        }
        eliminate(factor, reciprocal.data(), n, with.data());
        const double halves = row.read ? 0.0 : width(row);
        const double own_level = dot(level, with.data(), n);
        const double known = row.read ? problem.readings.angle_arcsec[static_cast<unsigned>(r)]
                                      : halves * (rate + problem.readings.rate_arcsec);
        const double mean = known + dot(reading, with.data(), n) - rate * own_level;
        const double own_missing = halves - own_level;
        const double of_row = (row.read ? problem.errors.at(r, r) : problem.motion.at(r, r)) -
                              dot(with.data(), with.data(), n) + own_missing * own_missing / weight;
        const double common = with_all - dot(with.data(), target, n) + own_missing * missing / weight;
        const double share = of_all > 0.0 ? common / of_all : 0.0;
        result.row[static_cast<unsigned>(r)].share = share;
        result.row[static_cast<unsigned>(r)].angle_arcsec = mean + share * off;
        const double left = of_row + share * share * (result.variance_arcsec2 - of_all);
        result.row[static_cast<unsigned>(r)].variance_arcsec2 = left > 0.0 ? left : 0.0;
    }
}

}  // namespace

SwitchEstimate estimate(const CompensationConstants& gyro, const SwitchWindow& window, const MotionMoments& motion,
                        const RelockScale& scale, EstimateRoom& room, std::span<const BankMember> bank) noexcept {
    const Triangle base{room.base.data()};
    const Triangle kernel_of_points{room.kernel.data()};
    const Triangle factor{room.factor.data()};
    Problem problem{window, scale, Triangle{room.motion.data()}, Triangle{room.errors.data()}};
    problem.layout = layout_of(window);
    const Layout& layout = problem.layout;
    learnt_covariance(gyro, window, motion, problem.motion, factor);
    error_covariance(gyro, window, scale, problem.readings, problem.errors);
    rounding_covariance(gyro, window, problem.readings, scale.value, problem.motion, problem.errors, factor);
    for (std::size_t k = 0; k < triangle_size(window.n_rows); ++k) room.motion[k] += room.factor[k];
    for (int r = 0; r < window.n_rows; ++r) {
        const WindowRow& row = row_of(window, r);
        if (is_bridged(row)) problem.wanted_halves += width(row);
        if (is_corrected(row)) problem.known_arcsec += problem.readings.angle_arcsec[static_cast<unsigned>(r)];
    }
    assemble(problem, base);

    SwitchEstimate result{.scale = scale};
    const double unit = smallest_pivot(layout, base, factor);
    if (!(unit > 0.0)) return result;
    Mixture mixture;
    MemberEstimate found;
    std::array<Candidate, most_members> candidate{};
    const double of_learnt = motion.n_windows >= few_windows ? prior_of_learnt : prior_of_unknown;
    const double of_member = (1.0 - of_learnt) / static_cast<double>(bank.size() * motion_sizes.size());
    build(layout, base, base, 0.0, factor);
    const double added = problem.wanted_halves * problem.readings.rate_arcsec + problem.known_arcsec;
    if (solve(layout, problem.wanted_halves, scale.variance, factor, found)) mixture.add(of_learnt, found);
    for (std::size_t b = 0; b < bank.size(); ++b) {
        const Kernel kernel{bank[b], window};
        if (!kernel.is_there()) continue;
        lay_out(kernel, window, layout, kernel_of_points);
        for (const double size : motion_sizes) {
            build(layout, base, kernel_of_points, size * unit, factor);
            if (!solve(layout, problem.wanted_halves, scale.variance, factor, found)) continue;
            candidate[static_cast<unsigned>(mixture.size())] = {b, size * unit};
            mixture.add(of_member, found);
        }
    }
    if (mixture.size() == 0) return result;
    mixture.weigh();
    const Moments2 angle = mixture.of(&MemberEstimate::angle_arcsec, &MemberEstimate::variance_arcsec2);
    const Moments2 shift = mixture.of(&MemberEstimate::scale, &MemberEstimate::scale_variance);
    result.known = true;
    result.angle_arcsec = angle.mean + added;
    result.variance_arcsec2 = angle.variance;
    if (square(shift.mean) <= most_shift_sq * scale.variance) {
        result.scale.value = scale.value + shift.mean;
        result.scale.variance = (shift.variance < scale.variance ? shift.variance : scale.variance) + scale_wander;
    }

    const Candidate& best = candidate[static_cast<unsigned>(mixture.best())];
    if (best.size > 0.0) {
        const Kernel kernel{bank[best.kernel], window};
        for (int r = 0; r < window.n_rows; ++r)
            for (int s = 0; s <= r; ++s) problem.motion.row(r)[s] += best.size * kernel.at(r, s);
    }
    assemble(problem, base);
    spread(problem, base, factor, result);
    return result;
}

}  // namespace zlg::core
