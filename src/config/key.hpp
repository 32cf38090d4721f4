#pragma once
// One row of the table of keys: where its value lives in a Config, of which kind it is, and what is allowed.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>
#include <zlg/config/config.hpp>

#include "range.hpp"

namespace zlg::config {

template <auto Section, auto Member>
using TypeOf = std::remove_reference_t<decltype(std::declval<Config&>().*Section.*Member)>;

// A member of a section, to be read and to be set.
template <class T> struct Place {
    const T& (*read)(const Config&);
    T& (*change)(Config&);

    const T& operator()(const Config& config) const { return read(config); }
    T& operator()(Config& config) const { return change(config); }
};

// As it is named in the table: at<&Config::gyro, &Gyro::tick_s>.
template <auto Section, auto Member>
inline constexpr Place<TypeOf<Section, Member>> at{
    [](const Config& c) -> const TypeOf<Section, Member>& { return c.*Section.*Member; },
    [](Config& c) -> TypeOf<Section, Member>& { return c.*Section.*Member; }};

struct Real {
    Place<double> value;
    Range range;
};

struct OptionalReal {
    Place<std::optional<double>> value;
    Range range;
};

struct Integer {
    std::int64_t (*get)(const Config&);
    void (*set)(Config&, std::int64_t);
    std::int64_t min;
    std::int64_t max;
    bool without_between = false;  // the ends alone, as of a sign
};

// A member of any integer type that holds min..max.
template <auto Section, auto Member> constexpr Integer integer(std::int64_t min, std::int64_t max) {
    using Type = TypeOf<Section, Member>;
    return {[](const Config& c) { return static_cast<std::int64_t>(c.*Section.*Member); },
            [](Config& c, std::int64_t value) { c.*Section.*Member = static_cast<Type>(value); }, min, max};
}

template <auto Section, auto Member> constexpr Integer sign() {
    Integer made = integer<Section, Member>(-1, 1);
    made.without_between = true;
    return made;
}

[[nodiscard]] constexpr bool contains(const Integer& slot, std::int64_t value) {
    return slot.without_between ? value == slot.min || value == slot.max : value >= slot.min && value <= slot.max;
}

struct Text {
    Place<std::string> value;
};

// One number or an array of at least one; or of none, which is unset.
struct RealList {
    Place<std::vector<double>> value;
    Range range;
    bool may_be_empty = false;
};

// Any number of enumerators, by their names; one alone needs no array.
struct ChoiceList {
    std::span<const std::string_view> names;
    std::vector<int> (*get)(const Config&);
    void (*set)(Config&, std::span<const int>);
};

// A column of a text file, by its number or its name; empty while unset. Number 0, where it is allowed, means none.
struct Column {
    Place<std::string> value;
    bool may_be_none = false;
};

// [switching] interval_s: a number, or "optimal".
struct Interval {
    Range range;
};

// Pairs of a time and a value; or the path of a file of them.
struct Points {
    Place<Course> value;
};

// An enumeration, by the names of its enumerators in their order; -1 while unset.
struct Choice {
    std::span<const std::string_view> names;
    int (*get)(const Config&);
    void (*set)(Config&, int);
};

template <auto Section, auto Member> constexpr Choice choice(std::span<const std::string_view> names) {
    using Enum = TypeOf<Section, Member>;
    return {names, [](const Config& c) { return static_cast<int>(c.*Section.*Member); },
            [](Config& c, int index) { c.*Section.*Member = static_cast<Enum>(index); }};
}

template <auto Section, auto Member> constexpr Choice optional_choice(std::span<const std::string_view> names) {
    using Enum = typename TypeOf<Section, Member>::value_type;
    return {names, [](const Config& c) { return (c.*Section.*Member) ? static_cast<int>(*(c.*Section.*Member)) : -1; },
            [](Config& c, int index) { c.*Section.*Member = static_cast<Enum>(index); }};
}

template <auto Section, auto Member> constexpr ChoiceList choice_list(std::span<const std::string_view> names) {
    using Enum = typename TypeOf<Section, Member>::value_type;
    return {names,
            [](const Config& c) {
                std::vector<int> indices;
                for (const Enum each : c.*Section.*Member) indices.push_back(static_cast<int>(each));
                return indices;
            },
            [](Config& c, std::span<const int> indices) {
                (c.*Section.*Member).clear();
                for (const int index : indices) (c.*Section.*Member).push_back(static_cast<Enum>(index));
            }};
}

// In the order of ValueKind.
using Slot = std::variant<Real, OptionalReal, Integer, Text, RealList, Choice, ChoiceList, Interval, Column, Points>;

struct Key {
    std::string_view section;
    std::string_view name;
    std::string_view unit;
    std::string_view meaning;
    Slot slot;
};

// All keys, section by section.
[[nodiscard]] std::span<const Key> all_keys();

// The key of this name, or null.
[[nodiscard]] const Key* find_key(std::string_view section, std::string_view name);

[[nodiscard]] std::string dotted(const Key& key);

// The value as TOML; empty while unset.
[[nodiscard]] std::string value_text(const Key& key, const Config& config);

[[nodiscard]] std::string allowed_text(const Key& key);

// errors  ConfigError `section.key = value: allowed is ...`.
void check_range(const Key& key, const Config& config);

}  // namespace zlg::config
