#pragma once
// Every number of the core's outputs, one by one, as bits: to hold two processors against each other.
//
// A structure that gets another member no longer fits its line here and does not compile.

#include <bit>
#include <concepts>
#include <cstdint>
#include <type_traits>

#include <zlg/firmware/gyro.hpp>

namespace zlg::firmware {

// As 64 bits; integers by their value.
template <class Number>
[[nodiscard]] constexpr std::uint64_t bits_of(Number x) noexcept {
    if constexpr (std::same_as<Number, double>)
        return std::bit_cast<std::uint64_t>(x);
    else if constexpr (std::is_enum_v<Number>)
        return static_cast<std::uint64_t>(x);
    else
        return static_cast<std::uint64_t>(static_cast<std::int64_t>(x));
}

// Each calls visit(name, bits) for every number, always as many and in the same order.

template <class Visit>
void for_each_number(const core::ActuatorFrame& frame, Visit&& visit) {
    const auto& [loop_closed, polarity, n_set_points, set_point_v, edge_offset_ticks] = frame;
    visit("actuator.loop_closed", bits_of(loop_closed));
    visit("actuator.polarity", bits_of(polarity));
    visit("actuator.n_set_points", bits_of(n_set_points));
    for (const double v : set_point_v) visit("actuator.set_point_v", bits_of(v));
    visit("actuator.edge_offset_ticks", bits_of(edge_offset_ticks));
}

template <class Visit>
void for_each_number(const core::HalfRecord& record, Visit&& visit) {
    const auto& [half, counts, detuning, detuning_sq, piezo_v, temperature_c, bias_sign, mode, loop_closed, valid,
                 offset, span] = record;
    visit("record.half", bits_of(half));
    visit("record.counts", bits_of(counts));
    visit("record.detuning_lambda", bits_of(detuning));
    visit("record.detuning_sq_lambda2", bits_of(detuning_sq));
    visit("record.piezo_v", bits_of(piezo_v));
    visit("record.temperature_c", bits_of(temperature_c));
    visit("record.bias_sign", bits_of(bias_sign));
    visit("record.mode", bits_of(mode));
    visit("record.loop_closed", bits_of(loop_closed));
    visit("record.valid", bits_of(valid));
    visit("record.edge_offset_ticks", bits_of(offset));
    visit("record.span", bits_of(span));
}

template <class Visit>
void for_each_number(const core::SwitchEvent& event, Visit&& visit) {
    const auto& [tick_opened, outcome, has_miss, miss_lambda, has_half_wave, half_wave_v, direction, out_of_range] =
        event;
    visit("event.tick_opened", bits_of(tick_opened));
    visit("event.outcome", bits_of(outcome));
    visit("event.has_miss", bits_of(has_miss));
    visit("event.miss_lambda", bits_of(miss_lambda));
    visit("event.has_half_wave", bits_of(has_half_wave));
    visit("event.half_wave_v", bits_of(half_wave_v));
    visit("event.direction", bits_of(direction));
    visit("event.out_of_range", bits_of(out_of_range));
}

template <class Visit>
void for_each_number(const core::AngleRow& row, Visit&& visit) {
    const auto& [tick, dtheta_arcsec, dtheta_final_arcsec, sigma_arcsec, relock_arcsec, mode, flags] = row;
    visit("row.tick", bits_of(tick));
    visit("row.dtheta_arcsec", bits_of(dtheta_arcsec));
    visit("row.dtheta_final_arcsec", bits_of(dtheta_final_arcsec));
    visit("row.sigma_arcsec", bits_of(sigma_arcsec));
    visit("row.relock_arcsec", bits_of(relock_arcsec));
    visit("row.mode", bits_of(mode));
    visit("row.flags", bits_of(flags));
}

template <class Visit>
void for_each_number(const core::GapReport& gap, Visit&& visit) {
    const auto& [first_tick, n_ticks, sign_after, mode_after, mode_changed, dp_arcsec, sigma_sum_arcsec] = gap;
    visit("gap.first_tick", bits_of(first_tick));
    visit("gap.n_ticks", bits_of(n_ticks));
    visit("gap.sign_after", bits_of(sign_after));
    visit("gap.mode_after", bits_of(mode_after));
    visit("gap.mode_changed", bits_of(mode_changed));
    visit("gap.dp_arcsec", bits_of(dp_arcsec));
    visit("gap.sigma_sum_arcsec", bits_of(sigma_sum_arcsec));
}

template <class Visit>
void for_each_number(const core::GyroControlOutput& output, Visit&& visit) {
    const auto& [actuator, record, health, has_event, event] = output;
    for_each_number(actuator, visit);
    for_each_number(record, visit);
    visit("health", bits_of(health));
    visit("has_event", bits_of(has_event));
    for_each_number(event, visit);
}

template <class Visit>
void for_each_number(const core::CompensationOutput& output, Visit&& visit) {
    const auto& [has_sample, sample, angle_arcsec] = output;
    const auto& [tick, dtheta_arcsec, flags, has_final, final_row, has_gap, gap] = sample;
    visit("has_sample", bits_of(has_sample));
    visit("sample.tick", bits_of(tick));
    visit("sample.dtheta_arcsec", bits_of(dtheta_arcsec));
    visit("sample.flags", bits_of(flags));
    visit("sample.has_final", bits_of(has_final));
    for_each_number(final_row, visit);
    visit("sample.has_gap", bits_of(has_gap));
    for_each_number(gap, visit);
    visit("angle_arcsec", bits_of(angle_arcsec));
}

template <class Visit>
void for_each_number(const HalfOutput& output, Visit&& visit) {
    const auto& [control, compensation] = output;
    for_each_number(control, visit);
    for_each_number(compensation, visit);
}

template <class Visit>
void for_each_number(const core::DrainOutput& output, Visit&& visit) {
    const auto& [has_row, has_gap, row, gap] = output;
    visit("drain.has_row", bits_of(has_row));
    visit("drain.has_gap", bits_of(has_gap));
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

}  // namespace zlg::firmware
