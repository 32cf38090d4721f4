#include "text_recognition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
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

bool has_quoted_comma(PartedLines& lines) {
    if (std::ranges::none_of(lines.lines(), [](const Line& line) { return line.text.find('"') != std::string::npos; }))
        return false;
    return std::ranges::any_of(lines.rows(','), [](const std::vector<Field>& fields) {
        return std::ranges::any_of(fields, [](const Field& field) {
            return field.is_quoted && field.text.find(',') != std::string_view::npos;
        });
    });
}

// As many tabs in every row, each between two fields, part columns; the blanks stand in words, dates and numbers.
bool tabs_part_rows(PartedLines& lines) {
    const auto rows = lines.rows('\t');
    const bool may_be_header = rows.size() > 1 && may_be_name(rows.front().front().text);
    const std::size_t first = may_be_header ? 1 : 0;
    for (const std::vector<Field>& fields : rows.subspan(first)) {
        const auto is_empty = [](const Field& field) { return field.text.empty() && !field.is_quoted; };
        if (fields.size() < 2 || std::ranges::any_of(fields, is_empty)) return false;
        if (fields.size() != rows[first].size()) return false;
    }
    return true;
}

struct Good {
    const Reading* reading = nullptr;
    AskedFor asked;
};

std::string in_words(const Good& good) {
    std::string numbers;
    const std::size_t n = good.asked.fields.size();
    for (std::size_t k = 0; k < std::min<std::size_t>(n, 4) && k < good.asked.values.size(); ++k)
        numbers += fmt::format("{}{}", k == 0 ? "" : " and ", good.asked.values[k]);
    const Dialect& dialect = good.reading->dialect;
    return fmt::format("separator {}, decimal {}: {} column{}, {} asked for", name_of(dialect.separator),
                       dialect.mark == Mark::comma ? "comma" : "point", dialect.n_fields,
                       dialect.n_fields == 1 ? "" : "s", numbers);
}

bool same_numbers(const Good& a, const Good& b) {
    return a.asked.values == b.asked.values && a.reading->is_cut == b.reading->is_cut &&
           a.reading->dialect.has_header == b.reading->dialect.has_header;
}

}  // namespace

Recognition::Recognition(PartedLines& lines, const std::string& path, const TextLayout& layout)
    : lines_{lines}, path_{path}, layout_{layout} {
    const bool quoted_commas = has_quoted_comma(lines);
    const bool tabs_part = layout.separator == TextSeparator::automatic && tabs_part_rows(lines);
    for (const auto& [separator, asked, name] : separators) {
        if (layout.separator != TextSeparator::automatic && layout.separator != asked) continue;
        if (separator == blanks_separator && tabs_part) continue;
        for (const Mark mark : {Mark::point, Mark::comma}) {
            if (layout.mark == TextMark::point && mark == Mark::comma) continue;
            if (layout.mark == TextMark::comma && mark == Mark::point) continue;
            // A comma can be both only where the numbers stand in quotes.
            const bool said = layout.separator != TextSeparator::automatic && layout.mark != TextMark::automatic;
            if (separator == ',' && mark == Mark::comma && !quoted_commas && !said) continue;
            readings_.push_back(read_as(separator, mark, lines, path, layout));
        }
    }
    suspicions_.resize(readings_.size());
}

Recognised Recognition::of_columns(const std::vector<std::string>& columns) {
    std::vector<Good> good;
    const auto rank = [](const Reading& reading, Verdict verdict) {
        return std::pair{reading.dialect.n_fields > 1, verdict};
    };
    std::optional<std::pair<bool, Verdict>> best;
    std::string reason;
    for (const Reading& reading : readings_) {
        AskedFor asked{.verdict = reading.verdict, .reason = reading.reason, .fields = {}, .values = {}};
        if (reading.verdict == Verdict::good) asked = ask_for(columns, reading, lines_, path_, layout_);
        // A way that parts columns says more than one that takes a whole line for a number.
        if (asked.verdict == Verdict::good) {
            good.push_back({&reading, std::move(asked)});
        } else if (!best || rank(reading, asked.verdict) > *best) {
            best = rank(reading, asked.verdict);
            reason = std::move(asked.reason);
        }
    }
    if (good.empty()) throw FormatError(reason);
    const bool commas_part = std::ranges::any_of(
        good, [](const Good& g) { return g.reading->dialect.separator == ',' && g.reading->dialect.names.size() > 1; });
    if (commas_part) std::erase_if(good, [](const Good& g) { return g.reading->names_hold_commas; });

    const Good& first = good.front();
    for (const Good& other : good)
        if (!same_numbers(first, other)) refuse_ambiguous(*first.reading, in_words(first), in_words(other));
    if (first.reading->is_cut)
        throw FormatError(fmt::format("{}:{}: fewer than {} fields, and no end; the file may have been cut off", path_,
                                      lines_.lines().back().number, first.reading->dialect.n_fields));
    if (const std::string other = suspicion(*first.reading); !other.empty())
        refuse_ambiguous(*first.reading, in_words(first), other);
    const Dialect& dialect = first.reading->dialect;
    const auto n_marks =
        std::ranges::count_if(good, [&](const Good& g) { return g.reading->dialect.separator == dialect.separator; });
    const bool mark_is_open = layout_.mark == TextMark::automatic && n_marks > 1;
    return {.reading = first.reading,
            .mark = mark_is_open ? Mark::none : dialect.mark,
            .mark_is_sure = dialect.mark_is_sure || layout_.mark != TextMark::automatic,
            .wanted = first.asked.fields};
}

void Recognition::refuse_ambiguous(const Reading& reading, const std::string& one, const std::string& other) const {
    const Line& line = lines_.lines()[reading.dialect.has_header ? 1 : 0];
    throw FormatError(fmt::format(
        "{0}:{1}: '{2}' can be read as {3}, or as {4}; say which by {5}.separator=tab|semicolon|bar|comma|space and "
        "{5}.decimal=point|comma",
        path_, line.number, shown(line.text), one, other, layout_.section));
}

const std::string& Recognition::suspicion(const Reading& reading) {
    auto& known = suspicions_[static_cast<std::size_t>(&reading - readings_.data())];
    if (!known) known = suspicion_of(reading.dialect);
    return *known;
}

std::string Recognition::suspicion_of(const Dialect& dialect) {
    if (layout_.separator != TextSeparator::automatic) return {};
    // Every row has a number with parted thousands, or two columns of which the second has three digits.
    if ((dialect.separator == ',' || dialect.separator == blanks_separator) && dialect.n_fields > 1 &&
        !header_counts_columns(lines_, dialect))
        if (const auto found = likely_thousands(lines_, dialect))
            return fmt::format(
                "fewer columns with parted thousands, which are not read, column {} being the thousands "
                "of the next",
                *found + 1);
    // Between commas, any number might be the fraction of the one before.
    if (dialect.separator == ',' && layout_.mark != TextMark::point)
        if (const auto found = likely_fraction(lines_, dialect))
            return fmt::format("fewer columns with decimal commas, column {} being the fraction of the one before",
                               *found + 1);
    return {};
}

Dialect Recognised::dialect() const {
    Dialect dialect = reading->dialect;
    dialect.mark = mark;
    dialect.mark_is_sure = mark_is_sure;
    dialect.wanted = wanted;
    return dialect;
}

Dialect recognise_dialect(const FirstLines& sample, const std::string& path, const TextLayout& layout) {
    PartedLines lines{sample};
    return Recognition{lines, path, layout}.of_columns(layout.columns).dialect();
}

}  // namespace zlg::logs
