#include <array>

#include <zlg/wire/parameters.hpp>

namespace zlg::wire {
namespace {

struct Name {
    std::uint16_t key;
    std::string_view name;
};

constexpr std::array names{
    Name{0x0101, "detector.discriminator_per_lambda"},
    Name{0x0102, "detector.dark_fraction"},
    Name{0x0103, "detector.level_min"},
    Name{0x0104, "detector.level_ticks"},
    Name{0x0201, "loop.kind"},
    Name{0x0202, "loop.range_min_v"},
    Name{0x0203, "loop.range_max_v"},
    Name{0x0204, "loop.range_margin_v"},
    Name{0x0205, "loop.half_wave_v"},
    Name{0x0206, "loop.half_period_s"},
    Name{0x0207, "loop.time_constant_s"},
    Name{0x0208, "loop.error_limit_lambda"},
    Name{0x0209, "loop.slew_v_s"},
    Name{0x020A, "loop.watch_limit_lambda"},
    Name{0x020B, "loop.relock_halves"},
    Name{0x020C, "loop.relock_gain"},
    Name{0x0301, "half_wave.measurement_sigma_v"},
    Name{0x0302, "half_wave.process_sigma_v"},
    Name{0x0303, "half_wave.gate"},
    Name{0x0401, "schedule.kind"},
    Name{0x0402, "schedule.interval_ticks"},
    Name{0x0403, "schedule.min_ticks"},
    Name{0x0404, "schedule.max_ticks"},
    Name{0x0405, "schedule.presumed_switch_error_arcsec"},
    Name{0x0406, "schedule.presumed_magnetic_arcsec_s"},
    Name{0x0501, "mode_switch.gap_ticks"},
    Name{0x0502, "mode_switch.gap_min_ticks"},
    Name{0x0503, "mode_switch.settle_ticks"},
    Name{0x0504, "mode_switch.lock_timeout_ticks"},
    Name{0x0505, "mode_switch.dark_ticks"},
    Name{0x0506, "mode_switch.lock_tolerance_lambda"},
    Name{0x0507, "mode_switch.arrival_tolerance_lambda"},
    Name{0x0601, "commutator.half_ticks"},
    Name{0x0602, "commutator.tolerance_ticks"},
    Name{0x0603, "commutator.latch_ticks"},
    Name{0x0604, "commutator.dither.method"},
    Name{0x0605, "commutator.dither.random_above_arcsec_s"},
    Name{0x0606, "commutator.dither.paired_below_arcsec_s"},
    Name{0x0701, "health.counts_limit"},
    Name{0x0702, "bias_monitor.presumed_counts"},
    Name{0x0703, "coil_monitor.tolerance_ratio"},
    Name{0x0704, "counter_monitor.watches"},
    Name{0x0705, "light_monitor.noise_lambda"},
    Name{0x0706, "light_monitor.bias_chi"},
    Name{0x0707, "light_monitor.most_gain"},
    Name{0x0708, "detuning_monitor.most_change_lambda2"},
    Name{0x0709, "detuning_monitor.relock_ticks"},
    Name{0x1001, "relock.method"},
    Name{0x1002, "relock.ticks"},
    Name{0x1003, "relock.tick_s"},
    Name{0x1004, "relock.scale_arcsec"},
    Name{0x1005, "relock.bias_hz"},
    Name{0x1006, "relock.chi"},
    Name{0x1007, "relock.temperature_coefficient_per_c"},
    Name{0x1008, "relock.reference_temperature_c"},
    Name{0x1009, "relock.light_noise_lambda"},
    Name{0x100A, "relock.light_samples"},
    Name{0x1101, "bridge.method"},
    Name{0x1102, "bridge.extrapolation_points"},
    Name{0x1103, "bridge.points_before"},
    Name{0x1104, "bridge.points_after"},
    Name{0x1201, "random_walk_arcsec_sqrt_s"},
    Name{0x1202, "timer_hz"},
    Name{0x1301, "magnetic.method"},
    Name{0x1302, "magnetic.presumed_arcsec_s"},
    Name{0x1303, "magnetic.presumed_sigma_arcsec_s"},
    Name{0x1304, "magnetic.thermal_time_s"},
};

}  // namespace

std::string_view parameter_name(std::uint16_t key) noexcept {
    for (const Name& known : names)
        if (known.key == key) return known.name;
    return {};
}

}  // namespace zlg::wire
