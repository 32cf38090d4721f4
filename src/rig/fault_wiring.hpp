#pragma once
// The twin's faults as the configuration tells them.

#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/twin/faults.hpp>

namespace zlg::rig {

// Those told one by one, then the random ones of a run of this length.
//
// errors  config::ConfigError for lists of unequal length, for too many random faults, and where random faults are asked
//         for and only a motion file tells how long the run is.
[[nodiscard]] std::vector<twin::Fault> faults_of(const config::Config& config);

}  // namespace zlg::rig
