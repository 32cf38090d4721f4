// Written with {fmt} and not by toml++'s own printing, which needs streams: the closed loop is built for pages too, and
// streams bring every locale with them, a seventh of the module.
#include "node_text.hpp"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

#include <zlg/text/toml_text.hpp>

namespace zlg::config {
namespace {

constexpr std::size_t longest = 60;

std::string text_of(const toml::node& node);

std::string text_of(const std::string& value) {
    const bool is_literal = std::none_of(value.begin(), value.end(), [](char c) {
        return c == '\'' || static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    });
    return is_literal ? "'" + value + "'" : text::toml_string(value);
}

// A real number shows that it is none of the integers.
std::string text_of(double value) {
    const std::string text = text::toml_real(value);
    return text.find_first_not_of("-0123456789") == std::string::npos ? text + ".0" : text;
}

std::string text_of(const toml::array& values) {
    std::string text;
    for (const toml::node& value : values) text += (text.empty() ? " " : ", ") + text_of(value);
    return text.empty() ? "[]" : "[" + text + " ]";
}

// Of a date or a table its kind is said, not what is in it.
std::string text_of(const toml::node& node) {
    if (const auto* text = node.as_string()) return text_of(text->get());
    if (const auto* number = node.as_floating_point()) return text_of(number->get());
    if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());
    if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
    if (const auto* values = node.as_array()) return text_of(*values);
    return "...";
}

}  // namespace

std::string node_text(const toml::node& node) {
    std::string text = text_of(node);
    return text.size() > longest ? text.substr(0, longest) + "..." : text;
}

}  // namespace zlg::config
