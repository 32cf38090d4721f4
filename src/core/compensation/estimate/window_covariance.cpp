#include "window_covariance.hpp"

#include <memory>

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
    const int step = motion.step_halves;
    double sum = 0.0;
    for (int i = one.first / step; i < one.last / step; ++i)
        for (int j = other.first / step; j < other.last / step; ++j)
            sum += motion.sum[moment_place(motion.length, i + shift, j + shift)];
    return sum / (motion.n_windows > 1.0 ? motion.n_windows : 1.0);
}

double trace_of(const MotionMoments& motion, const SwitchWindow& window) noexcept {
    const int steps = window.n_halves / motion.step_halves;
    const int shift = (motion.length - steps) / 2;
    double sum = 0.0;
    for (int i = shift; i < shift + steps; ++i) sum += motion.sum[moment_place(motion.length, i, i)];
    return sum / (motion.n_windows > 1.0 ? motion.n_windows : 1.0);
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

// What the drift of a switching mode is off by has one sign before the gap and the other after it.
void add_magnetic_step(const SwitchWindow& window, Triangle into) noexcept {
    const auto share = [&](int r) {
        const WindowRow& row = window.row[static_cast<unsigned>(r)];
        return row.read ? (row.after_gap ? 0.5 : -0.5) * width(row) : 0.0;
    };
    for (int r = 0; r < window.n_rows; ++r)
        for (int s = 0; s <= r; ++s) into.row(r)[s] += window.magnetic_variance_arcsec2 * share(r) * share(s);
}

// C of the rows, less a share of the roundings that are in the moments: D D^T, in which two neighbours share a border.
void fill(const SwitchWindow& window, const MotionMoments& motion, double least, double roundings,
          Triangle into) noexcept {
    const int shift = (motion.length - window.n_halves / motion.step_halves) / 2;
    for (int r = 0; r < window.n_rows; ++r) {
        const WindowRow& row = window.row[static_cast<unsigned>(r)];
        for (int s = 0; s <= r; ++s)
            into.row(r)[s] = mean_product(motion, shift, row.halves, window.row[static_cast<unsigned>(s)].halves);
        into.row(r)[r] += least * width(row) - 2.0 * roundings;
        if (r > 0) into.row(r)[r - 1] += roundings;
    }
}

}  // namespace

void learnt_covariance(const CompensationConstants& gyro, const SwitchWindow& window, const MotionMoments& motion,
                       Triangle into) noexcept {
    const double reading = reading_arcsec2(gyro, window);
    const double least =
        least_of_reading * reading + walk_arcsec2(gyro) / 2.0 + least_of_trace * trace_of(motion, window);
    std::array<double, most_window_rows> reciprocal{};
    for (const double share : shares) {
        fill(window, motion, least, share * reading, into);
        if (share == 0.0) break;
        if (!factorise(into, reciprocal.data(), window.n_rows)) continue;
        fill(window, motion, least, share * reading, into);
        break;
    }
    add_magnetic_step(window, into);
}

ReadingErrors::ReadingErrors(const CompensationConstants& gyro, const SwitchWindow& window, const RelockScale& scale,
                             LightHalves& halves, WindowReadings& readings) noexcept
    : window_{window},
      scale_{scale},
      readings_{readings},
      light_{window.light, gyro.light_noise.value()},
      halves_{halves},
      unit_arcsec_{gyro.chi * bias_per_half_arcsec(gyro)},
      bias_arcsec2_{square(bias_error * bias_per_half_arcsec(gyro)) + window.bias_variance_arcsec2} {
    bool is_lit = false;
    double sum = 0.0;
    double n_halves = 0.0;
    for (int r = 0; r < window.n_rows; ++r) {
        const WindowRow& row = window.row[static_cast<unsigned>(r)];
        double d = row.recorded_arcsec;
        if (!is_lit) from_ = row.halves.first > window.light_start ? row.halves.first - window.light_start : 0;
        const Stretch part = lit_part(row);
        for (int h = part.first; h < part.last; ++h) {
            is_lit = true;
            const LightHalf& half = *std::construct_at(&halves[static_cast<unsigned>(h - from_)], light_.half(h));
            d += unit_arcsec_ * light_.angle(half) * sign_of(window, window.light_start + h);
        }
        readings.false_arcsec[static_cast<unsigned>(r)] = d;
        const double angle = row.y_arcsec + (1.0 + scale.value) * d;
        readings.angle_arcsec[static_cast<unsigned>(r)] = angle;
        if (!row.read) continue;
        sum += angle;
        n_halves += width(row);
    }
    readings.rate_arcsec = n_halves > 0.0 ? sum / n_halves : 0.0;
}

// Its halves that are corrected by the light, counted from the start of that.
Stretch ReadingErrors::lit_part(const WindowRow& row) const noexcept {
    if (!row.read || !light_.is_known()) return {};
    const int most = from_ + static_cast<int>(halves_.size());
    const int end = window_.light.basis.halves < most ? window_.light.basis.halves : most;
    const int first = row.halves.first - window_.light_start;
    const int last = row.halves.last - window_.light_start;
    return {first < from_ ? from_ : first, last > end ? end : last};
}

double ReadingErrors::by_light(const WindowRow& row, const WindowRow& other) const noexcept {
    const Stretch part = lit_part(row);
    const Stretch other_part = lit_part(other);
    double sum = 0.0;
    for (int h = part.first; h < part.last; ++h)
        for (int g = other_part.first; g < other_part.last; ++g)
            sum +=
                sign_of(window_, window_.light_start + h) * sign_of(window_, window_.light_start + g) *
                light_.covariance(halves_[static_cast<unsigned>(h - from_)], halves_[static_cast<unsigned>(g - from_)]);
    return square(unit_arcsec_) * sum;
}

double ReadingErrors::of(int r, int s) const noexcept {
    const WindowRow& row = window_.row[static_cast<unsigned>(r)];
    const WindowRow& other = window_.row[static_cast<unsigned>(s)];
    const auto& d = readings_.false_arcsec;
    double sum = row.common_arcsec * other.common_arcsec;
    sum += d[static_cast<unsigned>(r)] * d[static_cast<unsigned>(s)] * scale_.variance;
    sum += by_light(row, other);
    if (row.after_gap == other.after_gap)
        sum += bias_arcsec2_ * alternation(window_, row) * alternation(window_, other);
    return r == s ? sum + row.error_arcsec2 : sum;
}

void add_roundings(const CompensationConstants& gyro, const SwitchWindow& window, const WindowReadings& readings,
                   double scale, Triangle v) noexcept {
    const int n = window.n_rows;
    const double count = gyro.scale.value();
    const double bias = bias_per_half_arcsec(gyro);
    std::array<double, most_window_rows + 1> turn{};     // counts, from border i to the present one
    std::array<double, most_window_rows + 1> scatter{};  // its variance, counts^2
    // What belongs to the row behind the present one, which is to be read as it was before.
    std::array<double, most_window_rows> next{};
    int first = 0;  // border at which the counted stretch begins
    for (int j = 0; j < n && !window.with_phase; ++j) {
        const WindowRow& row = window.row[static_cast<unsigned>(j)];
        double* const of_row = v.row(j);
        std::array<double, most_window_rows> now = next;
        next = {};
        if (row.read) {
            const double turned = (readings.rate_arcsec * width(row) + bias * alternation(window, row) -
                                   (1.0 + scale) * readings.false_arcsec[static_cast<unsigned>(j)]) /
                                  count;
            turn[static_cast<unsigned>(j)] = scatter[static_cast<unsigned>(j)] = 0.0;
            double with_row = 0.0;  // covariance of the row with those from border i on
            for (int i = j; i >= first; --i) {
                const auto at = static_cast<unsigned>(i);
                if (i < j) with_row += of_row[i];
                turn[at] += turned;
                scatter[at] += (of_row[j] + 2.0 * with_row) / (count * count);
                // R of the borders i and j + 1: of the rows that meet there, with the signs of D.
                const double law = count * count * rounding_law(turn[at], scatter[at]);
                if (i > 0) now[at - 1] += law;
                now[at] -= i == j ? 2.0 * law : law;
                next[at] += law;
                if (i > 0) next[at - 1] -= law;
            }
        } else {
            first = j + 1;
        }
        for (int s = 0; s <= j; ++s) of_row[s] += now[static_cast<unsigned>(s)];
    }
    // And of each border with itself.
    const double reading = reading_arcsec2(gyro, window);
    for (int j = 0; j < n; ++j) {
        v.row(j)[j] += 2.0 * reading;
        if (j > 0) v.row(j)[j - 1] -= reading;
    }
}

}  // namespace zlg::core
