#pragma once
// What is presumed of the photodiodes of the beat, where they are read.

#include <zlg/config/config.hpp>
#include <zlg/core/control/fringe_readout.hpp>

namespace zlg::rig {

// Of `gyro.readout = "count"` it reads nothing.
[[nodiscard]] core::FringeReadoutConfig fringe_readout_of(const config::Config& config);

// Noise of a place within the count, rms: by the noise and the converter of the photodiodes.
[[nodiscard]] double fringe_noise_counts(const config::Config& config);

}  // namespace zlg::rig
