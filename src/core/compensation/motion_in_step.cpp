#include <zlg/core/compensation/motion_in_step.hpp>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// Segments and switches over which is averaged.
constexpr double memory = 32.0;
constexpr double fading = 1.0 - 1.0 / memory;

// Square of the number of standard deviations from which on a motion in step is taken to be real.
constexpr double gate_sq = 16.0;

// Curvature of a square wave of amplitude 1 that jumps late or early by the part e of a segment: 2 x 147/4 x 30 x 6/7 x
// e^3/3, the first term in e, and at most 1. Its period and phase may be such that it follows half of the wander.
double visible_part(double wander) noexcept {
    const double e = 0.5 * wander;
    const double cube = 630.0 * size(e * e * e);
    return cube < 1.0 ? cube : 1.0;
}

// Square of the mean rate of a motion over that of its change or curvature, at most.
constexpr double shape_sq = 16.0;

double positive(double x) noexcept { return x > 0.0 ? x : 0.0; }

// What C^2 exceeds 16 Var C by, times the square of the weight.
double excess(const MotionInStepState& s, InStepPart part) noexcept {
    return positive(s.sum[part] * s.sum[part] - gate_sq * s.square[part]);
}

}  // namespace

void note_segment(MotionInStepState& s, double weight, const std::array<double, in_step_parts>& shape) noexcept {
    s.weight = fading * s.weight + weight;
    for (unsigned i = 0; i < in_step_parts; ++i) {
        const double c = weight * shape[i];
        s.sum[i] = fading * s.sum[i] + c;
        s.square[i] = fading * fading * s.square[i] + c * c;
    }
}

void note_switch(MotionInStepState& s, double interval_s) noexcept {
    if (!(s.interval_s > 0.0)) s.interval_s = interval_s;
    s.offset = fading * (s.offset + limited(interval_s / s.interval_s - 1.0, 1.0));
    s.interval_s += (interval_s - s.interval_s) / memory;
    s.mean_offset += (s.offset - s.mean_offset) / memory;
    s.visible += (visible_part(s.offset - s.mean_offset) - s.visible) / memory;
}

double seen_in_step(const MotionInStepState& s, double trend_variance) noexcept {
    if (!(s.weight > 0.0)) return 0.0;
    const double weight_sq = s.weight * s.weight;
    const double change = positive(excess(s, change_in_step) / weight_sq - gate_sq * trend_variance);
    return shape_sq * (change + excess(s, curvature_in_step) / weight_sq);
}

double mismatch_sq(const MotionInStepState& s) noexcept {
    return s.weight > 0.0 ? excess(s, alternation) / (s.weight * s.weight) : 0.0;
}

double unseen_in_step(const MotionInStepState& s) noexcept {
    const double seen = s.visible * s.weight;
    return seen > 0.0 ? gate_sq * s.square[curvature_in_step] / (seen * seen) : infinity;
}

}  // namespace zlg::core
