#pragma once
// The angular acceleration that is required, as a motion.

#include <zlg/choice/requirement.hpp>
#include <zlg/twin/motion.hpp>

namespace zlg::choice {

inline constexpr double ramp_s = 1.0;

// `base`, and beside it a ramp over each switch of a fixed schedule, up and down in turn, whose start lies evenly
// within the second before the switch; of another schedule, whose switches nobody knows before, ramps up and down
// without a pause. The base alone where no acceleration is required.
[[nodiscard]] twin::Motion with_ramps(const Requirement& requirement, const config::Config& gyro, twin::Motion base);

}  // namespace zlg::choice
