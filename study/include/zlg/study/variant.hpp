#pragma once
// One way to compensate a run, and what comes of it.

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include <zlg/core/gyro_compensation.hpp>
#include <zlg/study/switch_window.hpp>

namespace zlg::study {

// Final minus true angle from gap tick 1 to the last tick of the re-lock.
struct SwitchError {
    SwitchWindow window;
    double error_arcsec = 0.0;
    double relock_arcsec = 0.0;  // that was subtracted
};

// Mean after multiplication by the sign of the false drift, which alternates.
struct SwitchStatistics {
    double mean_arcsec = 0.0;
    double rms_arcsec = 0.0;
    double max_arcsec = 0.0;
};

// nullopt without a switch.
[[nodiscard]] std::optional<SwitchStatistics> statistics(const std::vector<SwitchError>& errors);

// Least-squares slope of the angle error over time, without keeping the points.
class Drift {
public:
    void add(double t_s, double error_arcsec);
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

// Compares the final rows of one compensation with the truth.
class ErrorMeter {
public:
    // stride  ticks between two points of the curve.
    ErrorMeter(double tick_s, std::int64_t stride) : tick_s_{tick_s}, stride_{stride} {}

    // A final row, the true increment of its tick, and the switches known by now, oldest first.
    void take(const core::AngleRow& row, double true_arcsec, const std::deque<SwitchWindow>& windows);

    // The run has ended: a switch whose window is not over is dropped.
    [[nodiscard]] const std::vector<SwitchError>& switches() const { return done_; }
    [[nodiscard]] double drift_arcsec_s() const { return drift_.slope_arcsec_s(); }
    [[nodiscard]] double angle_error_arcsec() const { return error_.value(); }
    [[nodiscard]] const Curve& curve() const { return curve_; }

private:
    double tick_s_;
    std::int64_t stride_;
    core::ExactSum error_;
    Drift drift_;
    Curve curve_;
    std::optional<SwitchError> current_;
    std::vector<SwitchError> done_;
};

}  // namespace zlg::study
