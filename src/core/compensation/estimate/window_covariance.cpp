#include "window_covariance.hpp"

#include <zlg/core/common/maths.hpp>
#include <zlg/core/compensation/border.hpp>

#include "common/bounds.hpp"
#include "counter_rounding.hpp"

namespace zlg::core {
namespace {

// Shares of the roundings in the learnt moments that are tried. Where the roundings repeat, at rest and at even rates, the moments
// hold less of them than independent ones would be.
constexpr double shares[] = {0.8, 0.4, 0.2, 0.1, 0.05, 0.02, 0.0};

// On the diagonal, so that a motion that never changes has a covariance: of the variance of a reading, and of the learnt trace (what
// its products leave of rounding).
constexpr double least_of_reading = 0.01;
constexpr double least_of_trace = 1e-13;

// How far the bias may be off on either side of a gap, as a part of it: what half a degree makes of a coefficient of 2e-4.
constexpr double bias_error = 1e-4;

double reading_arcsec2(const CompensationConstants& gyro, const SwitchWindow& window) noexcept {
    return square(gyro.scale.value()) * reading_counts2(gyro, window.with_phase);
}

double width(const WindowRow& row) noexcept { return row.halves.last - row.halves.first; }

// Sum of the learnt moments over two stretches, per window.
double mean_product(const MotionMoments& motion, int shift, const Stretch& one, const Stretch& other) noexcept {
    double sum = 0.0;
    for (int i = one.first; i < one.last; ++i)
        for (int j = other.first; j < other.last; ++j)
            sum += motion.sum[moment_place(motion.length, i + shift, j + shift)];
    return sum / (motion.n_windows > 1.0 ? motion.n_windows : 1.0);
}

double trace_of(const MotionMoments& motion, int shift, int halves) noexcept {
    double sum = 0.0;
    for (int i = 0; i < halves; ++i) sum += mean_product(motion, shift, {i, i + 1}, {i, i + 1});
    return sum;
}

int sign_of(const SwitchWindow& window, int half) noexcept { return window.bias_sign[static_cast<unsigned>(half)]; }

double bias_per_half_arcsec(const CompensationConstants& gyro) noexcept {
    return gyro.bias.value() * gyro.scale.value() * gyro.tick.value() / 2.0;
}

double alternation(const SwitchWindow& window, const WindowRow& row) noexcept {
    int sum = 0;
    for (int h = row.halves.first; h < row.halves.last; ++h) sum += sign_of(window, h);
    return sum;
}

// Halves of a row that are corrected by the light, counted from its start.
Stretch lit_part(const SwitchWindow& window, const WindowRow& row) noexcept {
    const int end = window.light_start + window.light.basis.halves;
    Stretch part{row.halves.first - window.light_start, row.halves.last - window.light_start};
    if (row.halves.first < window.light_start) part.first = 0;
    if (row.halves.last > end) part.last = end - window.light_start;
    return part;
}

// What the drift of a switching mode is off by has one sign before the gap and the other after it.
void add_magnetic_step(const SwitchWindow& window, Triangle into) noexcept {
    const auto share = [&](int r) {
        const WindowRow& row = window.row[static_cast<unsigned>(r)];
        return row.read ? (row.after_gap ? 0.5 : -0.5) * width(row) : 0.0;
    };
    for (int r = 0; r < window.n_rows; ++r)
        for (int s = 0; s <= r; ++s) into.row(r)[s] += window.magnetic_variance_arcsec2 * share(r) * share(s);
}

}  // namespace

void learnt_covariance(const CompensationConstants& gyro, const SwitchWindow& window, const MotionMoments& motion,
                       Triangle into, Triangle trial) noexcept {
    const int n = window.n_rows;
    const int shift = (motion.length - window.n_halves) / 2;
    const double reading = reading_arcsec2(gyro, window);
    const double least = least_of_reading * reading + walk_arcsec2(gyro) / 2.0 +
                         least_of_trace * trace_of(motion, shift, window.n_halves);
    for (int r = 0; r < n; ++r) {
        const WindowRow& row = window.row[static_cast<unsigned>(r)];
        for (int s = 0; s <= r; ++s)
            into.row(r)[s] = mean_product(motion, shift, row.halves, window.row[static_cast<unsigned>(s)].halves);
        into.row(r)[r] += least * width(row);
    }
    // D D^T: each border is shared by two rows.
    const auto take_out = [&](Triangle from, double share) {
        for (int r = 0; r < n; ++r) {
            from.row(r)[r] -= 2.0 * share * reading;
            if (r > 0) from.row(r)[r - 1] += share * reading;
        }
    };
    std::array<double, most_window_rows> reciprocal{};
    for (const double share : shares) {
        for (std::size_t k = 0; k < triangle_size(n); ++k) trial.row(0)[k] = into.row(0)[k];
        take_out(trial, share);
        if (share > 0.0 && !factorise(trial, reciprocal.data(), n)) continue;
        take_out(into, share);
        return add_magnetic_step(window, into);
    }
}

void error_covariance(const CompensationConstants& gyro, const SwitchWindow& window, const RelockScale& scale,
                      WindowReadings& readings, Triangle into) noexcept {
    const LightFit light{window.light, gyro.light_noise.value()};
    const double k = gyro.chi * bias_per_half_arcsec(gyro);
    const double bias = bias_error * bias_per_half_arcsec(gyro);
    double sum = 0.0;
    double halves = 0.0;
    for (int r = 0; r < window.n_rows; ++r) {
        const auto at = static_cast<unsigned>(r);
        const WindowRow& row = window.row[at];
        const Stretch lit = light.is_known() ? lit_part(window, row) : Stretch{};
        double& d = readings.false_arcsec[at];
        d = row.recorded_arcsec;
        for (int h = lit.first; h < lit.last; ++h) d += k * light.angle(h) * sign_of(window, window.light_start + h);
        readings.angle_arcsec[at] = row.y_arcsec + (1.0 + scale.value) * d;
        if (row.read) {
            sum += readings.angle_arcsec[at];
            halves += width(row);
        }
        for (int s = 0; s <= r; ++s) {
            const WindowRow& other = window.row[static_cast<unsigned>(s)];
            double e = 0.0;
            if (row.read && other.read) {
                e = row.common_arcsec * other.common_arcsec;
                e += d * readings.false_arcsec[static_cast<unsigned>(s)] * scale.variance;
                const Stretch other_lit = light.is_known() ? lit_part(window, other) : Stretch{};
                for (int h = lit.first; h < lit.last; ++h)
                    for (int g = other_lit.first; g < other_lit.last; ++g)
                        e += k * k * light.covariance(h, g) * sign_of(window, window.light_start + h) *
                             sign_of(window, window.light_start + g);
                if (row.after_gap == other.after_gap)
                    e += bias * bias * alternation(window, row) * alternation(window, other);
            }
            into.row(r)[s] = r == s && row.read ? e + row.error_arcsec2 : e;
        }
    }
    readings.rate_arcsec = halves > 0.0 ? sum / halves : 0.0;
}

void rounding_covariance(const CompensationConstants& gyro, const SwitchWindow& window, const WindowReadings& readings,
                         double scale, Triangle motion, Triangle errors, Triangle into) noexcept {
    const int n = window.n_rows;
    const double count = gyro.scale.value();
    const double bias = bias_per_half_arcsec(gyro);
    for (std::size_t k = 0; k < triangle_size(n); ++k) into.row(0)[k] = 0.0;
    // R_ij of the borders i <= j enters where the rows on both sides of either meet, with the sign of D.
    const auto add = [&](int i, int j, double r) {
        if (i > 0) into.at(i - 1, j - 1) += r;
        if (j < n) into.at(i, j) += r;
        if (i > 0 && j < n) into.at(i - 1, j) -= r;
        if (i < j) into.at(i, j - 1) -= i == j - 1 ? 2.0 * r : r;
    };
    const double reading = reading_arcsec2(gyro, window);
    for (int j = 0; j <= n; ++j) add(j, j, reading);
    if (window.with_phase) return;
    std::array<double, most_window_rows + 1> turn{};     // counts, from border i to the present one
    std::array<double, most_window_rows + 1> scatter{};  // its variance, counts^2
    int first = 0;                                       // border at which the counted stretch begins
    for (int j = 0; j < n; ++j) {
        const WindowRow& row = window.row[static_cast<unsigned>(j)];
        if (!row.read) {
            first = j + 1;
            continue;
        }
        const double turned = (readings.rate_arcsec * width(row) + bias * alternation(window, row) -
                               (1.0 + scale) * readings.false_arcsec[static_cast<unsigned>(j)]) /
                              count;
        const double own = motion.at(j, j) + errors.at(j, j);
        turn[static_cast<unsigned>(j)] = scatter[static_cast<unsigned>(j)] = 0.0;
        double with_row = 0.0;  // covariance of the row with those from border i on
        for (int i = j; i >= first; --i) {
            if (i < j) with_row += motion.at(j, i) + errors.at(j, i);
            const auto at = static_cast<unsigned>(i);
            turn[at] += turned;
            scatter[at] += (own + 2.0 * with_row) / (count * count);
            add(i, j + 1, count * count * rounding_law(turn[at], scatter[at]));
        }
    }
}

}  // namespace zlg::core
