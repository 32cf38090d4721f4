#pragma once
// Where each parameter lies: in one place of the core's configuration, or in several that must agree.

#include <cstdint>
#include <type_traits>

#include <zlg/wire/parameters.hpp>

#include "packing.hpp"

namespace zlg::wire {

template <class Unit>
[[nodiscard]] constexpr double as_number(core::Quantity<Unit> x) noexcept {
    return x.value();
}
template <class T>
requires std::is_arithmetic_v<T> || std::is_enum_v<T>
[[nodiscard]] constexpr double as_number(T x) noexcept { return static_cast<double>(x); }

// False where the place cannot hold that number, which then stays as it was.
template <class Unit>
[[nodiscard]] constexpr bool put_number(core::Quantity<Unit>& place, double x) noexcept {
    if (!is_number(x)) return false;
    place = core::Quantity<Unit>{x};
    return true;
}
[[nodiscard]] constexpr bool put_number(double& place, double x) noexcept {
    if (!is_number(x)) return false;
    place = x;
    return true;
}
[[nodiscard]] constexpr bool put_number(bool& place, double x) noexcept {
    if (!(x == 0.0 || x == 1.0)) return false;
    place = x == 1.0;
    return true;
}
template <class Integer>
requires std::is_integral_v<Integer>
[[nodiscard]] constexpr bool put_number(Integer& place, double x) noexcept {
    // Whole numbers up to 2^53 are exact in a double.
    constexpr double most = sizeof(Integer) > 4 ? 0x1p53 : 0x1p31 - 1.0;
    constexpr double least = std::is_signed_v<Integer> ? -most : 0.0;
    if (!(x >= least && x <= most)) return false;
    const auto whole = static_cast<Integer>(x);
    if (static_cast<double>(whole) != x) return false;
    place = whole;
    return true;
}
template <class Choice>
requires std::is_enum_v<Choice>
[[nodiscard]] constexpr bool put_number(Choice&, double) noexcept { return false; }

// Call `take` with the places of a key, the first of them the one that is read; not at all for an unknown key.
template <class Control, class Take>
constexpr void at_places_of_health(Control& c, std::uint16_t key, const Take& take) noexcept {
    switch (key) {
        case 0x0601:
            return take(c.commutator.half_ticks);
        case 0x0602:
            return take(c.commutator.tolerance_ticks);
        case 0x0603:
            return take(c.commutator.latch_ticks);
        case 0x0604:
            return take(c.commutator.dither.method);
        case 0x0605:
            return take(c.commutator.dither.random_above_arcsec_s);
        case 0x0606:
            return take(c.commutator.dither.paired_below_arcsec_s);
        case 0x0701:
            return take(c.health.counts_limit);
        case 0x0702:
            return take(c.bias_monitor.presumed_counts);
        case 0x0703:
            return take(c.coil_monitor.tolerance_ratio);
        case 0x0704:
            return take(c.counter_monitor.watches);
        case 0x0705:
            return take(c.light_monitor.noise);
        case 0x0706:
            return take(c.light_monitor.bias_chi);
        case 0x0707:
            return take(c.light_monitor.most_gain);
        case 0x0708:
            return take(c.detuning_monitor.most_change_lambda2);
        case 0x0709:
            return take(c.detuning_monitor.relock_ticks);
        default:
            return;
    }
}

template <class Control, class Take>
constexpr void at_places_of_switching(Control& c, std::uint16_t key, const Take& take) noexcept {
    switch (key) {
        case 0x0301:
            return take(c.half_wave.measurement_sigma);
        case 0x0302:
            return take(c.half_wave.process_sigma);
        case 0x0303:
            return take(c.half_wave.gate);
        case 0x0401:
            return take(c.schedule.kind);
        case 0x0402:
            return take(c.schedule.interval_ticks);
        case 0x0403:
            return take(c.schedule.min_ticks);
        case 0x0404:
            return take(c.schedule.max_ticks);
        case 0x0405:
            return take(c.schedule.presumed.switch_error_arcsec);
        case 0x0406:
            return take(c.schedule.presumed.magnetic_arcsec_s);
        case 0x0501:
            return take(c.mode_switch.gap_ticks);
        case 0x0502:
            return take(c.mode_switch.gap_min_ticks);
        case 0x0503:
            return take(c.mode_switch.settle_ticks);
        case 0x0504:
            return take(c.mode_switch.lock_timeout_ticks);
        case 0x0505:
            return take(c.mode_switch.dark_ticks);
        case 0x0506:
            return take(c.mode_switch.lock_tolerance);
        case 0x0507:
            return take(c.mode_switch.arrival_tolerance);
        default:
            return at_places_of_health(c, key, take);
    }
}

template <class Control, class Take>
constexpr void at_places_of_control(Control& c, std::uint16_t key, const Take& take) noexcept {
    switch (key) {
        case 0x0101:
            return take(c.detector.discriminator_per_lambda);
        case 0x0102:
            return take(c.detector.dark_fraction);
        case 0x0103:
            return take(c.detector.level_min);
        case 0x0104:
            return take(c.detector.level_ticks);
        case 0x0201:
            return take(c.loop.kind);
        case 0x0202:
            return take(c.loop.range.min, c.mode_switch.range.min, c.stroke.range.min);
        case 0x0203:
            return take(c.loop.range.max, c.mode_switch.range.max, c.stroke.range.max);
        case 0x0204:
            return take(c.loop.range.margin, c.mode_switch.range.margin, c.stroke.range.margin);
        case 0x0205:
            return take(c.loop.half_wave);
        case 0x0206:
            return take(c.loop.half_period);
        case 0x0207:
            return take(c.loop.time_constant);
        case 0x0208:
            return take(c.loop.error_limit);
        case 0x0209:
            return take(c.loop.slew_v_s);
        case 0x020A:
            return take(c.loop.watch_limit);
        case 0x020B:
            return take(c.loop.relock_halves);
        case 0x020C:
            return take(c.loop.relock_gain);
        default:
            return at_places_of_switching(c, key, take);
    }
}

template <class Settings, class Take>
constexpr void at_places(Settings& settings, std::uint16_t key, const Take& take) noexcept {
    auto& c = settings.compensation;
    switch (key) {
        case 0x1001:
            return take(c.relock.method);
        case 0x1002:
            return take(c.relock.ticks);
        case 0x1003:
            return take(c.relock.tick);
        case 0x1004:
            return take(c.relock.scale, c.bridge.count, c.bridge.optimal.counter_step, c.magnetic.count,
                        settings.control.commutator.dither.scale_arcsec);
        case 0x1005:
            return take(c.relock.bias);
        case 0x1006:
            return take(c.relock.chi);
        case 0x1007:
            return take(c.relock.temperature_coefficient_per_c);
        case 0x1008:
            return take(c.relock.reference_temperature);
        case 0x1009:
            return take(c.relock.light_noise);
        case 0x100A:
            return take(c.relock.light_samples);
        case 0x1101:
            return take(c.bridge.method);
        case 0x1102:
            return take(c.bridge.extrapolation_points);
        case 0x1103:
            return take(c.bridge.points_before);
        case 0x1104:
            return take(c.bridge.points_after);
        case 0x1201:
            return take(c.random_walk, c.magnetic.walk);
        case 0x1202:
            return take(c.timer);
        case 0x1301:
            return take(c.magnetic.method);
        case 0x1302:
            return take(c.magnetic.presumed_arcsec_s);
        case 0x1303:
            return take(c.magnetic.presumed_sigma_arcsec_s);
        case 0x1304:
            return take(c.magnetic.thermal_time);
        default:
            return at_places_of_control(settings.control, key, take);
    }
}

}  // namespace zlg::wire
