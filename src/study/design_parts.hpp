#pragma once
// The parts of a design: substitution and loop, each from one configuration.

#include <zlg/config/config.hpp>
#include <zlg/design/substitution.hpp>
#include <zlg/study/design_lines.hpp>

namespace zlg::study {

[[nodiscard]] design::Points points_of(const config::Compensation& compensation);

// The highest order that the points allow, at most 4.
[[nodiscard]] int highest_order(const config::Compensation& compensation);

// For every sine of the motion; for a sum of them also for all together; for a recorded motion for that record.
[[nodiscard]] std::vector<SubstitutionLine> substitution_lines(const config::Config& config);

[[nodiscard]] LoopLine loop_line(const config::Config& config);

// Angle that re-lock leaves in each tick after the gap, arcsec: without correction what the loop makes of the
// configured miss; with one the standard deviation that the light noise gives to a mean-square correction of it.
struct RelockResidual {
    bool random = false;
    std::vector<double> tick_arcsec;
};
[[nodiscard]] RelockResidual relock_residual(const config::Config& config);

}  // namespace zlg::study
