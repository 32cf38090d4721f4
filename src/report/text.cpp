#include "text.hpp"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

namespace zlg::report {
namespace {

unsigned char byte_at(std::string_view text, std::size_t i) { return static_cast<unsigned char>(text[i]); }

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Bytes of the UTF-8 character at i; 0 where there is none.
std::size_t character_length(std::string_view text, std::size_t i) {
    const unsigned char first = byte_at(text, i);
    const std::size_t length = first < 0x80 ? 1 : first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
    if (first > 0xF4 || i + length > text.size()) return 0;
    for (std::size_t k = 1; k < length; ++k) {
        if ((byte_at(text, i + k) & 0xC0) != 0x80) return 0;
    }
    return length;
}

std::string escaped_character(std::string_view character) {
    switch (character.front()) {
        case '&':
            return "&amp;";
        case '<':
            return "&lt;";
        case '>':
            return "&gt;";
        case '"':
            return "&quot;";
        case '\'':
            return "&#39;";
        case '\t':
        case '\n':
        case '\r':
            return " ";
        default:
            break;
    }
    if (byte_at(character, 0) < 0x20 || byte_at(character, 0) == 0x7F) return "\uFFFD";
    return std::string{character};
}

}  // namespace

std::string escaped(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = character_length(text, i);
        out += length == 0 ? std::string{"\uFFFD"} : escaped_character(text.substr(i, length));
        i += std::max<std::size_t>(length, 1);
    }
    return out;
}

double text_width(std::string_view text, double font_size) {
    constexpr double em_per_character = 0.6;
    const auto n_characters =
        std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
    return em_per_character * font_size * static_cast<double>(n_characters);
}

std::string coordinate(double value) {
    std::string text = fmt::format("{:.2f}", value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string clean_id(std::string_view id, std::string_view otherwise) {
    std::string out;
    for (const char c : id) {
        if (is_letter(c) || (!out.empty() && (is_digit(c) || c == '-'))) out += c;
    }
    return out.empty() ? std::string{otherwise} : out;
}

}  // namespace zlg::report
