#include <fmt/format.h>
#include <toml++/toml.h>
#include <zlg/text/toml_document.hpp>
#include <zlg/text/toml_text.hpp>
#include <zlg/text/whole_file.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <system_error>
#include <zlg/config/schema.hpp>

#include "former_keys.hpp"
#include "key.hpp"
#include "nearest.hpp"
#include "node_text.hpp"

namespace zlg::config {

namespace {

// TOML's integers end at 2^63 - 1; one beyond that was taken for text, as other words are that are no TOML.
bool is_long_integer(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc::result_out_of_range && end == text.data() + text.size();
}

std::string_view type_name(const toml::node& node) {
    if (node.is_string())
        return is_long_integer(node.as_string()->get()) ? "an integer of more than 64 bits" : "a string";
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
        const auto found = std::find(names.begin(), names.end(), text(given));
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

    [[nodiscard]] std::vector<double> list() const {
        if (!node.is_array()) return {real(node)};
        std::vector<double> values;
        for (const toml::node& element : *node.as_array()) values.push_back(real(element));
        return values;
    }

    [[nodiscard]] Course course() const {
        if (node.is_string()) return {.path = text()};
        if (!node.is_array()) refuse(node, "an array of pairs, or a path");
        Course course;
        for (const toml::node& element : *node.as_array()) {
            const toml::array* const pair = element.as_array();
            if (pair == nullptr || pair->size() != 2) refuse(element, "a pair [time, value]");
            course.points.push_back({real(*pair->get(0)), real(*pair->get(1))});
        }
        return course;
    }
};

// A TOML value into its place in a Config.
struct Assign {
    Reader read;
    Config& config;

    void operator()(const Real& slot) const { slot.value(config) = read.real(read.node); }
    void operator()(const OptionalReal& slot) const { slot.value(config) = read.real(read.node); }
    void operator()(const Integer& slot) const { slot.set(config, read.integer(slot)); }
    void operator()(const Text& slot) const { slot.value(config) = read.text(); }
    void operator()(const RealList& slot) const { slot.value(config) = read.list(); }

    void operator()(const Points& slot) const { slot.value(config) = read.course(); }
    void operator()(const Column& slot) const { slot.value(config) = read.column(read.node); }

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

// errors  ConfigError `section.key = value: ...`: the wrong type, or out of range.
void assign(const Key& key, const toml::node& node, Config& config) {
    std::visit(Assign{{key, node}, config}, key.slot);
    check_range(key, config);
    config.given.insert(dotted(key));
}

[[noreturn]] void fail(const std::string& place, std::string_view what) {
    throw ConfigError(fmt::format("{}: {}", place, what));
}

void assign_at(const std::string& place, std::string_view section, std::string_view name, const toml::node& node,
               Config& config) {
    if (const auto former =
            find_former(fmt::format("{}.{}", section, name), node.value<std::string_view>().value_or("")))
        fail(place, fmt::format("{} is gone since format_version 3 of logs; {}", shown(*former), former->now));
    const Key* key = find_key(section, name);
    if (key == nullptr) {
        fail(place, fmt::format("unknown key [{}] {}; did you mean {}?", section, name, nearest_key(section, name)));
    }
    try {
        assign(*key, node, config);
    } catch (const ConfigError& error) {
        fail(place, error.what());
    }
}

void require_section(const std::string& place, std::string_view section) {
    if (is_known_section(section)) return;
    fail(place, fmt::format("unknown section [{}]; did you mean [{}]?", section, nearest_section(section)));
}

void assign_section(std::string_view source_name, std::string_view section, const toml::node& node, Config& config) {
    const auto place = [&](const toml::node& at) { return fmt::format("{}:{}", source_name, at.source().begin.line); };
    if (!node.is_table() && !is_known_section(section)) {
        fail(place(node), fmt::format("{} stands in no section; did you mean {}?", section, nearest_key("", section)));
    }
    require_section(place(node), section);
    if (!node.is_table())
        fail(place(node), fmt::format("{0} is a section: write [{0}] once and its keys below", section));
    for (const auto& [name, value] : *node.as_table()) assign_at(place(value), section, name.str(), value, config);
}

toml::table parse_document(std::string_view text, std::string_view source_name) {
    try {
        return text::parse_toml(text);
    } catch (const toml::parse_error& error) {
        const auto& at = error.source().begin;
        throw ConfigError(fmt::format("{}:{}:{}: {}", source_name, at.line, at.column, error.description()));
    }
}

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// A document of one value. What is not valid TOML, or is more than one value, is a string as it stands; text that is
// not UTF-8 is none, for it could not be written again.
toml::table parse_value(const std::string& place, std::string_view text) {
    try {
        toml::table document = text::parse_toml(fmt::format("value = {}", text));
        if (document.size() == 1 && document.contains("value")) return document;
    } catch (const toml::parse_error&) {
        // A bare word such as quadratic, or a path.
    }
    try {
        return text::parse_toml(fmt::format("value = {}", text::toml_string(text)));
    } catch (const toml::parse_error& error) {
        fail(place, fmt::format("a value cannot be read as text: {}", error.description()));
    }
}

}  // namespace

bool is_known_section(std::string_view name) {
    const auto keys = all_keys();
    return std::any_of(keys.begin(), keys.end(), [&](const Key& key) { return key.section == name; });
}

bool is_given(const Config& config, std::string_view dotted_key) {
    const auto dot = std::min(dotted_key.find('.'), dotted_key.size() - 1);
    const Key* key = find_key(dotted_key.substr(0, dot), dotted_key.substr(dot + 1));
    if (key == nullptr) throw std::invalid_argument(fmt::format("{} is no key", dotted_key));
    return config.given.contains(dotted_key) || value_text(*key, config) != value_text(*key, Config{});
}

std::string not_given(const Config& config, std::span<const std::string_view> dotted_keys) {
    std::string list;
    for (const auto& [key, value] : to_settings(config))
        if (std::find(dotted_keys.begin(), dotted_keys.end(), key) != dotted_keys.end() && !is_given(config, key))
            list += fmt::format("{}{} = {}", list.empty() ? "" : ", ", key, value);
    return list;
}

void apply_toml(Config& config, std::string_view text, std::string_view source_name) {
    const toml::table document = parse_document(text, source_name);
    Config result = config;
    for (const auto& [section, node] : document) assign_section(source_name, section.str(), node, result);
    config = std::move(result);
}

void apply_file(Config& config, const std::string& path) {
    std::string text;
    try {
        text = text::read_whole(path);
    } catch (const text::CannotRead& error) {
        throw ConfigError(fmt::format("cannot read the configuration {}: {}", path, error.what()));
    }
    apply_toml(config, text, path);
}

void apply_pair(Config& config, std::string_view dotted_key, std::string_view value, std::string_view source_name) {
    const std::string place{source_name};
    const auto dot = dotted_key.find('.');
    if (dot == std::string_view::npos) {
        fail(place,
             fmt::format("{}: section.key is wanted; did you mean {}?", dotted_key, nearest_key("", dotted_key)));
    }
    const std::string_view section = dotted_key.substr(0, dot);
    require_section(place, section);
    Config result = config;
    const toml::table document = parse_value(place, trimmed(value));
    assign_at(place, section, dotted_key.substr(dot + 1), *document.get("value"), result);
    config = std::move(result);
}

void apply_set(Config& config, std::string_view setting) {
    const auto equals = setting.find('=');
    if (equals == std::string_view::npos) {
        throw ConfigError(fmt::format("--set {}: section.key=value is wanted, an equals sign is missing", setting));
    }
    apply_pair(config, trimmed(setting.substr(0, equals)), setting.substr(equals + 1), "--set");
}

}  // namespace zlg::config
