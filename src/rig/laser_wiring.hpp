#pragma once
// What [laser] means to the twin and to the processor.

#include <zlg/config/config.hpp>
#include <zlg/twin/laser_config.hpp>

namespace zlg::rig {

// A beam that runs may be faint: at 0.22 wavelength the weaker one of the default laser has a fifth of its light. One that
// does not run has noise alone.
inline constexpr double laser_dark_fraction = 0.1;

[[nodiscard]] int counts_per_fringe(const config::Config& config);

[[nodiscard]] twin::LaserConfig laser_of(const config::Laser& laser);
[[nodiscard]] twin::BeatConfig beats_of(const config::Config& config);

}  // namespace zlg::rig
