#pragma once
// The perimeter through one half, remembered: light and phases look at it at times of their own.

#include <cstddef>
#include <span>
#include <vector>

#include "perimeter.hpp"

namespace zlg::twin {

class PerimeterCourse {
public:
    PerimeterCourse(int n_steps, double half_s)
        : node_(static_cast<std::size_t>(n_steps) + 1), steps_per_s_{n_steps / half_s} {}

    // Live through the half that the perimeter has begun.
    void live(Perimeter& perimeter) { was_linear_ = perimeter.live(node_); }
    // As Perimeter::live says.
    [[nodiscard]] bool was_linear() const { return was_linear_; }

    // Length after each step; the first is that before them.
    [[nodiscard]] std::span<const double> nodes() const { return node_; }
    [[nodiscard]] double after_step(std::size_t k) const { return node_[k]; }

    // The shortest and the longest length.
    struct Ends {
        double least_lambda;
        double most_lambda;
    };

    [[nodiscard]] Ends ends() const {
        Ends ends{node_.front(), node_.front()};
        for (const double x : node_) {
            ends.least_lambda = x < ends.least_lambda ? x : ends.least_lambda;
            ends.most_lambda = x > ends.most_lambda ? x : ends.most_lambda;
        }
        return ends;
    }

    // Straight between the steps; beyond the half, what it begins or ends with.
    [[nodiscard]] double at(double time_s) const {
        const double place = time_s * steps_per_s_;
        if (!(place > 0.0)) return node_.front();
        const auto k = static_cast<std::size_t>(place);
        if (k + 1 >= node_.size()) return node_.back();
        return node_[k] + (place - static_cast<double>(k)) * (node_[k + 1] - node_[k]);
    }

private:
    std::vector<double> node_;
    double steps_per_s_;
    bool was_linear_ = false;
};

}  // namespace zlg::twin
