#pragma once
// The perimeter through one half, remembered: light and phases look at it at times of their own.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "perimeter.hpp"

namespace zlg::twin {

class PerimeterCourse {
public:
    PerimeterCourse(int n_steps, double half_s)
        : node_(static_cast<std::size_t>(n_steps) + 1), steps_per_s_{n_steps / half_s} {}

    // Step the perimeter through the half that it has begun.
    void live(Perimeter& perimeter) {
        double least = node_[0] = perimeter.length_lambda();
        double most = least;
        for (std::size_t k = 1; k < node_.size(); ++k) {
            perimeter.step();
            node_[k] = perimeter.length_lambda();
            least = std::min(least, node_[k]);
            most = std::max(most, node_[k]);
        }
        spread_lambda_ = most - least;
    }

    [[nodiscard]] double after_step(std::size_t k) const { return node_[k]; }
    [[nodiscard]] double spread_lambda() const { return spread_lambda_; }

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
    double spread_lambda_ = 0.0;
};

}  // namespace zlg::twin
