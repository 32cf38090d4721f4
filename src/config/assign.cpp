#include "assign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <zlg/config/schema.hpp>

namespace zlg::config {

namespace {

std::string node_text(const toml::node& node) {
    constexpr std::size_t longest = 60;
    std::ostringstream out;
    node.visit([&](const auto& value) { out << value; });
    std::string text = out.str();
    std::ranges::replace(text, '\n', ' ');
    return text.size() > longest ? text.substr(0, longest) + "..." : text;
}

std::string_view type_name(const toml::node& node) {
    if (node.is_string()) return "a string";
    if (node.is_integer()) return "an integer";
    if (node.is_floating_point()) return "a real number";
    if (node.is_boolean()) return "a boolean";
    if (node.is_array()) return "an array";
    if (node.is_table()) return "a table";
    return "a date or time";
}

// One key and the node that is meant for it: gives the node's value in the type that the slot wants.
struct Reader {
    const Key& key;
    const toml::node& node;

    [[noreturn]] void refuse(const toml::node& given, std::string_view wanted) const {
        throw ConfigError(fmt::format("{} = {}: {} is wanted, this is {}; allowed is {}", dotted(key), node_text(node),
                                      wanted, type_name(given), allowed_text(key)));
    }

    [[noreturn]] void refuse_value(std::string_view given) const {
        throw ConfigError(fmt::format("{} = {}: allowed is {}", dotted(key), given, allowed_text(key)));
    }

    [[nodiscard]] double real(const toml::node& given) const {
        if (given.is_integer()) return static_cast<double>(given.as_integer()->get());
        if (!given.is_floating_point()) refuse(given, "a number");
        return given.as_floating_point()->get();
    }

    // Within its range already, for the member may hold no other.
    [[nodiscard]] std::int64_t integer(const Integer& slot) const {
        if (!node.is_integer()) refuse(node, "an integer");
        const std::int64_t value = node.as_integer()->get();
        if (!contains(slot, value)) refuse_value(fmt::format("{}", value));
        return value;
    }

    [[nodiscard]] std::string text() const { return text(node); }

    [[nodiscard]] std::string text(const toml::node& given) const {
        if (!given.is_string()) refuse(given, "a string");
        return given.as_string()->get();
    }

    [[nodiscard]] int choice(const toml::node& given, std::span<const std::string_view> names) const {
        const auto found = std::ranges::find(names, std::string_view{text(given)});
        if (found == names.end()) refuse_value(node_text(given));
        return static_cast<int>(found - names.begin());
    }

    // As text: the digits of a number, or a name.
    [[nodiscard]] std::string column(const toml::node& given) const {
        if (given.is_string()) return text(given);
        if (given.is_integer()) return fmt::format("{}", given.as_integer()->get());
        const double number = given.is_floating_point() ? given.as_floating_point()->get() : 0.5;
        if (!(std::abs(number) <= 1e6) || number != std::floor(number)) refuse(given, "a column's number or name");
        return fmt::format("{}", static_cast<std::int64_t>(number));
    }

    [[nodiscard]] std::vector<std::string> columns() const {
        if (!node.is_array()) return {column(node)};
        std::vector<std::string> each;
        for (const toml::node& element : *node.as_array()) each.push_back(column(element));
        return each;
    }

    [[nodiscard]] std::vector<double> list() const {
        if (!node.is_array()) return {real(node)};
        std::vector<double> values;
        for (const toml::node& element : *node.as_array()) values.push_back(real(element));
        return values;
    }
};

struct Assign {
    Reader read;
    Config& config;

    void operator()(const Real& slot) const { slot.value(config) = read.real(read.node); }
    void operator()(const OptionalReal& slot) const { slot.value(config) = read.real(read.node); }
    void operator()(const Integer& slot) const { slot.set(config, read.integer(slot)); }
    void operator()(const Text& slot) const { slot.value(config) = read.text(); }
    void operator()(const RealList& slot) const { slot.value(config) = read.list(); }

    void operator()(const Column& slot) const { slot.value(config) = read.column(read.node); }
    void operator()(const ColumnList& slot) const { slot.value(config) = read.columns(); }

    void operator()(const Interval&) const {
        Switching& switching = config.switching;
        switching.interval_optimal = read.node.is_string() && read.text() == "optimal";
        if (!switching.interval_optimal) switching.interval_s = read.real(read.node);
    }

    void operator()(const Choice& slot) const { slot.set(config, read.choice(read.node, slot.names)); }

    void operator()(const ChoiceList& slot) const {
        std::vector<int> indices;
        if (!read.node.is_array()) {
            indices.push_back(read.choice(read.node, slot.names));
        } else {
            for (const toml::node& element : *read.node.as_array()) indices.push_back(read.choice(element, slot.names));
        }
        slot.set(config, indices);
    }
};

}  // namespace

void assign(const Key& key, const toml::node& node, Config& config) {
    std::visit(Assign{{key, node}, config}, key.slot);
    check_range(key, config);
    config.given.insert(dotted(key));
}

}  // namespace zlg::config
