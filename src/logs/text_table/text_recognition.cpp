#include "text_recognition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <span>
#include <utility>
#include <zlg/logs/error.hpp>
#include <zlg/text/escape.hpp>

#include "text_commas.hpp"

namespace zlg::logs {

namespace {

// As much of a line as a message holds.
std::string shown(std::string_view line) { return text::excerpt(line, 60, ' '); }

// Said of a text that has both marks.
const char* without_thousands(std::string_view text) {
    const bool both = text.find(',') != std::string_view::npos && text.find('.') != std::string_view::npos;
    return both ? " without parted thousands" : "";
}

bool is_header(const std::vector<Field>& fields) {
    bool has_word = false;
    for (const Field& field : fields) {
        if (says_missing(field.text)) continue;
        if (!may_be_name(field.text) || number_of(field.text, Mark::none)) return false;
        has_word = true;
    }
    return has_word;
}

// 12:00:00,050 is a time of the day.
bool has_commas_within(std::string_view word) {
    while (word.ends_with(',')) word.remove_suffix(1);
    const auto n = std::count(word.begin(), word.end(), ',');
    return n > 1 || (n == 1 && (word.find(':') == std::string_view::npos || std::ranges::any_of(word, [](char c) {
                                    return std::isalpha(static_cast<unsigned char>(c)) != 0 && c != 'T' && c != 'Z';
                                })));
}

// A word that another separator would part is none.
bool holds_a_separator(const Field& field, char separator) {
    if (field.is_quoted) return false;
    const auto has = [&](char c) { return c != separator && field.text.find(c) != std::string_view::npos; };
    return has(';') || has('|') || has('\t') || (separator == blanks_separator && has_commas_within(field.text));
}

// Commas that part words without a blank part names.
bool commas_part_names(std::string_view header) {
    if (header.find(',') == std::string_view::npos) return false;
    std::vector<Field> parts;
    split_fields(header, ',', parts);
    return std::ranges::all_of(parts,
                               [](const Field& part) {
                                   return may_be_name(part.text) && std::ranges::all_of(part.text, [](char c) {
                                              return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
                                          });
                               }) &&
           header.find(", ") == std::string_view::npos;
}

// Columns of a good reading.
struct AskedFor {
    Verdict verdict = Verdict::good;
    std::string reason;
    std::vector<std::size_t> fields;  // from 0
    std::vector<double> values;       // row by row
};

class Judge {
public:
    Judge(PartedLines& lines, const std::string& path, const TextLayout& layout)
        : parted_{lines}, lines_{lines.lines()}, path_{path}, layout_{layout} {}

    [[nodiscard]] Reading read(char separator, Mark mark) const {
        Reading reading;
        Dialect& dialect = reading.dialect;
        dialect.separator = separator;
        dialect.mark = mark;
        const Rows rows = parted_.rows(separator);
        for (std::size_t k = 0; k < rows.size(); ++k) {
            if (rows[k].size() <= max_fields) continue;
            std::vector<Field> all;
            split_fields(lines_[k].text, separator, all);
            dialect.n_fields = all.size();
            refuse(reading, Verdict::ragged, k, fmt::format(": {} fields, allowed is {}", all.size(), max_fields));
            return reading;
        }
        dialect.has_header = rows.size() > 1 && is_header(rows.front());
        const bool good = counts_agree(rows, reading) && header_fits(rows, reading) && fields_are_whole(rows, reading);
        if (!good) return reading;
        reading.verdict = Verdict::good;
        for (std::size_t k = first_row(dialect); k < rows.size() && !dialect.mark_is_sure; ++k)
            for (const Field& field : rows[k]) note_mark(field, dialect);
        return reading;
    }

    [[nodiscard]] AskedFor ask_for(const std::vector<std::int64_t>& columns, const Reading& reading) const {
        AskedFor asked;
        const Dialect& dialect = reading.dialect;
        for (const std::int64_t column : columns) {
            asked.fields.push_back(static_cast<std::size_t>(column - 1));
            if (asked.fields.back() < dialect.n_fields) continue;
            asked.verdict = Verdict::no_such_column;
            asked.reason = fmt::format("{}: column {}, allowed is column 1..{}", path_, column, dialect.n_fields);
            return asked;
        }
        const Rows rows = parted_.rows(dialect.separator);
        for (std::size_t k = first_row(dialect); k < rows.size(); ++k) {
            for (const std::size_t f : asked.fields) {
                if (f >= rows[k].size()) continue;  // of the last line, which is cut
                const std::string_view text = rows[k][f].text;
                const auto number = number_of(text, dialect.mark);
                if (!number && !says_missing(text)) {
                    const char* hint = k == 0 ? "; a header has words alone, others are skipped by " : "";
                    asked.verdict = Verdict::not_numbers;
                    asked.reason = fmt::format(
                        "{}:{}, column {}: '{}', allowed is a finite number, or nan where it is missing{}", path_,
                        lines_[k].number, f + 1, shown(text), k == 0 ? hint + layout_.section + ".skip_lines" : "");
                    return asked;
                }
                asked.values.push_back(number ? number->value : std::numeric_limits<double>::max());
            }
        }
        return asked;
    }

private:
    using Rows = std::span<const std::vector<Field>>;

    static std::size_t first_row(const Dialect& dialect) { return dialect.has_header ? 1 : 0; }

    bool refuse(Reading& reading, Verdict verdict, std::size_t line, const std::string& why) const {
        reading.verdict = verdict;
        reading.reason = fmt::format("{}:{}{}", path_, lines_[line].number, why);
        return false;
    }

    bool counts_agree(Rows rows, Reading& reading) const {
        Dialect& dialect = reading.dialect;
        const std::size_t first = first_row(dialect);
        dialect.n_fields = rows[first].size();
        for (std::size_t k = first; k < rows.size(); ++k) {
            if (rows[k].size() == dialect.n_fields) continue;
            const bool last = parted_.sample().is_whole && !parted_.sample().is_terminated && k + 1 == rows.size();
            if (last && k > first && rows[k].size() < dialect.n_fields) {
                reading.is_cut = true;
                continue;
            }
            return refuse(reading, Verdict::ragged, k,
                          fmt::format(": {} fields, where the rows above have {}", rows[k].size(), dialect.n_fields));
        }
        return true;
    }

    bool header_fits(Rows rows, Reading& reading) const {
        Dialect& dialect = reading.dialect;
        dialect.ends_empty = std::all_of(rows.begin() + (dialect.has_header ? 1 : 0), rows.end(),
                                         [](const auto& row) { return row.back().text.empty(); });
        if (!dialect.has_header) {
            take_names_of_comment(dialect);
            return true;
        }
        const std::vector<Field>& names = rows.front();
        const bool one_less = dialect.ends_empty && names.size() + 1 == dialect.n_fields;
        if (names.size() == dialect.n_fields || one_less) {
            for (const Field& name : names) dialect.names.emplace_back(name.text);
            if (one_less) dialect.names.emplace_back();
        } else if (dialect.separator != blanks_separator) {
            return refuse(
                reading, Verdict::wrong_header, 0,
                fmt::format(": the header '{}' names {} columns, and the rows have {}; {}.skip_lines = 1 skips it",
                            shown(lines_.front().text), names.size(), dialect.n_fields, layout_.section));
        }
        reading.names_hold_commas = dialect.separator != ',' && commas_part_names(lines_.front().text);
        return true;
    }

    void take_names_of_comment(Dialect& dialect) const {
        std::vector<Field> names;
        split_fields(lines_.front().comment, dialect.separator, names);
        if (names.size() != dialect.n_fields || !is_header(names)) return;
        for (const Field& name : names) dialect.names.emplace_back(name.text);
    }

    // What is said twice, separator and mark, needs no proof by columns that are not asked for.
    bool fields_are_whole(Rows rows, Reading& reading) const {
        if (layout_.separator != TextSeparator::automatic && layout_.mark != TextMark::automatic) return true;
        const auto kinds = parted_.kinds(reading.dialect.separator, reading.dialect.mark);
        for (std::size_t k = first_row(reading.dialect); k < rows.size(); ++k) {
            for (std::size_t f = 0; f < rows[k].size(); ++f) {
                const Field& field = rows[k][f];
                const FieldKind kind = kinds[k][f];
                if (kind == FieldKind::broken ||
                    (kind == FieldKind::word && holds_a_separator(field, reading.dialect.separator)))
                    return refuse(
                        reading, Verdict::broken_field, k,
                        fmt::format(", column {}: '{}', allowed is a finite number{}, or nan where it is missing",
                                    f + 1, shown(field.text), without_thousands(field.text)));
            }
        }
        return true;
    }

    void note_mark(const Field& field, Dialect& dialect) const {
        const auto number = number_of(field.text, dialect.mark);
        if (number && number->mark != Mark::none && !number->is_grouped) dialect.mark_is_sure = true;
    }

    PartedLines& parted_;
    std::span<const Line> lines_;
    const std::string& path_;
    const TextLayout& layout_;
};

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
    if (!std::ranges::any_of(lines.lines(), [](const Line& line) { return line.text.find('"') != std::string::npos; }))
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
            readings_.push_back(Judge{lines, path, layout}.read(separator, mark));
        }
    }
    suspicions_.resize(readings_.size());
}

Recognised Recognition::of_columns(const std::vector<std::int64_t>& columns) {
    std::vector<Good> good;
    const auto rank = [](const Reading& reading, Verdict verdict) {
        return std::pair{reading.dialect.n_fields > 1, verdict};
    };
    std::optional<std::pair<bool, Verdict>> best;
    std::string reason;
    for (const Reading& reading : readings_) {
        AskedFor asked{.verdict = reading.verdict, .reason = reading.reason, .fields = {}, .values = {}};
        if (reading.verdict == Verdict::good) asked = Judge{lines_, path_, layout_}.ask_for(columns, reading);
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
                "fewer columns with parted thousands, which are not read, column {} being the thousands of the next",
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
