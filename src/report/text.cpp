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

bool begins_number(std::string_view text) {
    return !text.empty() && (is_digit(text[0]) || (text.size() > 1 && text[0] == '.' && is_digit(text[1])));
}

// Is the character at `end` preceded by a number that is no part of a word?
bool ends_number(std::string_view text, std::size_t end) {
    std::size_t from = end;
    while (from > 0 && (is_digit(text[from - 1]) || text[from - 1] == '.')) --from;
    return from < end && (from == 0 || (!is_letter(text[from - 1]) && text[from - 1] != '_'));
}

// Characters of an exponent that begins at i, "e-07" or "^-2"; 0 where there is none.
std::size_t exponent_length(std::string_view text, std::size_t i) {
    const bool is_power = text[i] == '^';
    if (!is_power && !(text[i] == 'e' && ends_number(text, i))) return 0;
    std::size_t end = i + 1;
    if (end < text.size() && (text[end] == '-' || text[end] == '+')) ++end;
    const std::size_t first = end;
    while (end < text.size() && is_digit(text[end])) ++end;
    return end == first || (end < text.size() && is_letter(text[end])) ? 0 : end - i;
}

std::string escaped_character(std::string_view character) {
    switch (character.front()) {
        case '&': return "&amp;";
        case '<': return "&lt;";
        case '>': return "&gt;";
        case '"': return "&quot;";
        case '\'': return "&#39;";
        case '\t':
        case '\n':
        case '\r': return " ";
        default: break;
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

std::string typeset(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char before = i == 0 ? ' ' : text[i - 1];
        const std::string_view rest = text.substr(i);
        if (rest.starts_with("+-")) {
            out += "\u00B1";
            ++i;
        } else if (rest.starts_with("sqrt(") && rest.find(')') != rest.npos) {
            const std::size_t end = rest.find(')');
            out += "\u221A" + std::string{rest.substr(5, end - 5)};
            i += end;
        } else if (const std::size_t length = exponent_length(text, i); length > 0) {
            out += (text[i] == '^' ? "" : "\u00D710") + superscript(rest.substr(1, length - 1));
            i += length - 1;
        } else if (text[i] == '-' && !is_letter(before) && !is_digit(before) && before != '-' &&
                   begins_number(rest.substr(1))) {
            out += "\u2212";
        } else {
            out += text[i];
        }
    }
    return out;
}

std::string superscript(std::string_view number) {
    static constexpr const char* digits[] = {"\u2070", "\u00B9", "\u00B2", "\u00B3", "\u2074",
                                             "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    const bool is_negative = number.starts_with('-');
    if (is_negative || number.starts_with('+')) number.remove_prefix(1);
    while (number.size() > 1 && number.front() == '0') number.remove_prefix(1);
    std::string out = is_negative ? "\u207B" : "";
    for (const char digit : number) out += digits[digit - '0'];
    return out;
}

bool is_number(std::string_view text) {
    if (text.empty() || text == "-" || text == "none") return true;
    return std::any_of(text.begin(), text.end(), is_digit) &&
           text.find_first_not_of("0123456789.+- e%") == std::string_view::npos;
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
