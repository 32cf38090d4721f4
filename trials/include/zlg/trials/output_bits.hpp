#pragma once
// Every number of the core's outputs, one by one, as bits: to hold two processors against each other.
//
// A structure that gets another member no longer fits its line here and does not compile.

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <zlg/firmware/gyro.hpp>

namespace zlg::trials {

// As 64 bits; integers by their value.
template <class Number>
[[nodiscard]] constexpr std::uint64_t bits_of(Number x) noexcept {
    if constexpr (std::same_as<Number, double>)
        return std::bit_cast<std::uint64_t>(x);
    else if constexpr (std::same_as<Number, float>)
        return std::bit_cast<std::uint32_t>(x);
    else if constexpr (std::is_enum_v<Number>)
        return static_cast<std::uint64_t>(x);
    else
        return static_cast<std::uint64_t>(static_cast<std::int64_t>(x));
}

// Each calls visit(name, bits) for every number, always as many and in the same order.

template <class Visit, class... Numbers>
void visit_each(Visit&& visit, const std::array<const char*, sizeof...(Numbers)>& names, const Numbers&... numbers) {
    std::size_t k = 0;
    (visit(names[k++], bits_of(numbers)), ...);
}

template <class Visit>
void for_each_number(const core::ActuatorFrame& frame, Visit&& visit) {
    const auto& [loop_closed, polarity, n_set_points, set_point_v, edge_offset_ticks] = frame;
    visit_each(visit, {"actuator.loop_closed", "actuator.polarity", "actuator.n_set_points"}, loop_closed, polarity,
               n_set_points);
    for (const double v : set_point_v) visit("actuator.set_point_v", bits_of(v));
    visit("actuator.edge_offset_ticks", bits_of(edge_offset_ticks));
}

template <class Visit>
void for_each_number(const core::HalfRecord& record, Visit&& visit) {
    const auto& [half, counts, detuning, detuning_sq, piezo_v, temperature_c, bias_sign, mode, loop_closed, valid,
                 offset, span, fringe, lit] = record;
    visit_each(visit,
               {"record.half", "record.counts", "record.detuning_lambda", "record.detuning_sq_lambda2",
                "record.piezo_v", "record.temperature_c", "record.bias_sign", "record.mode", "record.loop_closed",
                "record.valid", "record.edge_offset_ticks", "record.span", "record.fringe", "record.lit"},
               half, counts, detuning, detuning_sq, piezo_v, temperature_c, bias_sign, mode, loop_closed, valid, offset,
               span, fringe, lit);
}

template <class Visit>
void for_each_number(const core::SwitchEvent& event, Visit&& visit) {
    const auto& [tick_opened, outcome, has_miss, miss_lambda, has_half_wave, half_wave_v, direction, out_of_range] =
        event;
    visit_each(visit,
               {"event.tick_opened", "event.outcome", "event.has_miss", "event.miss_lambda", "event.has_half_wave",
                "event.half_wave_v", "event.direction", "event.out_of_range"},
               tick_opened, outcome, has_miss, miss_lambda, has_half_wave, half_wave_v, direction, out_of_range);
}

template <class Visit>
void for_each_number(const core::AngleRow& row, Visit&& visit) {
    const auto& [tick, dtheta_arcsec, dtheta_final_arcsec, sigma_arcsec, relock_arcsec, mode, flags] = row;
    visit_each(visit,
               {"row.tick", "row.dtheta_arcsec", "row.dtheta_final_arcsec", "row.sigma_arcsec", "row.relock_arcsec",
                "row.mode", "row.flags"},
               tick, dtheta_arcsec, dtheta_final_arcsec, sigma_arcsec, relock_arcsec, mode, flags);
}

template <class Visit>
void for_each_number(const core::GapReport& gap, Visit&& visit) {
    const auto& [first_tick, n_ticks, sign_after, mode_after, mode_changed, dp_arcsec, sigma_sum_arcsec] = gap;
    visit_each(visit,
               {"gap.first_tick", "gap.n_ticks", "gap.sign_after", "gap.mode_after", "gap.mode_changed",
                "gap.dp_arcsec", "gap.sigma_sum_arcsec"},
               first_tick, n_ticks, sign_after, mode_after, mode_changed, dp_arcsec, sigma_sum_arcsec);
}

template <class Visit>
void for_each_number(const core::GyroControlOutput& output, Visit&& visit) {
    const auto& [actuator, record, health, has_event, event] = output;
    for_each_number(actuator, visit);
    for_each_number(record, visit);
    visit_each(visit, {"health", "has_event"}, health, has_event);
    for_each_number(event, visit);
}

template <class Visit>
void for_each_number(const core::CompensationOutput& output, Visit&& visit) {
    const auto& [has_sample, sample, angle_arcsec] = output;
    const auto& [tick, dtheta_arcsec, flags, has_final, final_row, has_gap, gap] = sample;
    visit_each(visit, {"has_sample", "sample.tick", "sample.dtheta_arcsec", "sample.flags", "sample.has_final"},
               has_sample, tick, dtheta_arcsec, flags, has_final);
    for_each_number(final_row, visit);
    visit("sample.has_gap", bits_of(has_gap));
    for_each_number(gap, visit);
    visit("angle_arcsec", bits_of(angle_arcsec));
}

template <class Visit>
void for_each_number(const firmware::HalfOutput& output, Visit&& visit) {
    const auto& [control, compensation] = output;
    for_each_number(control, visit);
    for_each_number(compensation, visit);
}

template <class Visit>
void for_each_number(const core::DrainOutput& output, Visit&& visit) {
    const auto& [has_row, has_gap, row, gap] = output;
    visit_each(visit, {"drain.has_row", "drain.has_gap"}, has_row, has_gap);
    for_each_number(row, visit);
    for_each_number(gap, visit);
}

// The first number in which two outputs differ; null where every bit is the same.
template <class Output>
[[nodiscard]] const char* first_difference(const Output& a, const Output& b) {
    constexpr int most = 128;
    std::uint64_t of_a[most];
    int n = 0;
    for_each_number(a, [&](const char*, std::uint64_t bits) { of_a[n++] = bits; });
    const char* found = nullptr;
    int k = 0;
    for_each_number(b, [&](const char* name, std::uint64_t bits) {
        if (bits != of_a[k++] && found == nullptr) found = name;
    });
    return found;
}

// FNV-1a over all numbers that were added.
class BitHash {
public:
    template <class Output>
    void add(const Output& output) {
        for_each_number(output, [this](const char*, std::uint64_t bits) {
            for (int k = 0; k < 64; k += 8) value_ = (value_ ^ ((bits >> k) & 0xffu)) * 0x100000001b3u;
        });
    }
    [[nodiscard]] std::uint64_t value() const noexcept { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace zlg::trials
