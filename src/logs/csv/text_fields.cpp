#include "text_fields.hpp"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <zlg/text/spelling.hpp>

namespace zlg::logs {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0 || (static_cast<unsigned char>(c) & 0x80) != 0;
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

// A tab parts fields where it is the separator, and is a blank elsewhere.
std::string_view trimmed(std::string_view text, char separator) {
    const auto goes = [separator](char c) { return is_blank(c) && c != separator; };
    while (!text.empty() && goes(text.front())) text.remove_prefix(1);
    while (!text.empty() && goes(text.back())) text.remove_suffix(1);
    return text;
}

// One past the closing quote; npos where there is none.
std::size_t end_of_quoted(std::string_view text) {
    for (std::size_t k = 1; k < text.size(); ++k) {
        if (text[k] != '"') continue;
        if (k + 1 < text.size() && text[k + 1] == '"')
            ++k;
        else
            return k + 1;
    }
    return std::string_view::npos;
}

std::size_t find_separator(std::string_view text, char separator, std::size_t from) {
    if (separator != blanks_separator) return text.find(separator, from);
    return text.find_first_of(" \t\r", from);
}

// The next field of `rest`, which it leaves behind; true where a separator followed it.
bool cut_field(std::string_view& rest, char separator, Field& field) {
    std::size_t from = 0;
    if (rest.starts_with('"')) {
        const std::size_t end = end_of_quoted(rest);
        if (end != std::string_view::npos) from = end;
    }
    const std::size_t at = find_separator(rest, separator, from);
    std::string_view text = trimmed(rest.substr(0, at), separator);
    field = {text, false};
    if (from > 0 && text.size() == from) field = {trimmed(text.substr(1, from - 2), '\0'), true};
    if (at == std::string_view::npos) {
        rest = {};
        return false;
    }
    rest.remove_prefix(at + 1);
    return true;
}

bool parses(std::string_view text, double& value) {
    const char* const last = text.data() + text.size();
    const auto [end, error] = fast_float::from_chars(text.data(), last, value);
    if (error == std::errc{} && end == last) return std::isfinite(value);
    // Fortran's exponent of a double: 1.5D-03.
    std::array<char, 40> copy;
    const std::size_t mark = text.find('D');
    if (mark == std::string_view::npos || mark + 2 >= text.size() || text.size() > copy.size()) return false;
    if ((text[mark + 1] != '+' && text[mark + 1] != '-') || !is_digit(text[mark + 2])) return false;
    std::copy(text.begin(), text.end(), copy.begin());
    copy[mark] = 'E';
    return parses({copy.data(), text.size()}, value);
}

// 1 to 3 digits, then groups of three behind the mark.
bool is_grouped(std::string_view digits, char mark) {
    if (digits.starts_with('+') || digits.starts_with('-')) digits.remove_prefix(1);
    const std::size_t first = digits.find(mark);
    if (first == std::string_view::npos || first < 1 || first > 3 || digits.front() == '0') return false;
    for (std::size_t k = 0; k < digits.size(); ++k) {
        const bool at_mark = k >= first && (k - first) % 4 == 0;
        if (at_mark ? digits[k] != mark : !is_digit(digits[k])) return false;
    }
    return (digits.size() - first) % 4 == 0;
}

// 01.02.2024 or 2024-01-02.
bool is_date(std::string_view text) {
    const std::size_t first = text.find_first_not_of("0123456789");
    if (first == std::string_view::npos || (text[first] != '.' && text[first] != '-')) return false;
    const std::size_t second = text.find(text[first], first + 1);
    if (second == std::string_view::npos) return false;
    const std::string_view last = text.substr(second + 1);
    const auto digits = [](std::string_view part) { return std::all_of(part.begin(), part.end(), is_digit); };
    const std::size_t middle = second - first - 1;
    const bool year_first = first == 4 && last.size() >= 1 && last.size() <= 2;
    const bool year_last = first >= 1 && first <= 2 && (last.size() == 4 || last.size() == 2);
    return middle >= 1 && middle <= 2 && (year_first || year_last) && digits(text.substr(first + 1, middle)) &&
           digits(last);
}

}  // namespace

void split_fields(std::string_view line, char separator, std::vector<Field>& fields, std::size_t most) {
    fields.clear();
    const bool at_blanks = separator == blanks_separator;
    line = trimmed(line, at_blanks ? '\0' : separator);
    if (at_blanks && line.empty()) return;
    bool more = true;
    while (more && fields.size() < most) {
        Field field;
        line = trimmed(line, at_blanks ? '\0' : separator);
        more = cut_field(line, separator, field);
        fields.push_back(field);
    }
}

std::optional<Number> number_of(std::string_view text, Mark mark) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+') text.remove_prefix(1);
    const std::size_t comma = text.find(',');
    Number number;
    if (comma == std::string_view::npos) {
        if (text.empty() || (is_letter(text.back()) && !is_digit(text.back()))) return std::nullopt;
        if (!parses(text, number.value)) return std::nullopt;
        if (text.find('.') != std::string_view::npos) number.mark = Mark::point;
        if (number.mark == Mark::point && mark == Mark::comma) return std::nullopt;
        number.is_grouped = number.mark == Mark::point && is_grouped(text, '.');
        return number;
    }
    std::array<char, 64> copy;
    if (mark == Mark::point || text.size() > copy.size() || text.find('.') != std::string_view::npos)
        return std::nullopt;
    if (comma == 0 || comma + 1 == text.size() || !is_digit(text[comma - 1]) || !is_digit(text[comma + 1]))
        return std::nullopt;
    std::copy(text.begin(), text.end(), copy.begin());
    copy[comma] = '.';
    if (!parses({copy.data(), text.size()}, number.value)) return std::nullopt;
    number.mark = Mark::comma;
    number.is_grouped = is_grouped(text, ',');
    return number;
}

bool says_missing(std::string_view text) {
    constexpr auto words = std::to_array<std::string_view>(
        {"nan", "-nan", "na", "n/a", "null", "none", "#n/a", "#nv", "#div/0!", "#value!", "nan(ind)", "-nan(ind)"});
    if (text.empty()) return true;
    // Numbers begin most fields. Microsoft's runtime writes 1.#QNAN, -1.#IND, 1.#INF.
    if (is_digit(text.front()) || (text.size() > 1 && is_digit(text[1]))) {
        if (text.front() == '-') text.remove_prefix(1);
        return text.starts_with("1.#");
    }
    return std::find(words.begin(), words.end(), text::lower_case(text)) != words.end();
}

FieldKind kind_of(const Field& field, Mark mark) {
    if (says_missing(field.text)) return FieldKind::missing;
    if (number_of(field.text, mark)) return FieldKind::number;
    const bool of_numbers = field.text.find_first_not_of("0123456789+-.,;|eE \t") == std::string_view::npos;
    return of_numbers && !is_date(field.text) ? FieldKind::broken : FieldKind::word;
}

bool may_be_name(std::string_view word) {
    if (word.empty() || is_digit(word.front()) || std::string_view{"+-.,"}.find(word.front()) != std::string_view::npos)
        return false;
    return std::any_of(word.begin(), word.end(), is_letter);
}

bool has_parted_thousands(std::string_view line, char mark) {
    line = trimmed(line, '\0');
    const std::size_t last = line.rfind(mark);
    if (last == std::string_view::npos) return false;
    const std::size_t end = std::min(line.find_first_of(".,", last + 1), line.size());
    const std::string_view rest = line.substr(end);
    return is_grouped(line.substr(0, end), mark) &&
           (rest.empty() || (rest.size() > 1 && std::all_of(rest.begin() + 1, rest.end(), is_digit)));
}

}  // namespace zlg::logs
