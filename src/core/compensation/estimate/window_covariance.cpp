#include "window_covariance.hpp"

#include <memory>

#include <zlg/core/common/maths.hpp>
#include <zlg/core/compensation/border.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// Shares of the roundings in the learnt moments that are taken out. Where the roundings repeat, at rest and at even
// rates, the moments hold less of them than independent ones would be.
constexpr double shares[] = {0.0, 0.02, 0.05, 0.1, 0.2, 0.4, 0.8};

// On the diagonal, so that a motion that never changes has a covariance: of the variance of a reading, and of the
// learnt trace (what its products leave of rounding).
constexpr double least_of_reading = 0.01;
constexpr double least_of_trace = 1e-13;

// How far the bias may be off on either side of a gap, as a part of it: what half a degree makes of a coefficient of
// 2e-4.
constexpr double bias_error = 1e-4;

double reading_arcsec2(const CompensationConstants& gyro, const SwitchWindow& window) noexcept {
    return square(gyro.scale.value()) * reading_counts2(gyro, window.with_phase);
}

// The learnt moments as sums over stretches of the window, per window.
class Products {
public:
    Products(const MotionMoments& motion, const SwitchWindow& window) noexcept
        : sum_{motion.sum.data()},
          step_{motion.step_halves},
          last_{motion.length - 1},
          shift_{(motion.length - window.n_halves / motion.step_halves) / 2},
          part_{1.0 / (motion.n_windows > 1.0 ? motion.n_windows : 1.0)} {
        for (int i = 0; i <= last_; ++i)
            start_[static_cast<unsigned>(i)] = static_cast<int>(moment_place(last_ + 1, i, i)) - i;
    }

    // Of a stretch and a later one, or itself.
    [[nodiscard]] double of(const Stretch& early, const Stretch& late) const noexcept {
        double sum = 0.0;
        for (int j = late.first / step_ + shift_; j < late.last / step_ + shift_; ++j)
            for (int i = early.first / step_ + shift_; i < early.last / step_ + shift_; ++i) sum += at(i, j);
        return part_ * sum;
    }

private:
    [[nodiscard]] double at(int i, int j) const noexcept {
        if (i > j) return at(j, i);
        return i + j <= last_ ? sum_[start(i) + j] : sum_[start(last_ - j) + last_ - i];
    }
    [[nodiscard]] int start(int i) const noexcept { return start_[static_cast<unsigned>(i)]; }

    const double* sum_;
    int step_;
    int last_;
    int shift_;
    double part_;
    std::array<int, most_moment_steps> start_;  // place of (i, i), less i
};

int sign_of(const SwitchWindow& window, int half) noexcept { return window.bias_sign[static_cast<unsigned>(half)]; }

double bias_per_half_arcsec(const CompensationConstants& gyro) noexcept {
    return gyro.bias.value() * gyro.scale.value() * gyro.tick.value() / 2.0;
}

double alternation(const SwitchWindow& window, const WindowRow& row) noexcept {
    int sum = 0;
    for (int h = row.halves.first; h < row.halves.last; ++h) sum += sign_of(window, h);
    return sum;
}

// (2) and (3) of light_spline.hpp are linear in it.
LightHalf signed_by(int sign, LightHalf half) noexcept {
    for (double& x : half.product) x *= sign;
    for (double& x : half.slope) x *= sign;
    half.value *= sign;
    return half;
}

void add(const LightHalf& half, LightHalf& sum) noexcept {
    for (std::size_t k = 0; k < half.product.size(); ++k) sum.product[k] += half.product[k];
    for (std::size_t k = 0; k < half.slope.size(); ++k) sum.slope[k] += half.slope[k];
}

// What the drift of a switching mode is off by has one sign before the gap and the other after it.
void add_magnetic_step(const SwitchWindow& window, Triangle into) noexcept {
    const auto share = [&](int r) {
        const WindowRow& row = row_of(window, r);
        return row.read ? (row.after_gap ? 0.5 : -0.5) * width(row) : 0.0;
    };
    for (int r = 0; r < window.n_rows; ++r)
        for (int s = 0; s <= r; ++s) into.row(r)[s] += window.magnetic_variance_arcsec2 * share(r) * share(s);
}

constexpr double two_pi_squared = 19.739208802178716;
constexpr double max_scatter_counts2 = 2.0;

// Distance to the nearest whole number. The law is even in it.
double distance_to_whole(double x) noexcept {
    constexpr double most = 2e15;
    constexpr double whole_part = 6755399441055744.0;  // 1.5 2^52: a sum with it is whole
    if (!(x < most && x > -most)) return 0.0;
    const double off = x - ((x + whole_part) - whole_part);
    return off < 0.0 ? -off : off;
}

// C of the rows, less a share of the roundings that are in the moments: D D^T, in which two neighbours share a border.
void fill(const SwitchWindow& window, const Products& products, double least, double roundings,
          Triangle into) noexcept {
    for (int r = 0; r < window.n_rows; ++r) {
        const WindowRow& row = row_of(window, r);
        for (int s = 0; s <= r; ++s) into.row(r)[s] = products.of(row_of(window, s).halves, row.halves);
        into.row(r)[r] += least * width(row) - 2.0 * roundings;
        if (r > 0) into.row(r)[r - 1] += roundings;
    }
}

}  // namespace

void learnt_covariance(const CompensationConstants& gyro, const SwitchWindow& window, const MotionMoments& motion,
                       Triangle into) noexcept {
    const Products products{motion, window};
    const double reading = reading_arcsec2(gyro, window);
    double trace = 0.0;
    const int step_halves = motion.step_halves;
    for (int h = 0; h < window.n_halves; h += step_halves)
        trace += products.of({h, h + step_halves}, {h, h + step_halves});
    const double least = least_of_reading * reading + walk_arcsec2(gyro) / 2.0 + least_of_trace * trace;
    std::array<double, most_window_rows> reciprocal{};
    // What is taken out is positive by itself: where a share leaves a positive covariance, smaller ones do.
    int most = 0;
    for (int step = 4; step > 0; step /= 2) {
        if (most + step >= static_cast<int>(std::size(shares))) continue;
        fill(window, products, least, shares[most + step] * reading, into);
        if (factorise(into, reciprocal.data(), window.n_rows)) most += step;
    }
    fill(window, products, least, shares[most] * reading, into);
    add_magnetic_step(window, into);
}

ReadingErrors::ReadingErrors(const CompensationConstants& gyro, const SwitchWindow& window, const RelockScale& scale,
                             LightHalves& halves, WindowReadings& readings) noexcept
    : window_{window},
      scale_{scale},
      readings_{readings},
      light_{window.light, gyro.light_noise.value(), gyro.bend},
      halves_{halves},
      unit_arcsec_{gyro.chi * bias_per_half_arcsec(gyro)},
      bias_arcsec2_{square(bias_error * bias_per_half_arcsec(gyro)) + window.bias_variance_arcsec2} {
    int n_forms = 0;
    double sum = 0.0;
    double n_halves = 0.0;
    for (int r = 0; r < window.n_rows; ++r) {
        const WindowRow& row = row_of(window, r);
        const Stretch part = lit_part(row);
        forms_[static_cast<unsigned>(r)] = {n_forms, n_forms};
        double d = row.recorded_arcsec;
        for (int h = part.first; h < part.last && n_forms < static_cast<int>(halves.size()); ++h) {
            const LightHalf half = signed_by(sign_of(window, window.light_start + h), light_.half(h));
            d += unit_arcsec_ * light_.angle(half);
            // Halves between the same knots make one form.
            const bool is_first = forms_[static_cast<unsigned>(r)].first == n_forms;
            LightHalf& last = halves[static_cast<unsigned>(is_first ? 0 : n_forms - 1)];
            if (!is_first && last.first == half.first)
                add(half, last);
            else
                std::construct_at(&halves[static_cast<unsigned>(n_forms++)], half);
        }
        forms_[static_cast<unsigned>(r)] = {forms_[static_cast<unsigned>(r)].first, n_forms};
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
    const int first = row.halves.first - window_.light_start;
    const int last = row.halves.last - window_.light_start;
    return {first < 0 ? 0 : first, last > window_.light.basis.halves ? window_.light.basis.halves : last};
}

double ReadingErrors::of(int r, int s) const noexcept {
    const WindowRow& row = row_of(window_, r);
    const WindowRow& other = row_of(window_, s);
    const auto& d = readings_.false_arcsec;
    double sum = row.common_arcsec * other.common_arcsec;
    sum += d[static_cast<unsigned>(r)] * d[static_cast<unsigned>(s)] * scale_.variance;
    const Stretch& forms = forms_[static_cast<unsigned>(r)];
    const Stretch& others = forms_[static_cast<unsigned>(s)];
    double by_light = 0.0;
    for (int h = forms.first; h < forms.last; ++h)
        for (int g = others.first; g < others.last; ++g)
            by_light += light_.covariance(halves_[static_cast<unsigned>(h)], halves_[static_cast<unsigned>(g)]);
    sum += square(unit_arcsec_) * by_light;
    if (row.after_gap == other.after_gap)
        sum += bias_arcsec2_ * alternation(window_, row) * alternation(window_, other);
    return r == s ? sum + row.error_arcsec2 : sum;
}

double rounding_law(double turn_counts, double scatter_counts2) noexcept {
    if (!(scatter_counts2 < max_scatter_counts2)) return 0.0;
    const double x = distance_to_whole(turn_counts);
    const double coherence = scatter_counts2 > 0.0 ? maths::exp(-two_pi_squared * scatter_counts2) : 1.0;
    return 0.5 * (x * x - x + 1.0 / 6.0) * coherence;
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
        const WindowRow& row = row_of(window, j);
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
    // And of each border with itself, but for those between two rows of which neither was read: nothing was rounded
    // there.
    const double reading = reading_arcsec2(gyro, window);
    const auto is_read = [&](int j) { return j >= 0 && j < n && row_of(window, j).read; };
    for (int j = 0; j < n; ++j) {
        const bool at_start = is_read(j) || is_read(j - 1);
        const bool at_end = is_read(j) || is_read(j + 1);
        v.row(j)[j] += (static_cast<int>(at_start) + static_cast<int>(at_end)) * reading;
        if (j > 0 && at_start) v.row(j)[j - 1] -= reading;
    }
}

}  // namespace zlg::core
