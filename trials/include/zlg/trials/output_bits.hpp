#pragma once
// Every number of the core's outputs, one by one, as bits: to hold two processors against each other.

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <boost/hana/accessors.hpp>
#include <boost/hana/adapt_struct.hpp>
#include <boost/hana/concept/struct.hpp>
#include <boost/hana/for_each.hpp>
#include <boost/hana/length.hpp>
#include <boost/hana/pair.hpp>
#include <boost/hana/string.hpp>
#include <boost/hana/tuple.hpp>

#include <zlg/firmware/gyro.hpp>

BOOST_HANA_ADAPT_STRUCT(zlg::core::ActuatorFrame, loop_closed, polarity, n_set_points, set_point_v, edge_offset_ticks);
BOOST_HANA_ADAPT_STRUCT(zlg::core::HalfRecord, half, counts, detuning_lambda, detuning_sq_lambda2, piezo_v,
                        temperature_c, bias_sign, mode, loop_closed, valid, edge_offset_ticks, span, fringe, late, lit);
BOOST_HANA_ADAPT_STRUCT(zlg::core::SwitchEvent, tick_opened, outcome, has_half_wave, half_wave_v);
BOOST_HANA_ADAPT_STRUCT(zlg::core::GyroControlOutput, actuator, record, health, switch_waits, has_event, event);
BOOST_HANA_ADAPT_STRUCT(zlg::core::AngleRow, tick, dtheta_arcsec, dtheta_final_arcsec, sigma_arcsec, relock_arcsec,
                        mode, flags);
BOOST_HANA_ADAPT_STRUCT(zlg::core::GapReport, first_tick, n_ticks, sign_after, mode_after, mode_changed, dp_arcsec,
                        sigma_sum_arcsec);
BOOST_HANA_ADAPT_STRUCT(zlg::core::AngleSample, tick, dtheta_arcsec, flags, has_final, final_row, has_gap, gap);
BOOST_HANA_ADAPT_STRUCT(zlg::core::CompensationOutput, has_sample, sample, angle_arcsec);
BOOST_HANA_ADAPT_STRUCT(zlg::core::DrainOutput, has_row, has_gap, row, gap);
BOOST_HANA_ADAPT_STRUCT(zlg::firmware::HalfOutput, control, compensation);

namespace zlg::trials {

// As 64 bits; integers by their value.
template <class Number> [[nodiscard]] constexpr std::uint64_t bits_of(Number x) noexcept {
    if constexpr (std::same_as<Number, double>)
        return std::bit_cast<std::uint64_t>(x);
    else if constexpr (std::same_as<Number, float>)
        return std::bit_cast<std::uint32_t>(x);
    else if constexpr (std::is_enum_v<Number>)
        return static_cast<std::uint64_t>(x);
    else
        return static_cast<std::uint64_t>(static_cast<std::int64_t>(x));
}

struct Anything {
    template <class T> operator T() const;
};

template <class Struct, std::size_t n>
inline constexpr bool has_members = []<std::size_t... k>(std::index_sequence<k...>) {
    return requires { Struct{(static_cast<void>(k), Anything{})...}; };
}
(std::make_index_sequence<n>{});

// Calls visit(owner, name, bits) for every number, always as many and in the same order.
template <class Value, class Visit>
void for_each_number(const Value& value, Visit&& visit, const char* owner = "", const char* name = "") {
    namespace hana = boost::hana;
    if constexpr (hana::Struct<Value>::value) {
        constexpr std::size_t n_listed = decltype(hana::length(hana::accessors<Value>()))::value;
        static_assert(has_members<Value, n_listed> && !has_members<Value, n_listed + 1>, "a member is not listed");
        hana::for_each(hana::accessors<Value>(), [&](const auto& member) {
            for_each_number(hana::second(member)(value), visit, name, hana::first(member).c_str());
        });
    } else if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>) {
        visit(owner, name, bits_of(value));
    } else {
        for (const auto& element : value) for_each_number(element, visit, owner, name);
    }
}

// The first number in which two outputs differ; empty where every bit is the same.
template <class Output> [[nodiscard]] std::string first_difference(const Output& a, const Output& b) {
    std::vector<std::uint64_t> of_a;
    for_each_number(a, [&](const char*, const char*, std::uint64_t bits) { of_a.push_back(bits); });
    std::string found;
    std::size_t k = 0;
    for_each_number(b, [&](const char* owner, const char* name, std::uint64_t bits) {
        if (bits != of_a[k++] && found.empty()) found = *owner == '\0' ? name : std::string{owner} + "." + name;
    });
    return found;
}

// FNV-1a over all numbers that were added.
class BitHash {
public:
    template <class Output> void add(const Output& output) {
        for_each_number(output, [this](const char*, const char*, std::uint64_t bits) {
            for (int k = 0; k < 64; k += 8) value_ = (value_ ^ ((bits >> k) & 0xffu)) * 0x100000001b3u;
        });
    }
    [[nodiscard]] std::uint64_t value() const noexcept { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace zlg::trials
