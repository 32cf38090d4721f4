#pragma once
// The twin's faults as the configuration tells them.

#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/twin/faults.hpp>

namespace zlg::rig {

inline constexpr double default_duration_s = 3600.0;  // of a run without run.duration_s whose motion has no end

// Those listed one by one, then the random ones of a run of this length.
//
// config  checked: its lists are equally long.
// errors  config::ConfigError for too many random faults, and where random faults are asked for and only a motion file
// tells how
//         long the run is.
[[nodiscard]] std::vector<twin::Fault> faults_of(const config::Config& config);

}  // namespace zlg::rig
