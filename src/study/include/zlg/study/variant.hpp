#pragma once
// One way to compensate a run, and what comes of it.

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <zlg/core/gyro_compensation.hpp>
#include <zlg/study/gyro_drift.hpp>
#include <zlg/study/switch_window.hpp>

namespace zlg::study {

// What stays in the angle for ever, from gap tick 1 to the last tick of the re-lock, without the drift in it, which is
// no error of the switch:
//
//   sum (final - true) + r_before - r_end - T sum nm - T sum_measured (m Om - taken out)
//
// with r the rounding of the counter, counter less phase, at the end of the tick before the gap and of the last tick:
// the next ticks give the latter back, and the former is part of the final angle before. Both edges of the gap keep
// theirs. m Om is the magnetic drift in the mode m of a measured tick. In the gap it counts as nothing: the mean of the
// modes before and after. The random walk of these ticks is not known to anyone and stays in. docs/accuracy.md has the
// same.
struct SwitchError {
    SwitchWindow window;
    double error_arcsec = 0.0;
    double relock_arcsec = 0.0;  // that was subtracted
    bool unrepaired = false;     // the gap was too long for the bridge, or had no points: sigma is not known
};

// Mean after multiplication by the sign of the false drift, which alternates.
struct SwitchStatistics {
    double mean_arcsec = 0.0;
    double rms_arcsec = 0.0;
    double max_arcsec = 0.0;
};

// Of those whose gap was repaired: nullopt without one.
[[nodiscard]] std::optional<SwitchStatistics> statistics(const std::vector<SwitchError>& errors);

// Least-squares slope of the angle error over time, without keeping the points.
class Drift {
public:
    void add(double t_s, double error_arcsec);
    // So many times, of the last the time and the error, from what was added last on a straight line.
    void add(double n, double step_s, double t_s, double from_arcsec, double error_arcsec);
    [[nodiscard]] double slope_arcsec_s() const;  // 0 with fewer than two points

private:
    double n_ = 0.0;
    double mean_t_ = 0.0;
    double mean_e_ = 0.0;
    double tt_ = 0.0;
    double te_ = 0.0;
};

struct Curve {
    std::vector<double> t_s;
    std::vector<double> error_arcsec;
};

// What is true of a tick.
struct TickTruth {
    double rotation_arcsec = 0.0;
    double taken_out_arcsec = 0.0;  // of the magnetic drift, by the compensation
    double rounding_arcsec = 0.0;   // counter less phase, at the end of the tick; 0 where it is not known
};

// Compares the final rows of one compensation with the truth.
class ErrorMeter {
public:
    // stride  ticks between two points of the curve.
    // drift   of the gyro.
    ErrorMeter(double tick_s, std::int64_t stride, RunDrift drift)
        : tick_s_{tick_s}, stride_{stride}, drift_law_{std::move(drift)} {}

    // A final row, what is true of its tick, and the switches known by now, oldest first.
    void take(const core::AngleRow& row, const TickTruth& truth, const std::deque<SwitchWindow>& windows);

    // Ticks without a row, none of a switch: what they add to the angle, less what is true of them.
    void leap(std::int64_t ticks, double error_arcsec);

    // The run has ended: a switch whose window is not over is dropped.
    [[nodiscard]] const std::vector<SwitchError>& switches() const { return done_; }

    // For whoever runs without end: those until now are no longer among `switches`.
    void forget_switches() { done_.clear(); }
    [[nodiscard]] double drift_arcsec_s() const { return drift_.slope_arcsec_s(); }
    // Without the constant part that both modes share, which a measurement removes with its bias.
    [[nodiscard]] double drift_without_nonmagnetic_arcsec_s() const {
        return drift_arcsec_s() - drift_law_.nonmagnetic_arcsec_s();
    }
    [[nodiscard]] double angle_error_arcsec() const { return error_.value(); }
    [[nodiscard]] double angle_error_without_nonmagnetic_arcsec() const {
        return angle_error_arcsec() - drift_law_.nonmagnetic_arcsec_s() * tick_s_ * static_cast<double>(n_ticks_);
    }
    [[nodiscard]] const Curve& curve() const { return curve_; }

private:
    [[nodiscard]] double drift_arcsec(const core::AngleRow& row, const TickTruth& truth,
                                      const SwitchWindow& window) const;

    double tick_s_;
    std::int64_t stride_;
    RunDrift drift_law_;
    std::int64_t n_ticks_ = 0;
    core::ExactSum error_;
    Drift drift_;
    Curve curve_;
    double rounding_before_arcsec_ = 0.0;
    std::optional<SwitchError> current_;
    std::vector<SwitchError> done_;
};

// What one compensation of a run gave.
struct VariantResult {
    std::string name;
    std::string meaning;          // in words
    double drift_arcsec_s = 0.0;  // least-squares slope of the angle error over the run
    double drift_without_nonmagnetic_arcsec_s = 0.0;
    double angle_error_arcsec = 0.0;  // at the end
    double angle_error_without_nonmagnetic_arcsec = 0.0;
    std::optional<SwitchStatistics> switch_error;
    std::int64_t unrepaired = 0;  // switches that are not in it
    std::vector<SwitchError> switches;
    Curve curve;
};

}  // namespace zlg::study
