#include <zlg/text/escape.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace zlg::text {
namespace {

struct Letter {
    char32_t code;
    std::size_t n_bytes;  // 0: no UTF-8
};

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0u) == 0x80u; }

Letter first_letter(std::string_view text) {
    const auto lead = static_cast<unsigned char>(text.front());
    if (lead < 0x80) return {lead, 1};
    const std::size_t n = lead >= 0xF0 ? 4 : (lead >= 0xE0 ? 3 : 2);
    constexpr char32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    if (lead < 0xC2 || lead > 0xF4 || text.size() < n) return {lead, 0};
    char32_t code = lead & (0x7Fu >> n);
    for (std::size_t k = 1; k < n; ++k) {
        if (!continues(text[k])) return {lead, 0};
        code = (code << 6u) | (static_cast<unsigned char>(text[k]) & 0x3Fu);
    }
    const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
    if (code < least[n] || code > 0x10FFFF || surrogate) return {lead, 0};
    return {code, n};
}

// What moves the cursor, ends a line or changes the direction of writing.
bool is_control(char32_t code) {
    const bool direction = (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
    return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029 || direction;
}

}  // namespace

std::string escaped(std::string_view text, Lines lines) {
    std::string result;
    result.reserve(text.size());
    while (!text.empty()) {
        const Letter letter = first_letter(text);
        const bool ends_line = letter.code == '\n' && lines == Lines::many;
        const std::size_t n = letter.n_bytes == 0 ? 1 : letter.n_bytes;
        if (letter.n_bytes == 0 || (is_control(letter.code) && !ends_line)) {
            result += fmt::format("\\u{:04X}", static_cast<unsigned>(letter.code));
        } else {
            result += text.substr(0, n);
        }
        text.remove_prefix(n);
    }
    return result;
}

std::string as_utf8(std::string_view text) {
    bool is_utf8 = true;
    for (std::string_view rest = text; is_utf8 && !rest.empty();) {
        const std::size_t n = first_letter(rest).n_bytes;
        is_utf8 = n > 0;
        rest.remove_prefix(n);
    }
    if (is_utf8) return std::string{text};
    std::string result;
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (code < 0x80) {
            result += c;
        } else {  // two bytes hold all of Latin-1
            result += static_cast<char>(0xC0u | (code >> 6u));
            result += static_cast<char>(0x80u | (code & 0x3Fu));
        }
    }
    return result;
}

std::string shortened(std::string text, std::size_t max_bytes) {
    if (text.size() <= max_bytes) return text;
    constexpr std::string_view mark = " ... ";
    std::size_t end = max_bytes / 2;
    std::size_t begin = text.size() - max_bytes / 3;
    while (end > 0 && continues(text[end])) --end;
    while (begin < text.size() && continues(text[begin])) ++begin;
    return text.substr(0, end) + std::string{mark} + text.substr(begin);
}

std::string excerpt(std::string_view text, std::size_t max_bytes, char replacement) {
    std::size_t end = std::min(max_bytes, text.size());
    while (end > 0 && end < text.size() && continues(text[end])) --end;
    std::string shown{text.substr(0, end)};
    for (char& c : shown)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = replacement;
    return text.size() > max_bytes ? shown + "..." : shown;
}

}  // namespace zlg::text
