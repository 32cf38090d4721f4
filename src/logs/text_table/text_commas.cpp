#include "text_commas.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <zlg/text/spelling.hpp>

namespace zlg::logs {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || static_cast<unsigned char>(c) == 0xA0; }

std::size_t n_digits(std::string_view text) { return std::min(text.find_first_not_of("0123456789"), text.size()); }

// Digits, an exponent perhaps, and a unit perhaps: what may stand behind a decimal comma.
bool may_be_fraction(const Field& field) {
    std::string_view rest = field.text;
    const std::size_t digits = n_digits(rest);
    if (field.is_quoted || digits == 0) return false;
    rest.remove_prefix(digits);
    if (!rest.empty() && std::string_view{"eEdD"}.find(rest.front()) != std::string_view::npos) {
        const std::size_t sign = rest.size() > 1 && (rest[1] == '+' || rest[1] == '-') ? 1 : 0;
        const std::size_t exponent = n_digits(rest.substr(1 + sign));
        if (exponent > 0) rest.remove_prefix(1 + sign + exponent);
    }
    // A date, a time of the day, a number with a point, a word of digits and letters.
    return rest.empty() || (std::string_view{".-:/"}.find(rest.front()) == std::string_view::npos &&
                            !std::ranges::any_of(rest, is_digit));
}

// What the field before it ends in. Thousands may be parted by points there.
enum class End { number, time_of_day, other };

End end_of(const Field& field) {
    std::string_view text = field.text;
    if (field.is_quoted || text.empty() || !is_digit(text.back())) return End::other;
    const auto cut_digits = [&text] {
        std::size_t n = 0;
        for (; !text.empty() && is_digit(text.back()); ++n) text.remove_suffix(1);
        return n;
    };
    std::size_t n_last = cut_digits();
    while (n_last == 3 && text.size() > 1 && text.back() == '.' && is_digit(text[text.size() - 2])) {
        text.remove_suffix(1);
        n_last = cut_digits();
        if (n_last > 3 || field.text[text.size()] == '0') return End::other;  // 0.005 is no thousand
    }
    if (!text.empty() && (text.back() == '+' || text.back() == '-')) {
        text.remove_suffix(1);
        return text.empty() || is_blank(text.back()) ? End::number : End::other;
    }
    if (text.empty()) return End::number;
    const char before = text.back();
    if (before == ':' && text.size() > 1 && is_digit(text[text.size() - 2])) return End::time_of_day;
    return is_letter(before) || before == '.' || before == '/' ? End::other : End::number;
}

struct Suspect {
    bool is_open = true;
    bool after_time = false;
    bool one_width = true;  // of its digits in all rows
    std::size_t width = 0;

    void note(const Field& before, const Field& field) {
        const End end = end_of(before);
        if (field.text.empty()) {
            is_open = false;
            return;
        }
        if (end == End::other || !may_be_fraction(field)) is_open = false;
        // No writer puts a blank into a number.
        if (is_blank(*(field.text.data() - 1))) is_open = false;
        const std::size_t digits = n_digits(field.text);
        after_time = after_time || end == End::time_of_day;
        one_width = one_width && (width == 0 || width == digits);
        width = digits;
    }
    // Fractions of a second are written with as many digits in every row.
    [[nodiscard]] bool stands() const { return is_open && (!after_time || one_width); }
    // They may have a comma where numbers have points.
    [[nodiscard]] bool is_of_second() const { return stands() && after_time && width % 3 == 0; }
};

// Numbers with points, not all the same: a version may stand in every row. 1.234 may be a thousand.
class Points {
public:
    explicit Points(std::size_t n_fields) : first_(n_fields) {}
    void note(std::size_t f, const Field& field) {
        const auto number = number_of(field.text, Mark::point);
        if (!number || number->mark != Mark::point || number->is_grouped) return;
        if (!first_[f]) first_[f] = number->value;
        differ_ = differ_ || *first_[f] != number->value;
    }
    [[nodiscard]] bool differ() const { return differ_; }

private:
    std::vector<std::optional<double>> first_;
    bool differ_ = false;
};

bool is_unit(std::string_view name) {
    constexpr std::array<std::string_view, 29> units{
        "deg",    "degs", "dps", "dph",    "rad",    "rads",  "mrad", "urad",   "arcsec", "asec",
        "arcmin", "s",    "sec", "secs",   "ms",     "us",    "ns",   "min",    "hr",     "hz",
        "khz",    "mv",   "mg",  "counts", "pulses", "ticks", "degc", "kelvin", "celsius"};
    if (name.empty() || name.find('/') != std::string_view::npos || name.find('^') != std::string_view::npos) {
        // time [s], rate [deg/h] are names with units.
        const std::size_t bracket = name.find_first_of("[({");
        const std::size_t slash = name.find_first_of("/^");
        return bracket == std::string_view::npos || bracket == 0 || slash < bracket;
    }
    const bool is_of_latin_1 = name.front() == '\xC2';  // the degree and the micro sign, in UTF-8
    if (is_of_latin_1 || (!is_letter(name.front()) && (static_cast<unsigned char>(name.front()) & 0x80) == 0))
        return true;
    return std::ranges::find(units, text::lower_case(name)) != units.end();
}

// The columns that the header names without leaving their number open: none where a unit stands for itself among the
// names, or a comma among them may be one of prose.
std::vector<bool> named_columns(PartedLines& lines, const Dialect& dialect) {
    std::vector<bool> named(dialect.n_fields, false);
    if (!dialect.has_header || dialect.names.size() != dialect.n_fields) return named;
    const std::vector<Field>& names = lines.rows(dialect.separator).front();
    // Rows with one field more may end in a separator, or have an empty last field and a fraction between.
    if (names.size() != dialect.n_fields) return named;
    for (std::size_t f = 1; f < names.size(); ++f) {
        const std::string_view name = names[f].text;
        named[f] = names[f].is_quoted || !name.empty();
        if (names[f].is_quoted || name.empty()) continue;
        if (is_unit(name) || (dialect.separator == ',' && is_blank(*(name.data() - 1))))
            return std::vector<bool>(dialect.n_fields, false);
    }
    return named;
}

// Both, with the one sign between them, are a number whose thousands it parts.
bool may_be_thousands(const Field& before, const Field& field, char separator) {
    if (before.is_quoted || field.is_quoted || before.text.empty() || field.text.empty()) return false;
    const char* from = before.text.data();
    const char* to = field.text.data() + field.text.size();
    if (field.text.data() != from + before.text.size() + 1) return false;
    return has_parted_thousands({from, static_cast<std::size_t>(to - from)}, separator);
}

}  // namespace

std::optional<std::size_t> likely_fraction(PartedLines& lines, const Dialect& dialect) {
    const std::vector<bool> named = named_columns(lines, dialect);
    std::vector<Suspect> suspects(dialect.n_fields);
    Points points{dialect.n_fields};
    const auto rows = lines.rows(dialect.separator);
    for (std::size_t k = dialect.has_header ? 1 : 0; k < rows.size(); ++k) {
        const std::vector<Field>& fields = rows[k];
        for (std::size_t f = 0; f < fields.size() && f < dialect.n_fields; ++f) points.note(f, fields[f]);
        for (std::size_t f = 1; f < fields.size() && f < dialect.n_fields; ++f)
            if (suspects[f].is_open) suspects[f].note(fields[f - 1], fields[f]);
    }
    for (std::size_t f = 1; f < dialect.n_fields; ++f)
        if (!named[f] && (points.differ() ? suspects[f].is_of_second() : suspects[f].stands())) return f;
    return std::nullopt;
}

std::optional<std::size_t> likely_thousands(PartedLines& lines, const Dialect& dialect) {
    std::vector<bool> open(dialect.n_fields, true);
    const auto rows = lines.rows(dialect.separator);
    for (std::size_t k = dialect.has_header ? 1 : 0; k < rows.size(); ++k) {
        const std::vector<Field>& fields = rows[k];
        for (std::size_t f = 0; f < dialect.n_fields; ++f)
            open[f] = open[f] && f + 1 < fields.size() && may_be_thousands(fields[f], fields[f + 1], dialect.separator);
    }
    const auto found = std::ranges::find(open, true);
    if (found == open.end()) return std::nullopt;
    return static_cast<std::size_t>(found - open.begin());
}

bool header_counts_columns(PartedLines& lines, const Dialect& dialect) {
    const std::vector<bool> named = named_columns(lines, dialect);
    return named.size() > 1 && std::all_of(named.begin() + 1, named.end(), [](bool each) { return each; });
}

}  // namespace zlg::logs
