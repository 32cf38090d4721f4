#include "switch_estimate.hpp"

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
    int n = 0;                                     // points
    std::array<int, most_window_rows> row{};       // of each point
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

// V of the points, the row of what is wanted with its variance, and the right-hand sides, in place of E.
void assemble(const SwitchWindow& window, const Layout& layout, const WindowReadings& readings,
              const RelockScale& scale, Triangle motion, Triangle base) noexcept {
    std::array<double, most_window_rows> wanted{};
    double variance = 0.0;
    for (int r = 0; r < window.n_rows; ++r) {
        const WindowRow& row = row_of(window, r);
        const double with = with_wanted(window, motion, base, r);
        wanted[static_cast<unsigned>(r)] = with;
        if (row.wanted && !row.read) variance += with;
    }
    for (int r = 0; r < window.n_rows; ++r)
        for (int s = 0; s < window.n_rows; ++s)
            if (row_of(window, r).wanted && row_of(window, s).wanted && row_of(window, r).read &&
                row_of(window, s).read)
                variance += base.at(r, s);
    for (int a = 0; a < layout.n; ++a) {
        const int r = layout.row[static_cast<unsigned>(a)];
        for (int b = 0; b <= a; ++b) {
            const int s = layout.row[static_cast<unsigned>(b)];
            base.row(a)[b] = motion.row(r)[s] + base.row(r)[s];
        }
    }
    for (int a = 0; a < layout.n; ++a) {
        const auto r = static_cast<unsigned>(layout.row[static_cast<unsigned>(a)]);
        const double halves = width(window.row[r]);
        base.row(layout.target())[a] = wanted[r];
        base.row(layout.level())[a] = halves;
        base.row(layout.reading())[a] = readings.angle_arcsec[r] - halves * readings.rate_arcsec;
        base.row(layout.scale())[a] = -scale.variance * readings.false_arcsec[r];
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

// K of a member, as large as its unit: the points, and the row of what is wanted with its variance. False: it does not walk here.
bool find_kernel(const BankMember& member, const SwitchWindow& window, const Layout& layout, Triangle kernel) noexcept {
    const Walk walk = walk_of(member, window);
    const double unit = unit_of(member, walk, window);
    if (!(unit > 0.0)) return false;
    const bool both_ways = member.place == WalkPlace::everywhere;
    const double part = both_ways ? 0.5 / unit : 1.0 / unit;
    std::array<WalkedStretch, most_window_rows> forward;
    std::array<WalkedStretch, most_window_rows> backward;
    for (int r = 0; r < window.n_rows; ++r) {
        const Stretch& halves = row_of(window, r).halves;
        forward[static_cast<unsigned>(r)] = walked(walk, halves);
        if (both_ways) backward[static_cast<unsigned>(r)] = walked(walk, reversed(window, halves));
    }
    // Rows are in order of time: `later` may be the same as `earlier`.
    const auto of_rows = [&](int later, int earlier) {
        const auto l = static_cast<unsigned>(later);
        const auto e = static_cast<unsigned>(earlier);
        double k = l == e ? forward[l].variance : covariance(forward[e], forward[l]);
        if (both_ways) k += l == e ? backward[l].variance : covariance(backward[l], backward[e]);
        return part * k;
    };
    for (int a = 0; a < layout.n; ++a) {
        const int r = layout.row[static_cast<unsigned>(a)];
        for (int b = 0; b <= a; ++b) kernel.row(a)[b] = of_rows(r, layout.row[static_cast<unsigned>(b)]);
    }
    double* const target = kernel.row(layout.target());
    for (int a = 0; a <= layout.n; ++a) target[a] = 0.0;
    for (int u = 0; u < window.n_rows; ++u) {
        if (!row_of(window, u).wanted || row_of(window, u).read) continue;
        for (int a = 0; a < layout.n; ++a) {
            const int r = layout.row[static_cast<unsigned>(a)];
            target[a] += u > r ? of_rows(u, r) : of_rows(r, u);
        }
        for (int w = 0; w < window.n_rows; ++w)
            if (row_of(window, w).wanted && !row_of(window, w).read) target[layout.n] += u > w ? of_rows(u, w) : of_rows(w, u);
    }
    return true;
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
        auto& entry = member_[static_cast<unsigned>(n_)];
        entry = member;
        prior_[static_cast<unsigned>(n_++)] = prior;
        if (n_ == 1 || member.evidence > best_) best_ = member.evidence;
    }
    [[nodiscard]] int size() const noexcept { return n_; }
    [[nodiscard]] Moments2 of(double MemberEstimate::*mean, double MemberEstimate::*variance) const noexcept {
        double sum = 0.0;
        Moments2 result;
        for (int m = 0; m < n_; ++m) {
            sum += weight(m);
            result.mean += weight(m) * (member_[static_cast<unsigned>(m)].*mean);
        }
        result.mean /= sum;
        for (int m = 0; m < n_; ++m) {
            const MemberEstimate& member = member_[static_cast<unsigned>(m)];
            result.variance += weight(m) / sum * (member.*variance + square(member.*mean - result.mean));
        }
        return result;
    }

private:
    [[nodiscard]] double weight(int m) const noexcept {
        return prior_[static_cast<unsigned>(m)] * maths::exp(member_[static_cast<unsigned>(m)].evidence - best_);
    }
    int n_ = 0;
    double best_ = 0.0;
    std::array<double, most_members> prior_{};
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

}  // namespace

SwitchEstimate estimate(const CompensationConstants& gyro, const SwitchWindow& window, const MotionMoments& motion,
                        const RelockScale& scale, EstimateRoom& room, std::span<const BankMember> bank) noexcept {
    const Triangle covariance{room.motion.data()};
    const Triangle base{room.base.data()};
    const Triangle factor{room.factor.data()};
    const Layout layout = layout_of(window);
    WindowReadings readings;
    learnt_covariance(gyro, window, motion, covariance, factor);
    error_covariance(gyro, window, scale, readings, base);
    rounding_covariance(gyro, window, readings, scale.value, covariance, base, factor);
    for (std::size_t k = 0; k < triangle_size(window.n_rows); ++k) room.motion[k] += room.factor[k];
    assemble(window, layout, readings, scale, covariance, base);

    SwitchEstimate result{.scale = scale};
    const double unit = smallest_pivot(layout, base, factor);
    if (!(unit > 0.0)) return result;
    double wanted_halves = 0.0;
    double known_arcsec = 0.0;
    for (int r = 0; r < window.n_rows; ++r) {
        const WindowRow& row = row_of(window, r);
        if (row.wanted && !row.read) wanted_halves += width(row);
        if (row.wanted && row.read) known_arcsec += readings.angle_arcsec[static_cast<unsigned>(r)];
    }
    Mixture mixture;
    MemberEstimate found;
    const double of_learnt = motion.n_windows >= few_windows ? prior_of_learnt : prior_of_unknown;
    const double of_member = (1.0 - of_learnt) / static_cast<double>(bank.size() * motion_sizes.size());
    build(layout, base, base, 0.0, factor);
    if (solve(layout, wanted_halves, scale.variance, factor, found)) mixture.add(of_learnt, found);
    for (const BankMember& member : bank) {
        if (!find_kernel(member, window, layout, covariance)) continue;
        for (const double size : motion_sizes) {
            build(layout, base, covariance, size * unit, factor);
            if (solve(layout, wanted_halves, scale.variance, factor, found)) mixture.add(of_member, found);
        }
    }
    if (mixture.size() == 0) return result;
    const Moments2 angle = mixture.of(&MemberEstimate::angle_arcsec, &MemberEstimate::variance_arcsec2);
    const Moments2 shift = mixture.of(&MemberEstimate::scale, &MemberEstimate::scale_variance);
    result.known = true;
    result.angle_arcsec = angle.mean + wanted_halves * readings.rate_arcsec + known_arcsec;
    result.variance_arcsec2 = angle.variance;
    result.scale.value = scale.value + shift.mean;
    result.scale.variance = (shift.variance < scale.variance ? shift.variance : scale.variance) + scale_wander;
    return result;
}

}  // namespace zlg::core
