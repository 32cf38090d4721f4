#pragma once
// The faults of a run, in time: which of them act in the present half.

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include <zlg/twin/faults.hpp>

namespace zlg::twin {

class FaultPlan {
public:
    explicit FaultPlan(const std::vector<Fault>& faults);

    [[nodiscard]] bool is_empty() const { return faults_.empty(); }
    // In the order of their start.
    [[nodiscard]] std::span<const Fault> all() const { return faults_; }

    // Enter the half from start_s to end_s; never an earlier one than before.
    void enter(double start_s, double end_s);

    // When the next one begins; infinite after the last.
    [[nodiscard]] double next_s() const {
        return next_ < faults_.size() ? faults_[next_].at_s : std::numeric_limits<double>::infinity();
    }

    // Those that have begun by the end of the half and were not over at its start.
    [[nodiscard]] std::span<const Fault> active() const { return active_; }
    // Lasting effect of the faults that are over: shift of the perimeter and of the temperature.
    [[nodiscard]] double settled_lambda() const { return settled_lambda_; }
    [[nodiscard]] double settled_c() const { return settled_c_; }

    // Whether the perimeter, or the light, is not what it would be without faults.
    [[nodiscard]] bool moves_perimeter() const { return moves_perimeter_; }
    [[nodiscard]] bool dims_light() const { return dims_light_; }

private:
    void settle(const Fault& fault);

    std::vector<Fault> faults_;
    std::size_t next_ = 0;  // the first that has not begun
    std::vector<Fault> active_;
    double settled_lambda_ = 0.0;
    double settled_c_ = 0.0;
    bool moves_perimeter_ = false;
    bool dims_light_ = false;
};

// From 0 at the start of a fault to 1 at its end; 1 at once for a fault of no duration.
[[nodiscard]] inline double progress(const Fault& fault, double time_s) {
    if (time_s < fault.at_s) return 0.0;
    const double since_s = time_s - fault.at_s;
    return since_s < fault.duration_s ? since_s / fault.duration_s : 1.0;
}

[[nodiscard]] inline bool acts_at(const Fault& fault, double time_s) {
    return time_s >= fault.at_s && time_s < fault.at_s + fault.duration_s;
}

// Part of the time from start_s to end_s in which a fault acts.
[[nodiscard]] double share(const Fault& fault, double start_s, double end_s);

}  // namespace zlg::twin
