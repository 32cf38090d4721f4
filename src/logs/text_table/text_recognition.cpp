#include "text_recognition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <zlg/logs/error.hpp>

#include "text_commas.hpp"
#include "text_reading.hpp"

namespace zlg::logs {

namespace {

struct Separator {
    char letter;
    TextSeparator asked;
    const char* name;
};

// The likeliest first, where two give the same numbers.
constexpr std::array<Separator, 5> separators{{{'\t', TextSeparator::tab, "tab"},
                                               {';', TextSeparator::semicolon, "semicolon"},
                                               {'|', TextSeparator::bar, "bar"},
                                               {',', TextSeparator::comma, "comma"},
                                               {blanks_separator, TextSeparator::blanks, "space"}}};

const char* name_of(char separator) { return std::ranges::find(separators, separator, &Separator::letter)->name; }

bool has_quoted_comma(const FirstLines& sample) {
    std::vector<Field> fields;
    for (const Line& line : sample.lines) {
        if (line.text.find('"') == std::string::npos) continue;
        split_fields(line.text, ',', fields);
        for (const Field& field : fields)
            if (field.is_quoted && field.text.find(',') != std::string_view::npos) return true;
    }
    return false;
}

// As many tabs in every row, each between two fields, part columns; the blanks stand in words, dates and numbers.
bool tabs_part_rows(const FirstLines& sample) {
    std::vector<Field> fields;
    std::size_t n_fields = 0;
    split_fields(sample.lines.front().text, '\t', fields);
    const bool may_be_header = sample.lines.size() > 1 && may_be_name(fields.front().text);
    for (std::size_t k = may_be_header ? 1 : 0; k < sample.lines.size(); ++k) {
        split_fields(sample.lines[k].text, '\t', fields);
        const auto is_empty = [](const Field& field) { return field.text.empty() && !field.is_quoted; };
        if (fields.size() < 2 || std::ranges::any_of(fields, is_empty)) return false;
        if (n_fields > 0 && fields.size() != n_fields) return false;
        n_fields = fields.size();
    }
    return true;
}

std::vector<Reading> all_readings(const FirstLines& sample, const std::string& path, const TextLayout& layout) {
    const bool quoted_commas = has_quoted_comma(sample);
    const bool tabs_part = layout.separator == TextSeparator::automatic && tabs_part_rows(sample);
    std::vector<Reading> readings;
    for (const auto& [separator, asked, name] : separators) {
        if (layout.separator != TextSeparator::automatic && layout.separator != asked) continue;
        if (separator == blanks_separator && tabs_part) continue;
        for (const Mark mark : {Mark::point, Mark::comma}) {
            if (layout.mark == TextMark::point && mark == Mark::comma) continue;
            if (layout.mark == TextMark::comma && mark == Mark::point) continue;
            // A comma can be both only where the numbers stand in quotes.
            const bool said = layout.separator != TextSeparator::automatic && layout.mark != TextMark::automatic;
            if (separator == ',' && mark == Mark::comma && !quoted_commas && !said) continue;
            readings.push_back(read_as(separator, mark, sample, path, layout));
        }
    }
    return readings;
}

std::string in_words(const Reading& reading) {
    std::string numbers;
    const std::size_t n = reading.dialect.wanted.size();
    for (std::size_t k = 0; k < std::min<std::size_t>(n, 4) && k < reading.wanted.size(); ++k)
        numbers += fmt::format("{}{}", k == 0 ? "" : " and ", reading.wanted[k]);
    return fmt::format("separator {}, decimal {}: {} column{}, {} asked for", name_of(reading.dialect.separator),
                       reading.dialect.mark == Mark::comma ? "comma" : "point", reading.dialect.n_fields,
                       reading.dialect.n_fields == 1 ? "" : "s", numbers);
}

[[noreturn]] void refuse_ambiguous(const FirstLines& sample, const std::string& path, const TextLayout& layout,
                                   const Reading& a, const std::string& other) {
    const Line& line = sample.lines[a.dialect.has_header ? 1 : 0];
    throw FormatError(
        fmt::format("{0}:{1}: '{2}' can be read as {3}, or as {4}; say which by {5}.separator and {5}.decimal", path,
                    line.number, shown(line.text), in_words(a), other, layout.section));
}

// Every row has a number with parted thousands, or two columns of which the second has three digits.
void refuse_parted_thousands(const FirstLines& sample, const std::string& path, const TextLayout& layout,
                             const Reading& reading) {
    const Dialect& dialect = reading.dialect;
    if (dialect.separator != ',' && dialect.separator != blanks_separator) return;
    if (layout.separator != TextSeparator::automatic || dialect.n_fields < 2) return;
    if (header_counts_columns(sample, dialect)) return;
    const auto found = likely_thousands(sample, dialect);
    if (!found) return;
    refuse_ambiguous(
        sample, path, layout, reading,
        fmt::format("fewer columns with parted thousands, which are not read, column {} being the thousands "
                    "of the next",
                    *found + 1));
}

// Between commas, any number might be the fraction of the one before.
void refuse_double_commas(const FirstLines& sample, const std::string& path, const TextLayout& layout,
                          const Reading& reading) {
    if (reading.dialect.separator != ',' || layout.separator != TextSeparator::automatic) return;
    if (layout.mark == TextMark::point) return;
    const auto found = likely_fraction(sample, reading.dialect);
    if (!found) return;
    refuse_ambiguous(
        sample, path, layout, reading,
        fmt::format("fewer columns with decimal commas, column {} being the fraction of the one before", *found + 1));
}

}  // namespace

Dialect recognise_dialect(const FirstLines& sample, const std::string& path, const TextLayout& layout) {
    std::vector<Reading> readings = all_readings(sample, path, layout);
    std::vector<const Reading*> good;
    for (const Reading& reading : readings)
        if (reading.verdict == Verdict::good) good.push_back(&reading);
    if (good.empty()) {
        // A way that parts columns says more than one that takes a whole line for a number.
        const auto rank = [](const Reading& r) { return std::pair{r.dialect.n_fields > 1, r.verdict}; };
        throw FormatError(std::ranges::max_element(readings, {}, rank)->reason);
    }
    const bool commas_part = std::ranges::any_of(
        good, [](const Reading* r) { return r->dialect.separator == ',' && r->dialect.names.size() > 1; });
    if (commas_part) std::erase_if(good, [](const Reading* r) { return r->names_hold_commas; });

    const Reading& first = *good.front();
    bool mark_is_open = layout.mark == TextMark::automatic;
    for (const Reading* other : good) {
        const bool same = other->wanted == first.wanted && other->is_cut == first.is_cut &&
                          other->dialect.has_header == first.dialect.has_header;
        if (!same) refuse_ambiguous(sample, path, layout, first, in_words(*other));
    }
    if (first.is_cut)
        throw FormatError(fmt::format("{}:{}: fewer than {} fields, and no end; the file may have been cut off", path,
                                      sample.lines.back().number, first.dialect.n_fields));
    refuse_parted_thousands(sample, path, layout, first);
    refuse_double_commas(sample, path, layout, first);
    Dialect dialect = first.dialect;
    mark_is_open = mark_is_open && std::ranges::count_if(good, [&](const Reading* r) {
                                       return r->dialect.separator == dialect.separator;
                                   }) > 1;
    if (mark_is_open) dialect.mark = Mark::none;
    if (layout.mark != TextMark::automatic) dialect.mark_is_sure = true;
    return dialect;
}

}  // namespace zlg::logs
