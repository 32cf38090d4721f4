#include <zlg/rig/place_check.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace zlg::rig {
namespace {

constexpr int stretch_differences = 4096;  // 10 s of ticks of 5 ms
constexpr int least_differences = 512;

constexpr std::array<double, 9> eighth_difference{1.0, -8.0, 28.0, -56.0, 70.0, -56.0, 28.0, -8.0, 1.0};
constexpr double unit_counts2 = 12870.0 / 12.0;  // C(16, 8)/12

constexpr double most_square = 9.0;

// Places that are spread over the count. Where they are not, a vibration below a count may move them and no count.
constexpr double least_spread = 0.5;

// Beyond that part of rough differences a motion is too large for the mean to tell right from wrong: of a Gaussian one,
// from two units on, where the mean of 4096 differences has a standard deviation of 0.13 about 1 or -1.
constexpr double most_rough = 0.1;

// Counts that move in one of 20 differences, and places a tenth as much at most: in a vibration at a fraction of the
// rate of the ticks, right ones may move half as much.
constexpr double least_moving = 0.05;
constexpr double most_still = 0.01;  // of the squares

// An angle that has been in every eighth of a count for about the same time: what is left of a motion then knows
// nothing of the place, not even a vibration below a count.
constexpr double least_even = 0.75;
constexpr double most_even = 1.25;

// <x q> over <q^2> and over <x^2>. Noise of 0.05 counts makes the first 0.03; half a place makes it -1, one random
// place in ten 0.1. Over <x^2> it is small where x is a motion, whatever that is.
constexpr double most_with_place = 0.05;
constexpr double most_of_motion = 0.3;

// Where none of these bits is ever set, places come in steps of 1/64 count, whose rounding is three times the noise of
// a reading.
constexpr std::uint32_t fine_bits = 0x3ff;

}  // namespace

void PlaceCheck::take(const core::HalfRecord& half) {
    const std::uint64_t before = borders_[last_].counts;
    last_ = (last_ + 1) % n_borders;
    borders_[last_].counts = before + static_cast<std::uint64_t>(half.counts);
    borders_[last_].place = static_cast<double>(half.fringe) / core::count_parts;
    half_ = half.half;
    const bool measured = core::is_measured(half) && core::has_fringe(half);
    n_known_ = measured ? std::min(n_known_ + 1, n_borders) : 0;
    if (n_known_ == n_borders) add_difference();
}

void PlaceCheck::add_difference() {
    double y = 0.0;
    double q = 0.0;
    double mean = 0.0;
    for (std::size_t k = 0; k < eighth_difference.size(); ++k) {
        const BorderPlace& border = borders_[(last_ + n_borders - 2 * k) % n_borders];
        // Less the last one, so that the sum is small and exact.
        const auto counts = static_cast<double>(static_cast<std::int64_t>(border.counts - borders_[last_].counts));
        y += eighth_difference[k] * counts;
        q += eighth_difference[k] * border.place;
        mean += std::abs(eighth_difference[k]) / 256.0 * (counts + border.place);
    }
    y /= std::sqrt(unit_counts2);
    q /= std::sqrt(unit_counts2);
    ++stretch_.n;
    stretch_.n_rough += std::abs(y) > 3.0;
    stretch_.n_counts += std::abs(y) > 0.5;
    stretch_.y_sq += std::min(y * y, most_square);
    stretch_.q_sq += std::min(q * q, most_square);
    stretch_.motion_sq += (y + q) * (y + q);
    stretch_.place_sq += q * q;
    stretch_.both += (y + q) * q;
    ++stretch_.n_in_part[static_cast<std::size_t>(8.0 * (mean - std::floor(mean))) % stretch_.n_in_part.size()];
    stretch_.bits |= static_cast<std::uint32_t>(borders_[last_].place * 65536.0);
    stretch_.agree += std::clamp(-q * (2.0 * y + q), -most_square, most_square);
    if (stretch_.n < stretch_differences) return;
    const Verdict found = verdict(stretch_);
    stretch_ = {};
    n_stretches_ += found != Verdict::open;
    if (found != Verdict::wrong) return;
    if (n_wrong_++ == 0) first_wrong_half_ = half_;
}

bool PlaceCheck::is_even(const Stretch& s) {
    const double part = s.n / static_cast<double>(s.n_in_part.size());
    return std::all_of(s.n_in_part.begin(), s.n_in_part.end(),
                       [&](int n) { return n >= least_even * part && n <= most_even * part; });
}

PlaceCheck::Verdict PlaceCheck::verdict(const Stretch& s) {
    if (s.n < least_differences || s.n_rough > most_rough * s.n) return Verdict::open;
    if (s.y_sq >= least_spread * s.n && is_even(s)) {
        const double both = std::abs(s.both);
        const bool depends = both > most_with_place * s.place_sq && both > most_of_motion * s.motion_sq;
        if (depends || (s.bits & fine_bits) == 0) return Verdict::wrong;
    }
    if (s.q_sq >= least_spread * s.n) return s.agree < 0.0 ? Verdict::wrong : Verdict::right;
    const bool still = s.n_counts >= least_moving * s.n && s.q_sq < most_still * s.y_sq;
    return still ? Verdict::wrong : Verdict::open;
}

std::string PlaceCheck::complaint(const std::string& log_name) const {
    const Verdict last = verdict(stretch_);
    const std::int64_t n_wrong = n_wrong_ + (last == Verdict::wrong ? 1 : 0);
    if (n_wrong == 0) return {};
    return fmt::format(
        "{}: the column fringe contradicts the counts in {} of {} stretches of some {} half-periods, first before "
        "half-period {}; angles there may be wrong by up to a count at each border, which sigma_arcsec does not "
        "contain. Without that column the log has whole counts",
        log_name, n_wrong, n_stretches_ + (last != Verdict::open ? 1 : 0), stretch_differences,
        n_wrong_ > 0 ? first_wrong_half_ : half_);
}

}  // namespace zlg::rig
