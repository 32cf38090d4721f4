#pragma once
// What the page compares the configured compensation with.

#include <zlg/config/config.hpp>

namespace zlg::lab {

// The same gyro, its gaps bridged from the points of the paper, whatever the configuration takes.
[[nodiscard]] inline config::Config with_points_of_paper(config::Config config) {
    const config::Compensation paper;
    config.compensation.extrapolation_points = paper.extrapolation_points;
    config.compensation.points_before = paper.points_before;
    config.compensation.points_after = paper.points_after;
    return config;
}

}  // namespace zlg::lab
