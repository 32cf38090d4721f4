#include "laser_beats.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <zlg/core/common/maths.hpp>

#include "laser.hpp"
#include "noise.hpp"

namespace zlg::twin {
namespace {

// A wave below this part of the centre's intensity makes no beat: what is scattered into it from the other is no
// longer small against it.
constexpr double faint_ratio = 0.01;

// Equal mirrors whose coupling locks equal waves below lock_hz.
Backscatter scatter(double lock_hz, double phase_deg) {
    const double phase_rad = phase_deg * std::numbers::pi / 180.0;
    const double each_hz = 0.5 * lock_hz / core::maths::cos(phase_rad);
    return {each_hz, each_hz, phase_rad, 0.0};
}

OpticalBeats beats_of(std::uint64_t seed, double threshold) {
    const Noise start{seed, chance::Cause::start_phase};
    Turns left;
    left.part = start.uniform(0, 0);
    Turns right;
    right.part = start.uniform(0, 1);
    return OpticalBeats{threshold, left, right};
}

}  // namespace

LaserBeats::LaserBeats(const LaserConfig& config, std::uint64_t seed, const LaserTable& table)
    : table_{table},
      left_{scatter(config.lock_in_left_hz, config.scatter_phase_deg)},
      right_{scatter(config.lock_in_right_hz, config.scatter_phase_deg)},
      threshold_{2.0 * config.comparator_threshold * table.exact().centre_intensity()},
      min_light_{faint_ratio * table.exact().centre_intensity()},
      usual_amplitude_{2.0 * table.exact().centre_intensity()},
      walk_turns_{quantum_walk_turns(config)},
      counts_quarters_{config.quadrature == Quadrature::x4},
      beats_{beats_of(seed, threshold_)},
      end_light_{table_.at(0.0, 0.0)} {}

// Only the distance of a wave from its line matters: of either mode, rotation makes of it what a field would.
LaserBeats::Lights LaserBeats::lights(const Stretch& s) {
    const auto field = [&s](std::size_t k) {
        return s.field_g[k] - lasing_mode(s.perimeter_lambda[k]).helicity() * s.rotation_g;
    };
    const double start_g = field(0);
    Lights made;
    const bool goes_on = s.perimeter_lambda[0] == end_perimeter_ && start_g == end_field_;
    made.start = goes_on ? end_light_ : table_.at(s.perimeter_lambda[0], start_g);
    made.middle = table_.at(s.perimeter_lambda[1], field(1));
    end_perimeter_ = s.perimeter_lambda[2];
    end_field_ = field(2);
    end_light_ = table_.at(end_perimeter_, end_field_);
    made.end = end_light_;
    return made;
}

// slant  1: the drive follows the bias from start to end; 0: it keeps its mean.
Beat LaserBeats::beat(const Stretch& s, const Lights& lights, int helicity, double slant) const {
    WavePair pair = lights.middle.of(helicity);
    pair.cw *= s.cw_part;
    pair.ccw *= s.ccw_part;
    if (!(std::min(pair.cw, pair.ccw) > min_light_)) return {};
    const StartMiddleEnd bias{lights.start.of(helicity).bias_hz, pair.bias_hz, lights.end.of(helicity).bias_hz};
    const double mean_hz = s.common_hz + s.pulled_hz + helicity * s.helicity_hz + mean_of(bias);
    const double half_change_hz = 0.5 * slant * (bias[2] - bias[0]);
    return {mean_hz - half_change_hz, mean_hz + half_change_hz,
            (helicity > 0 ? left_ : right_).coupling(pair.cw, pair.ccw), 2.0 * std::sqrt(pair.cw * pair.ccw)};
}

Followed LaserBeats::live(const Stretch& s, double slant) {
    const Lights seen = lights(s);
    const Beat left = beat(s, seen, 1, slant);
    const Beat right = beat(s, seen, -1, slant);
    beats_.advance(left, right, s.duration_s);
    if (!(std::abs(left.amplitude - right.amplitude) > 1.5 * threshold_)) return {};
    const int helicity = left.amplitude > right.amplitude ? 1 : -1;
    const double drive_hz = 0.5 * ((helicity > 0 ? left : right).start_hz + (helicity > 0 ? left : right).end_hz);
    return {helicity, drive_hz - s.common_hz - helicity * s.helicity_hz};
}

Followed LaserBeats::plateau(const Stretch& stretch) { return live(stretch, 0.0); }
Followed LaserBeats::edge(const Stretch& stretch) { return live(stretch, 1.0); }

void LaserBeats::diffuse(double duration_s, double left_deviate, double right_deviate) {
    const auto kick = [&](const WavePair& pair, double deviate) {
        if (!(std::min(pair.cw, pair.ccw) > min_light_)) return 0.0;
        const double per_light = 0.25 * usual_amplitude_ * (1.0 / pair.cw + 1.0 / pair.ccw);
        return walk_turns_ * std::sqrt(duration_s * per_light) * deviate;
    };
    if (walk_turns_ > 0.0) beats_.kick(kick(end_light_.left, left_deviate), kick(end_light_.right, right_deviate));
}

Signals LaserBeats::signals() const {
    const Signals z = beats_.signals();
    return {z.s / usual_amplitude_, z.c / usual_amplitude_};
}

std::uint64_t LaserBeats::latch() const { return counts_quarters_ ? beats_.latch_quarters() : beats_.latch_turns(); }

}  // namespace zlg::twin
