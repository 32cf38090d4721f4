#pragma once
// One row of the table of keys: where its value lives in a Config, of which kind it is, and what is allowed.

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

// The member of a section, to be named in the table: at<&Config::gyro, &Gyro::tick_s>.
template <auto Section, auto Member>
constexpr auto& at(Config& config) {
    return config.*Section.*Member;
}

struct Real {
    double& (*value)(Config&);
    Range range;
};

struct OptionalReal {
    std::optional<double>& (*value)(Config&);
    Range range;
};

struct Integer {
    std::int64_t& (*value)(Config&);
    std::int64_t min;
    std::int64_t max;
};

// -1 or +1.
struct Sign {
    std::int64_t& (*value)(Config&);
};

struct Text {
    std::string& (*value)(Config&);
};

// One number or an array of at least one; or of none, which is unset.
struct RealList {
    std::vector<double>& (*value)(Config&);
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
    std::string& (*value)(Config&);
    bool may_be_none = false;
};

// Any number of columns; one alone needs no array.
struct ColumnList {
    std::vector<std::string>& (*value)(Config&);
};

// [switching] interval_s: a number, or "optimal".
struct Interval {
    Range range;
};

// An enumeration, by the names of its enumerators in their order; -1 while unset.
struct Choice {
    std::span<const std::string_view> names;
    int (*get)(const Config&);
    void (*set)(Config&, int);
};

template <auto Section, auto Member>
constexpr Choice choice(std::span<const std::string_view> names) {
    using Enum = std::remove_reference_t<decltype(std::declval<Config&>().*Section.*Member)>;
    return {names, [](const Config& c) { return static_cast<int>(c.*Section.*Member); },
            [](Config& c, int index) { c.*Section.*Member = static_cast<Enum>(index); }};
}

template <auto Section, auto Member>
constexpr Choice optional_choice(std::span<const std::string_view> names) {
    using Enum = typename std::remove_reference_t<decltype(std::declval<Config&>().*Section.*Member)>::value_type;
    return {names, [](const Config& c) { return (c.*Section.*Member) ? static_cast<int>(*(c.*Section.*Member)) : -1; },
            [](Config& c, int index) { c.*Section.*Member = static_cast<Enum>(index); }};
}

template <auto Section, auto Member>
constexpr ChoiceList choice_list(std::span<const std::string_view> names) {
    using Enum = typename std::remove_reference_t<decltype(std::declval<Config&>().*Section.*Member)>::value_type;
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

using Slot =
    std::variant<Real, OptionalReal, Integer, Sign, Text, RealList, ChoiceList, Interval, Choice, Column, ColumnList>;

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
