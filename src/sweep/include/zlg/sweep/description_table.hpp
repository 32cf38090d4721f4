#pragma once
// One table of a description in TOML: its values, each with the place that a complaint names.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <toml++/toml.h>

#include <zlg/config/schema.hpp>
#include <zlg/sweep/description.hpp>
#include <zlg/text/toml_text.hpp>

namespace zlg::sweep {

// A value as TOML, on one line.
[[nodiscard]] inline std::string text_of(const toml::node& node) {
    if (node.is_string()) return text::toml_string(node.as_string()->get());
    if (node.is_floating_point()) return text::toml_real(node.as_floating_point()->get());
    std::ostringstream out;
    node.visit([&](const auto& value) { out << value; });
    std::string text = out.str();
    std::ranges::replace(text, '\n', ' ');
    return text;
}

// An integer beyond 2^53 is rounded to the nearest double. Nothing: no number.
[[nodiscard]] inline std::optional<double> number_of(const toml::node& node) {
    if (const auto* integer = node.as_integer()) return static_cast<double>(integer->get());
    if (const auto* real = node.as_floating_point()) return real->get();
    return std::nullopt;
}

// One table of the description, that it may name its place and what is allowed in it.
class Table {
public:
    Table(std::string_view source_name, std::string name, const toml::table& table)
        : source_name_{source_name}, name_{std::move(name)}, table_{table} {}

    [[noreturn]] void fail(const toml::node& at, std::string_view what) const {
        throw config::ConfigError(fmt::format("{}:{}: {}", source_name_, at.source().begin.line, what));
    }
    [[noreturn]] void fail(std::string_view what) const { fail(table_, fmt::format("[{}] {}", name_, what)); }

    [[noreturn]] void refuse(std::string_view key, std::string_view allowed) const {
        const toml::node& node = *table_.get(key);
        fail(node, fmt::format("[{}] {} = {}: allowed is {}", name_, key, text_of(node), allowed));
    }

    void allow_only(std::initializer_list<std::string_view> keys) const {
        for (const auto& [key, node] : table_) {
            if (std::ranges::find(keys, key.str()) != keys.end()) continue;
            fail(node, fmt::format("unknown key [{}] {}; allowed are {}", name_, key.str(), fmt::join(keys, ", ")));
        }
    }

    [[nodiscard]] bool has(std::string_view key) const { return table_.contains(key); }
    [[nodiscard]] const toml::node& node(std::string_view key) const {
        if (!has(key)) fail(fmt::format("{} is missing", key));
        return *table_.get(key);
    }
    [[nodiscard]] const toml::table& table() const { return table_; }
    [[nodiscard]] std::string_view source_name() const { return source_name_; }
    [[nodiscard]] std::string place() const {
        return fmt::format("{}:{}: [{}]", source_name_, table_.source().begin.line, name_);
    }

    [[nodiscard]] double real(std::string_view key) const {
        const auto value = number_of(node(key));
        if (!value || !std::isfinite(*value)) refuse(key, "a finite number");
        return *value;
    }
    [[nodiscard]] std::optional<double> optional_real(std::string_view key) const {
        return has(key) ? std::optional{real(key)} : std::nullopt;
    }
    [[nodiscard]] std::int64_t integer(std::string_view key, std::int64_t min, std::int64_t max) const {
        const toml::node& found = node(key);
        const auto* value = found.as_integer();
        if (value == nullptr || value->get() < min || value->get() > max)
            refuse(key,
                   fmt::format("an integer {}..{}{}", min, max,
                               found.is_floating_point() ? ", written without a point and without an exponent" : ""));
        return value->get();
    }
    [[nodiscard]] bool boolean(std::string_view key, bool by_default) const {
        if (!has(key)) return by_default;
        if (!node(key).is_boolean()) refuse(key, "true or false");
        return node(key).as_boolean()->get();
    }
    [[nodiscard]] std::string text(std::string_view key) const {
        const toml::node& found = node(key);
        if (!found.is_string()) refuse(key, "a text");
        return found.as_string()->get();
    }

private:
    std::string_view source_name_;
    std::string name_;
    const toml::table& table_;
};

// errors  config::ConfigError: no TOML: file, line, column.
[[nodiscard]] toml::table parse_document(std::string_view text, std::string_view source_name);

// What is drawn, from the list of tables [[name]] below the root.
//
// base    on which the values are tried.
// errors  config::ConfigError: no such draw, numbers that make none, a value or key that there is not, a key twice.
[[nodiscard]] std::vector<Parameter> read_parameters(const Table& root, const std::string& name,
                                                     const config::Config& base);

}  // namespace zlg::sweep
