#include "control_refusal.hpp"

#include <zlg/config/schema.hpp>
#include <zlg/rig/refusal.hpp>

namespace zlg::rig {
namespace {

// What the core's check refuses, by the keys that it comes from. Single numbers that it would refuse, the table of keys does not
// allow; these are rules between them.
void require_loop(const config::Config& config, const core::PerimeterLoopConfig& loop) {
    switch (check(loop)) {
        case core::PerimeterLoopFault::none:
        case core::PerimeterLoopFault::watch_limit:
            return;
        case core::PerimeterLoopFault::range:
            refuse(config, {"piezo.range_min_v", "piezo.range_max_v"},
                   "above -1e6 to below 1e6 V, the first the lower");
        case core::PerimeterLoopFault::half_wave:
            refuse(config, {"piezo.half_wave_v", "piezo.half_wave_error"},
                   "a presumed half-wave voltage, half_wave_v (1 + half_wave_error), of 1e-3..1e6 V");
        case core::PerimeterLoopFault::half_period:
            refuse(config, {"gyro.tick_s"}, "above 0 up to 1e3 s");
        case core::PerimeterLoopFault::time_constant:
            refuse(config, {"perimeter.tau_s", "perimeter.settled_tau_s"}, "up to 1e6 s");
        case core::PerimeterLoopFault::error_limit:
            refuse(config, {"perimeter.limit_lambda"}, "above 0 up to 1e3");
        case core::PerimeterLoopFault::slew:
            refuse(config, {"piezo.slew_v_s"}, "above 0 up to 1e12 V/s");
        case core::PerimeterLoopFault::relock:
            refuse(config, {"perimeter.sample_gain", "gyro.light_samples", "perimeter.relock_halves", "piezo.rc_s"},
                   "a gain 1 - (1 - sample_gain)^light_samples above 0, and piezo.rc_s of 1e-9..1e3 s");
    }
}

}  // namespace

void require_control(const config::Config& config, const core::GyroControlConfig& made) {
    switch (check(made)) {
        case core::GyroControlFault::none:
            return;
        case core::GyroControlFault::detector:
            refuse(config,
                   {"gyro.discriminator_per_lambda", "perimeter.discriminator_detuning_lambda",
                    "perimeter.discriminator_signal"},
                   "a slope of size 1e-6..1e6, and a curve that grows, up to 1e3 wavelengths by that slope");
        case core::GyroControlFault::loop:
            require_loop(config, made.loop);
            break;
        case core::GyroControlFault::half_wave:
        case core::GyroControlFault::stroke:
        case core::GyroControlFault::temperature:
            refuse(config, {"piezo.half_wave_v", "piezo.half_wave_error", "gyro.reference_temperature_c"},
                   "a presumed half-wave voltage of 1e-3..1e6 V, and a temperature above -1e6 to below 1e6 C");
        case core::GyroControlFault::fringe:
            refuse(config, {"gyro.readout", "photodiodes.noise", "laser.comparator_threshold"},
                   "a phase of less than 1/20 of a turn of noise, and comparators that follow it within 1/8");
        case core::GyroControlFault::schedule:
            refuse(config,
                   {"switching.interval_s", "switching.interval_min_s", "switching.interval_max_s", "gyro.tick_s",
                    "switching.switch_error_arcsec", "switching.magnetic_arcsec_s"},
                   "intervals of 1..2^53 ticks, and presumed errors above 0 up to 1e12");
        case core::GyroControlFault::mode_switch:
        case core::GyroControlFault::ranges_differ:
            refuse(config,
                   {"piezo.range_min_v", "piezo.range_max_v", "switching.gap_ticks", "switching.gap_min_ticks",
                    "perimeter.tau_s", "gyro.tick_s"},
                   "a range within +-1e6 V, and up to 2^24 ticks for a gap and for 12 time constants of the loop");
        case core::GyroControlFault::commutator:
            refuse(config, {"gyro.tick_s", "gyro.dither"}, "a tick of 1e-6..800 s, where edges shift from 1.6e-6 s on");
        case core::GyroControlFault::health:
        case core::GyroControlFault::monitors:
            refuse(config, {"gyro.bias_hz", "gyro.bias_chi", "gyro.light_noise_lambda", "gyro.tick_s"},
                   "what makes finite counts in a half");
    }
    throw config::ConfigError{named(config, "the control refuses this gyro")};
}

}  // namespace zlg::rig
