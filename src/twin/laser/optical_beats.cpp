#include <zlg/twin/optical_beats.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <zlg/core/common/maths.hpp>

namespace zlg::twin {
namespace {

using std::numbers::pi;

// Sixteen a turn for 4096 turns, 1.6 MHz over a whole half of 2.5 ms: faster than that, comparators do not follow.
constexpr double max_samples = 65536.0;

// The drive at a part of the stretch.
Beat piece(const Beat& whole, double from, double to) {
    Beat b = whole;
    const double change = whole.end_hz - whole.start_hz;
    b.start_hz = whole.start_hz + from * change;
    b.end_hz = to == 1.0 ? whole.end_hz : whole.start_hz + to * change;
    return b;
}

// Where in the stretch the phase turns back, as a part of it; 1 where it does not.
double turning_point(const Beat& b) {
    if (!(b.amplitude > 0.0) || !(b.start_hz * b.end_hz < 0.0)) return 1.0;
    return b.start_hz / (b.start_hz - b.end_hz);
}

// Signed, nearest to zero.
double shortest(double turns) { return turns - std::round(turns); }

}  // namespace

OpticalBeats::OpticalBeats(double threshold, const Turns& left, const Turns& right)
    : threshold_{threshold}, left_{left}, right_{right}, winding_{left}, count_{left} {}

Signals OpticalBeats::signals() const {
    const double l = left_.value().part_rad();
    const double r = right_.value().part_rad();
    return {left_amplitude_ * core::maths::sin(l) + right_amplitude_ * core::maths::sin(r),
            left_amplitude_ * core::maths::cos(l) + right_amplitude_ * core::maths::cos(r)};
}

// arg z minus the phase of the larger part [turns].
double OpticalBeats::beside_larger() const {
    const bool left_leads = left_amplitude_ >= right_amplitude_;
    const double larger = left_leads ? left_amplitude_ : right_amplitude_;
    const double smaller = left_leads ? right_amplitude_ : left_amplitude_;
    if (!(smaller > 0.0)) return 0.0;
    const double apart = 2.0 * pi * (right_.value().part - left_.value().part) * (left_leads ? 1.0 : -1.0);
    const double ratio = smaller / larger;
    return core::maths::atan2(ratio * core::maths::sin(apart), 1.0 + ratio * core::maths::cos(apart)) / (2.0 * pi);
}

void OpticalBeats::set_amplitudes(double left, double right) {
    if (left == left_amplitude_ && right == right_amplitude_) return;
    left_amplitude_ = left;
    right_amplitude_ = right;
    if (!(left > 0.0) && !(right > 0.0)) return;
    const Turns& larger = left >= right ? left_.value() : right_.value();
    winding_.add(shortest(larger.part + beside_larger() - winding_.part));
    follow(winding_);
}

void OpticalBeats::advance(const Beat& left, const Beat& right, double duration_s) {
    set_amplitudes(left.amplitude, right.amplitude);
    if (!(left.amplitude > 0.0) && !(right.amplitude > 0.0)) return;
    const double a = turning_point(left);
    const double b = turning_point(right);
    const std::array<double, 4> at{0.0, std::min(a, b), std::max(a, b), 1.0};
    for (std::size_t i = 0; i + 1 < at.size(); ++i) {
        if (!(at[i + 1] > at[i])) continue;
        live_monotone(piece(left, at[i], at[i + 1]), piece(right, at[i], at[i + 1]), (at[i + 1] - at[i]) * duration_s);
    }
}

// The larger part moves the winding by its own turns, the smaller by the change of what it adds beside them.
void OpticalBeats::live_monotone(const Beat& left, const Beat& right, double duration_s) {
    const Turns left_before = left_.value();
    const Turns right_before = right_.value();
    const double beside_before = beside_larger();
    if (left.amplitude > 0.0) left_.advance(left.start_hz, left.end_hz, left.coupling, duration_s);
    if (right.amplitude > 0.0) right_.advance(right.start_hz, right.end_hz, right.coupling, duration_s);
    const bool left_leads = left_amplitude_ >= right_amplitude_;
    winding_.add(left_leads ? left_.value().minus(left_before) : right_.value().minus(right_before));
    winding_.add(beside_larger() - beside_before);

    const bool both = left.amplitude > 0.0 && right.amplitude > 0.0;
    if (both && std::abs(left.amplitude - right.amplitude) <= 1.5 * threshold_) {
        sample_sum(left, right, left_before, right_before, duration_s);
    } else {
        follow(winding_);
    }
}

void OpticalBeats::kick(double left_turns, double right_turns) {
    const double beside_before = beside_larger();
    left_.kick(left_turns);
    right_.kick(right_turns);
    winding_.add(left_amplitude_ >= right_amplitude_ ? left_turns : right_turns);
    winding_.add(beside_larger() - beside_before);
    follow(winding_);
}

// Run the decoder over the stretch. Between its exact ends a phase follows its drive: the pull of the backscatter
// within the stretch is a hundredth of a turn, and nobody sees it in the garbage that is counted here.
void OpticalBeats::sample_sum(const Beat& left, const Beat& right, const Turns& left_before, const Turns& right_before,
                              double duration_s) {
    const auto phase_of = [&](const Beat& b, const Turns& before, const Turns& after) {
        const double pull = after.minus(before) - 0.5 * (b.start_hz + b.end_hz) * duration_s;
        return [=](double x) {
            return before.part + x * (pull + duration_s * (b.start_hz + 0.5 * x * (b.end_hz - b.start_hz)));
        };
    };
    const auto left_at = phase_of(left, left_before, left_.value());
    const auto right_at = phase_of(right, right_before, right_.value());
    const double fastest =
        std::max({std::abs(left.start_hz), std::abs(left.end_hz), std::abs(right.start_hz), std::abs(right.end_hz)});
    const auto n = static_cast<std::int64_t>(std::ceil(std::min(16.0 * fastest * duration_s, max_samples))) + 1;

    QuadratureDecoder decoder{threshold_, count_.value()};
    for (std::int64_t i = 1; i <= n; ++i) {
        const double x = static_cast<double>(i) / static_cast<double>(n);
        const double l = 2.0 * pi * left_at(x);
        const double r = 2.0 * pi * right_at(x);
        decoder.see({left_amplitude_ * core::maths::sin(l) + right_amplitude_ * core::maths::sin(r),
                     left_amplitude_ * core::maths::cos(l) + right_amplitude_ * core::maths::cos(r)});
    }
    // Of the quarters that the comparators allow, the one nearest to where the sum is now.
    const std::int64_t here = QuarterTurns::floor_of(winding_);
    const std::int64_t ahead = (decoder.quadrant() - here) & 3;
    const std::int64_t now = here + (ahead == 3 ? -1 : ahead);
    missed_ += static_cast<std::uint64_t>(decoder.quarters()) - static_cast<std::uint64_t>(now);
    count_.set(now);
}

double OpticalBeats::size() const {
    if (!(right_amplitude_ > 0.0)) return left_amplitude_;
    if (!(left_amplitude_ > 0.0)) return right_amplitude_;
    const Signals z = signals();
    return std::sqrt(z.s * z.s + z.c * z.c);
}

// Below 1.5 times their threshold the comparators may stand still.
void OpticalBeats::follow(const Turns& phase) {
    const double now = size();
    if (now < 1.5 * threshold_ || !(now > 0.0)) return;
    if (now != lag_size_) {
        lag_size_ = now;
        lag_turns_ = core::maths::asin(threshold_ / now) / (2.0 * pi);
    }
    count_.see(phase, lag_turns_);
}

std::uint64_t OpticalBeats::latch_quarters() const { return static_cast<std::uint64_t>(count_.value()) + missed_; }

std::uint64_t OpticalBeats::latch_turns() const {
    const std::uint64_t quarters = latch_quarters();
    return (quarters >> 2) | ((quarters >> 63) != 0 ? std::uint64_t{3} << 62 : 0);
}

}  // namespace zlg::twin
