#pragma once
// The re-locks of all logs that can be compared with each other, and how long their transient lasts.

#include <cmath>
#include <span>
#include <vector>

#include <zlg/calibration/lab_log.hpp>

namespace zlg::calibration {

struct RelockView {
    const LabLog* log;
    const Relock* relock;
    double counts_per_half = 0.0;  // of the settled rest of the segment: rotation and drift
    bool with_phase = false;       // of this re-lock, as of all: the places within the count are known
};

inline double square(double x) { return x * x; }

// A half as two equal groups of samples.
struct Groups {
    double above;
    double below;

    Groups(const core::HalfRecord& r, double noise_lambda2) {
        const double spread2 = r.detuning_sq_lambda2 - square(r.detuning_lambda) - noise_lambda2;
        const double spread = std::sqrt(std::fmax(spread2, 0.0));
        above = r.detuning_lambda + spread;
        below = r.detuning_lambda - spread;
    }
    [[nodiscard]] double farthest() const { return std::fmax(std::abs(above), std::abs(below)); }
};

struct Relocks {
    std::vector<RelockView> views;
    std::size_t transient_halves = 0;   // until the mean excess of the mean square is below 1 % of its highest
    double first_square_lambda2 = 0.0;  // mean excess in the first half
    double steepest_fall = 1.0;         // least ratio of the mean excess of a half to that before

    // Re-locks with mean squares in every half, and a settled rest that is four times as long as the transient kept.
    explicit Relocks(std::span<const LabLog> logs);

    [[nodiscard]] bool has_detunings() const;
};

}  // namespace zlg::calibration
