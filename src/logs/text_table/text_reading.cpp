#include "text_reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <span>
#include <zlg/logs/error.hpp>
#include <zlg/text/escape.hpp>
#include <zlg/text/spelling.hpp>

namespace zlg::logs {

namespace {

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
    const auto n = std::ranges::count(word, ',');
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

    [[nodiscard]] AskedFor ask_for(const std::vector<std::string>& columns, const Reading& reading) const {
        AskedFor asked;
        const Dialect& dialect = reading.dialect;
        try {
            for (const std::string& column : columns) asked.fields.push_back(field_of(column, dialect, path_));
        } catch (const FormatError& error) {
            asked.verdict = Verdict::no_such_column;
            asked.reason = error.what();
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

}  // namespace

std::string shown(std::string_view line) { return text::excerpt(line, 60, ' '); }

namespace {

// The name that is nearly the one asked for, or all names.
std::string nearest(const std::string& column, const std::vector<std::string>& names) {
    const auto apart = [asked = text::lower_case(column)](const std::string& name) {
        return text::letters_apart(asked, text::lower_case(name));
    };
    const std::string& best = *std::ranges::min_element(names, {}, apart);
    if (apart(best) <= std::max<std::size_t>(2, column.size() / 3))
        return fmt::format("did you mean '{}'?", shown(best));
    std::string all;
    for (const std::string& name : names)
        if (!name.empty()) all += fmt::format("{}'{}'", all.empty() ? "" : ", ", shown(name));
    return "its columns are " + all;
}

}  // namespace

std::size_t field_of(const std::string& column, const Dialect& dialect, const std::string& path) {
    if (column.find_first_not_of("0123456789") == std::string::npos) {
        const std::size_t number = column.size() > 7 ? 0 : std::stoul("0" + column);
        if (number >= 1 && number <= dialect.n_fields) return number - 1;
        throw FormatError(fmt::format("{}: column {}, allowed is column 1..{}", path, column, dialect.n_fields));
    }
    const auto found = std::ranges::find(dialect.names, column);
    if (found == dialect.names.end()) {
        if (dialect.names.empty())
            throw FormatError(fmt::format(
                "{}: column '{}': {}; allowed is a number 1..{}", path, shown(column),
                dialect.has_header ? "the header has not one word for each column" : "the file names no columns",
                dialect.n_fields));
        throw FormatError(fmt::format("{}: no column '{}'; {}", path, shown(column), nearest(column, dialect.names)));
    }
    if (std::find(found + 1, dialect.names.end(), column) != dialect.names.end())
        throw FormatError(fmt::format("{}: two columns are named '{}'; give the number", path, shown(column)));
    return static_cast<std::size_t>(found - dialect.names.begin());
}

Reading read_as(char separator, Mark mark, PartedLines& lines, const std::string& path, const TextLayout& layout) {
    return Judge{lines, path, layout}.read(separator, mark);
}

AskedFor ask_for(const std::vector<std::string>& columns, const Reading& reading, PartedLines& lines,
                 const std::string& path, const TextLayout& layout) {
    return Judge{lines, path, layout}.ask_for(columns, reading);
}

}  // namespace zlg::logs
