#pragma once
// From one configuration to the parameters of each part, so that twin and core agree by construction.

#include <cstdint>

#include <zlg/config/config.hpp>
#include <zlg/core/common/discriminator_curve.hpp>
#include <zlg/core/gyro_compensation.hpp>
#include <zlg/core/gyro_control.hpp>
#include <zlg/twin/motion.hpp>
#include <zlg/twin/twin.hpp>

namespace zlg::rig {

using twin::timer_hz;

// errors  config::ConfigError for the kind "file": a recorded motion is read by recorded::motion.
[[nodiscard]] twin::Motion motion(const config::Config& config);

// The angle increment that a value of the column of a motion file stands for, arcsec.
[[nodiscard]] inline double motion_increment_arcsec(const config::Motion& motion, double value) {
    const double scaled = value * motion.scale_arcsec;
    return motion.column_holds == config::ColumnHolds::rate ? scaled / motion.rate_hz : scaled;
}

// Whole ticks of the run: duration_s where it is set, else 3600 s or the length of the motion file.
//
// errors  config::ConfigError where the run is longer than the motion file or shorter than a tick.
[[nodiscard]] std::int64_t run_ticks(const config::Config& config, const twin::Motion& motion);

// errors  config::ConfigError: what `config::check` says, and faults that do not fit the run.
[[nodiscard]] twin::TwinConfig twin_config(const config::Config& config);

// From what a slope alone has read of a signal to the detuning at which [perimeter] says that the signal was found; the
// linear law where it says nothing.
//
// slope_per_lambda  with which the signal was read; not 0.
// errors            config::ConfigError where the points make no curve.
[[nodiscard]] core::DiscriminatorCurve discriminator_curve(const config::Config& config, double slope_per_lambda);

// errors  config::ConfigError: the keys from which a refused value comes, their values, and what is allowed.
[[nodiscard]] core::GyroControlConfig control_config(const config::Config& config);
[[nodiscard]] core::GyroCompensationConfig compensation_config(const config::Config& config, core::RelockMethod relock,
                                                               core::BridgeMethod bridge);

// A configuration whose gyro stays in its first mode.
[[nodiscard]] config::Config without_switching(config::Config config);

}  // namespace zlg::rig
