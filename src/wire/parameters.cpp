#include <zlg/wire/parameters.hpp>

#include <array>
#include <bit>
#include <limits>
#include <tuple>
#include <type_traits>

#include <zlg/wire/crc.hpp>

#include "packing.hpp"

namespace zlg::wire {
namespace {

constexpr auto rw = ParameterAccess::read_write;
constexpr auto ro = ParameterAccess::read_only;

// `at` gives the place of a parameter in a section, or by std::tie the places that must agree, of which the first is
// read.
template <auto Section, class At>
struct Parameter {
    ParameterInfo info;
    std::string_view name;
    At at;
};

template <class At>
constexpr Parameter<&GyroSettings::control, At> control(std::uint16_t key, ParameterAccess access,
                                                        std::string_view name, At at) {
    return {{key, access}, name, at};
}
template <class At>
constexpr Parameter<&GyroSettings::compensation, At> compensation(std::uint16_t key, ParameterAccess access,
                                                                  std::string_view name, At at) {
    return {{key, access}, name, at};
}
template <class At>
constexpr Parameter<nullptr, At> anywhere(std::uint16_t key, ParameterAccess access, std::string_view name, At at) {
    return {{key, access}, name, at};
}

#define PLACE(member) \
    [](auto& c) -> auto& { return c.member; }
// clang-format off
constexpr std::tuple table{
    control(0x0101, rw, "detector.discriminator_per_lambda", PLACE(detector.discriminator_per_lambda)),
    control(0x0102, rw, "detector.dark_fraction", PLACE(detector.dark_fraction)),
    control(0x0103, rw, "detector.level_min", PLACE(detector.level_min)),
    control(0x0104, rw, "detector.level_ticks", PLACE(detector.level_ticks)),
    control(0x0201, ro, "loop.kind", PLACE(loop.kind)),
    control(0x0202, ro, "loop.range_min_v",
            [](auto& c) { return std::tie(c.loop.range.min, c.mode_switch.range.min, c.half_wave.range.min); }),
    control(0x0203, ro, "loop.range_max_v",
            [](auto& c) { return std::tie(c.loop.range.max, c.mode_switch.range.max, c.half_wave.range.max); }),
    control(0x0204, rw, "loop.range_margin_v",
        [](auto& c) { return std::tie(c.loop.range.margin, c.mode_switch.range.margin, c.half_wave.range.margin); }),
    control(0x0205, ro, "loop.half_wave_v", PLACE(loop.half_wave)),
    control(0x0206, ro, "loop.half_period_s", PLACE(loop.half_period)),
    control(0x0207, rw, "loop.time_constant_s", PLACE(loop.time_constant)),
    control(0x0208, rw, "loop.error_limit_lambda", PLACE(loop.error_limit)),
    control(0x0209, rw, "loop.slew_v_s", PLACE(loop.slew_v_s)),
    control(0x020A, rw, "loop.watch_limit_lambda", PLACE(loop.watch_limit)),
    control(0x020B, rw, "loop.relock_halves", PLACE(loop.relock_halves)),
    control(0x020C, rw, "loop.relock_gain", PLACE(loop.relock_gain)),
    control(0x0401, ro, "schedule.kind", PLACE(schedule.kind)),
    control(0x0402, rw, "schedule.interval_ticks", PLACE(schedule.interval_ticks)),
    control(0x0403, rw, "schedule.min_ticks", PLACE(schedule.min_ticks)),
    control(0x0404, rw, "schedule.max_ticks", PLACE(schedule.max_ticks)),
    control(0x0405, rw, "schedule.presumed_switch_error_arcsec", PLACE(schedule.presumed.switch_error_arcsec)),
    control(0x0406, rw, "schedule.presumed_magnetic_arcsec_s", PLACE(schedule.presumed.magnetic_arcsec_s)),
    control(0x0501, rw, "mode_switch.gap_ticks", PLACE(mode_switch.gap_ticks)),
    control(0x0502, rw, "mode_switch.gap_min_ticks", PLACE(mode_switch.gap_min_ticks)),
    control(0x0503, rw, "mode_switch.settle_ticks", PLACE(mode_switch.settle_ticks)),
    control(0x0504, rw, "mode_switch.lock_timeout_ticks", PLACE(mode_switch.lock_timeout_ticks)),
    control(0x0505, rw, "mode_switch.dark_ticks", PLACE(mode_switch.dark_ticks)),
    control(0x0506, rw, "mode_switch.lock_tolerance_lambda", PLACE(mode_switch.lock_tolerance)),
    control(0x0507, rw, "mode_switch.arrival_tolerance_lambda", PLACE(mode_switch.arrival_tolerance)),
    control(0x0601, ro, "commutator.half_ticks", PLACE(commutator.half_ticks)),
    control(0x0602, rw, "commutator.tolerance_ticks", PLACE(commutator.tolerance_ticks)),
    control(0x0603, rw, "commutator.latch_ticks", PLACE(commutator.latch_ticks)),
    control(0x0604, ro, "commutator.dither.method", PLACE(commutator.dither.method)),
    control(0x0605, rw, "commutator.dither.random_above_arcsec_s", PLACE(commutator.dither.random_above_arcsec_s)),
    control(0x0606, rw, "commutator.dither.paired_below_arcsec_s", PLACE(commutator.dither.paired_below_arcsec_s)),
    control(0x0701, rw, "health.counts_limit", PLACE(limits.counts)),
    control(0x0702, rw, "bias_monitor.presumed_counts", PLACE(limits.bias_counts)),
    control(0x0703, rw, "coil_monitor.tolerance_ratio", PLACE(limits.coil_ratio)),
    control(0x0705, rw, "light_monitor.noise_lambda", PLACE(limits.light_noise)),
    control(0x0706, rw, "light_monitor.bias_chi", PLACE(limits.bias_chi)),
    control(0x0707, rw, "light_monitor.max_gain", PLACE(limits.light_gain)),
    control(0x0708, rw, "detuning_monitor.max_change_lambda2", PLACE(limits.detuning_change_lambda2)),
    control(0x0709, rw, "detuning_monitor.relock_ticks", PLACE(limits.relock_ticks)),
    control(0x0801, ro, "fringe.reads", PLACE(fringe.reads)),
    control(0x0802, ro, "fringe.counts_per_turn", PLACE(fringe.counts_per_turn)),
    control(0x0803, rw, "fringe.amplitude", PLACE(fringe.amplitude)),
    control(0x0804, rw, "fringe.limit", PLACE(fringe.limit)),
    control(0x0805, rw, "fringe.noise_turns", PLACE(fringe.noise_turns)),
    control(0x0806, rw, "fringe.lag_turns", PLACE(fringe.lag_turns)),
    control(0x0807, rw, "fringe.max_skew_turns", PLACE(fringe.max_skew_turns)),
    control(0x0808, rw, "fringe.turned_back_turns", PLACE(fringe.turned_back_turns)),
    compensation(0x1001, ro, "relock.method", PLACE(relock.method)),
    compensation(0x1002, rw, "relock.ticks", PLACE(relock.ticks)),
    compensation(0x1003, ro, "relock.tick_s", PLACE(gyro.tick)),
    anywhere(0x1004, rw, "relock.scale_arcsec",
            [](auto& s) { return std::tie(s.compensation.gyro.scale, s.control.commutator.dither.scale_arcsec); }),
    compensation(0x1005, rw, "relock.bias_hz", PLACE(gyro.bias)),
    compensation(0x1006, rw, "relock.chi", PLACE(gyro.chi)),
    compensation(0x1007, rw, "relock.temperature_coefficient_per_c", PLACE(gyro.temperature_coefficient_per_c)),
    compensation(0x1008, rw, "relock.reference_temperature_c", PLACE(gyro.reference_temperature)),
    compensation(0x1009, rw, "relock.light_noise_lambda", PLACE(gyro.light_noise)),
    compensation(0x100A, ro, "relock.light_samples", PLACE(gyro.light_samples)),
    compensation(0x100B, rw, "fringe_noise_counts", PLACE(gyro.fringe_noise_counts)),
    compensation(0x1101, ro, "bridge.method", PLACE(bridge.method)),
    compensation(0x1102, ro, "bridge.extrapolation_points", PLACE(bridge.extrapolation_points)),
    compensation(0x1103, ro, "bridge.points_before", PLACE(bridge.points_before)),
    compensation(0x1104, ro, "bridge.points_after", PLACE(bridge.points_after)),
    compensation(0x1201, rw, "random_walk_arcsec_sqrt_s", PLACE(gyro.random_walk)),
    compensation(0x1202, ro, "timer_hz", PLACE(gyro.timer)),
    compensation(0x1301, ro, "magnetic.method", PLACE(magnetic.method)),
    compensation(0x1302, ro, "magnetic.presumed_arcsec_s", PLACE(magnetic.presumed_arcsec_s)),
    compensation(0x1303, ro, "magnetic.presumed_sigma_arcsec_s", PLACE(magnetic.presumed_sigma_arcsec_s)),
    compensation(0x1304, rw, "magnetic.thermal_time_s", PLACE(magnetic.thermal_time)),
    compensation(0x1401, rw, "lock_in.threshold_hz", PLACE(lock_in.threshold)),
    compensation(0x1402, rw, "lock_in.sigma_hz", PLACE(lock_in.sigma))};
// clang-format on
#undef PLACE

template <class Unit>
constexpr double as_number(core::Quantity<Unit> x) noexcept {
    return x.value();
}
template <class T>
requires std::is_arithmetic_v<T> || std::is_enum_v<T>
constexpr double as_number(T x) noexcept { return static_cast<double>(x); }

// False where the place cannot hold that number, which then stays as it was.
template <class Unit>
constexpr bool put_number(core::Quantity<Unit>& place, double x) noexcept {
    if (!is_number(x)) return false;
    place = core::Quantity<Unit>{x};
    return true;
}
constexpr bool put_number(double& place, double x) noexcept {
    if (!is_number(x)) return false;
    place = x;
    return true;
}
constexpr bool put_number(bool& place, double x) noexcept {
    if (!(x == 0.0 || x == 1.0)) return false;
    place = x == 1.0;
    return true;
}
template <class Integer>
requires std::is_integral_v<Integer>
constexpr bool put_number(Integer& place, double x) noexcept {
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
constexpr bool put_number(Choice&, double) noexcept { return false; }

template <class Settings, auto Section, class At>
constexpr auto places(Settings& settings, const Parameter<Section, At>& parameter) noexcept {
    const auto tied = [](auto&& at) {
        if constexpr (std::is_lvalue_reference_v<decltype(at)>)
            return std::tie(at);
        else
            return at;
    };
    if constexpr (std::is_null_pointer_v<decltype(Section)>)
        return tied(parameter.at(settings));
    else
        return tied(parameter.at(settings.*Section));
}

// Call `take` with the row of a key; not at all for an unknown one.
template <class Take>
void with_row(std::uint16_t key, const Take& take) noexcept {
    std::apply([&](const auto&... row) { (void)((row.info.key == key && (take(row), true)) || ...); }, table);
}

}  // namespace

std::span<const ParameterInfo> parameters() noexcept {
    static constexpr auto infos = std::apply([](const auto&... row) { return std::array{row.info...}; }, table);
    return infos;
}

std::string_view parameter_name(std::uint16_t key) noexcept {
    std::string_view name;
    with_row(key, [&](const auto& row) { name = row.name; });
    return name;
}

double parameter(const GyroSettings& settings, std::uint16_t key) noexcept {
    double value = std::numeric_limits<double>::quiet_NaN();
    with_row(key, [&](const auto& row) { value = as_number(std::get<0>(places(settings, row))); });
    return value;
}

CommandResult put_parameter(GyroSettings& settings, std::uint16_t key, double value) noexcept {
    CommandResult result = CommandResult::unknown_key;
    with_row(key, [&](const auto& row) {
        const auto put = [value](auto&... place) { return (put_number(place, value) && ...); };
        if (row.info.access == ro)
            result = CommandResult::read_only;
        else
            result = std::apply(put, places(settings, row)) ? CommandResult::done : CommandResult::not_a_value;
    });
    return result;
}

std::uint32_t settings_crc(const GyroSettings& settings) noexcept {
    std::array<std::uint8_t, 8 * std::tuple_size_v<decltype(table)>> bytes{};
    static_assert(bytes.size() <= 1024);
    auto next = bytes.begin();
    for (const ParameterInfo& info : parameters()) {
        const auto bits = std::bit_cast<std::uint64_t>(parameter(settings, info.key));
        for (unsigned i = 0; i < 8; ++i) *next++ = static_cast<std::uint8_t>(bits >> (8 * i));
    }
    return crc32c(bytes);
}

}  // namespace zlg::wire
