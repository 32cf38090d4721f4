// Written with {fmt} and not by toml++'s own printing, which needs streams: the closed loop is built for pages too, and
// streams bring every locale with them, a seventh of the module.
#include "node_text.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

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

std::string text_of(const toml::date& d) { return fmt::format("{:04}-{:02}-{:02}", d.year, d.month, d.day); }

std::string text_of(const toml::time& t) {
    std::string text = fmt::format("{:02}:{:02}:{:02}", t.hour, t.minute, t.second);
    if (t.nanosecond == 0) return text;
    text += fmt::format(".{:09}", t.nanosecond);
    return text.substr(0, text.find_last_not_of('0') + 1);
}

std::string text_of(const toml::date_time& at) {
    std::string text = text_of(at.date) + "T" + text_of(at.time);
    if (!at.offset) return text;
    const int minutes = at.offset->minutes;
    if (minutes == 0) return text + "Z";
    const int size = minutes < 0 ? -minutes : minutes;
    return fmt::format("{}{}{:02}:{:02}", text, minutes < 0 ? '-' : '+', size / 60, size % 60);
}

std::string text_of(const toml::array& values) {
    std::string text;
    for (const toml::node& value : values) text += (text.empty() ? " " : ", ") + text_of(value);
    return text.empty() ? "[]" : "[" + text + " ]";
}

std::string text_of(const toml::table& table) {
    std::string text;
    for (const auto& [key, value] : table) {
        const bool is_bare = !key.str().empty() && std::all_of(key.str().begin(), key.str().end(), [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
        });
        const std::string name = is_bare ? std::string{key.str()} : text_of(std::string{key.str()});
        text += (text.empty() ? " " : ", ") + name + " = " + text_of(value);
    }
    return text.empty() ? "{}" : "{" + text + " }";
}

std::string text_of(bool value) { return value ? "true" : "false"; }
std::string text_of(std::int64_t value) { return fmt::format("{}", value); }

template <class T>
std::string text_of(const toml::value<T>& value) {
    return text_of(value.get());
}

std::string text_of(const toml::node& node) {
    return node.visit([](const auto& value) { return text_of(value); });
}

}  // namespace

std::string node_text(const toml::node& node) {
    std::string text = text_of(node);
    return text.size() > longest ? text.substr(0, longest) + "..." : text;
}

}  // namespace zlg::config
