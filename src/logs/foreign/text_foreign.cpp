// Text: the way to read it is the one that `analyze` recognises, below the lines that are neither names nor numbers.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <zlg/logs/error.hpp>
#include <zlg/logs/text_columns.hpp>
#include <zlg/text/escape.hpp>
#include <zlg/text/spelling.hpp>

#include "foreign_readers.hpp"
#include "text_table/dates.hpp"
#include "text_table/text_recognition.hpp"
#include "units.hpp"

namespace zlg::logs {

namespace {

constexpr std::int64_t max_preamble = 40;

const std::map<std::string, TextSeparator> separators{{"tab", TextSeparator::tab},
                                                      {"semicolon", TextSeparator::semicolon},
                                                      {"bar", TextSeparator::bar},
                                                      {"comma", TextSeparator::comma},
                                                      {"space", TextSeparator::blanks}};

const std::map<char, std::string> separator_words{
    {'\t', "tabs"}, {';', "semicolons"}, {'|', "bars"}, {',', "commas"}, {blanks_separator, "blanks"}};

TextLayout layout_of(const Mapping& mapping) {
    TextLayout layout;
    layout.section = "--map ";
    if (mapping.has("separator")) layout.separator = separators.at(mapping.text("separator"));
    if (mapping.has("decimal")) layout.mark = mapping.text("decimal") == "comma" ? TextMark::comma : TextMark::point;
    if (mapping.has("comment")) layout.comment = mapping.text("comment");
    if (mapping.text("sensor") != "none") layout.only_with = mapping.text("sensor");
    layout.is_windows_1251 = mapping.text("encoding") == "windows-1251";
    if (const auto n = mapping.real("skip_lines")) layout.skip_lines = static_cast<std::int64_t>(*n);
    return layout;
}

// The messages of the readers name keys as --set does.
std::string in_words_of_mapping(std::string message) {
    for (std::size_t at = message.find("--map ."); at != std::string::npos; at = message.find("--map ."))
        message.replace(at, 7, "--map ");
    return message;
}

bool is_numeric(PartedLines& lines, const Dialect& dialect, std::size_t field) {
    bool has_number = false;
    for (const std::vector<FieldKind>& kinds :
         lines.kinds(dialect.separator, dialect.mark).subspan(dialect.has_header ? 1 : 0)) {
        if (field >= kinds.size()) continue;
        if (kinds[field] != FieldKind::number && kinds[field] != FieldKind::missing) return false;
        has_number = has_number || kinds[field] == FieldKind::number;
    }
    return has_number;
}

// Commas between names of our own, of which one is also a unit.
bool names_our_columns(PartedLines& lines) {
    return std::ranges::count_if(lines.rows(',').front(), [](const Field& field) { return is_raw_key(field.text); }) >
           1;
}

// The columns of numbers that some way of reading shows; the first one where none does.
std::vector<std::size_t> columns_of_numbers(const Recognition& recognition, PartedLines& lines) {
    std::set<std::size_t> numeric;
    for (const Reading& reading : recognition.readings()) {
        if (reading.verdict != Verdict::good) continue;
        for (std::size_t f = 0; f < reading.dialect.n_fields; ++f)
            if (is_numeric(lines, reading.dialect, f)) numeric.insert(f);
    }
    if (numeric.empty()) return {0};
    return {numeric.begin(), numeric.end()};
}

// Recognised by each column of numbers that some way of reading shows: two ways that differ in any of them are refused.
Dialect dialect_of(PartedLines& lines, const std::string& path, TextLayout layout) {
    if (layout.separator == TextSeparator::automatic && names_our_columns(lines))
        layout.separator = TextSeparator::comma;
    Recognition recognition{lines, path, layout};
    std::optional<Recognised> found;
    std::string reason;
    for (const std::size_t f : columns_of_numbers(recognition, lines)) {
        try {
            const Recognised one = recognition.of_columns({static_cast<std::int64_t>(f) + 1});
            if (!found) found = one;
            const char before = found->reading->dialect.separator, now = one.reading->dialect.separator;
            if (before != now)
                throw MappingError(
                    fmt::format("{}: its columns can be parted by {} or by {}; say which by --map "
                                "separator=tab|semicolon|bar|comma|space",
                                path, separator_words.at(before), separator_words.at(now)));
            if (one.mark != Mark::none) found->mark = one.mark;
        } catch (const FormatError& error) {
            const std::string message = in_words_of_mapping(error.what());
            if (message.find("say which") != std::string::npos) throw MappingError(message);
            if (reason.empty()) reason = message;
        }
    }
    if (!found) throw FormatError(reason);
    return found->dialect();
}

// No row of numbers: a line that may stand above a table, one of nothing but separators too.
bool may_be_preamble(PartedLines& lines) {
    if (lines.lines().front().text.find_first_not_of("\t;|, ") == std::string::npos) return true;
    for (const char separator : {'\t', ';', '|', ',', blanks_separator}) {
        const std::vector<Field>& fields = lines.rows(separator).front();
        if (!fields.empty() && std::ranges::all_of(fields, [](const Field& field) {
                return number_of(field.text, Mark::none).has_value() || says_missing(field.text) ||
                       date_time(field.text).has_value();
            }))
            return false;
    }
    return std::ranges::any_of(lines.lines().front().text,
                               [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; });
}

// Where every line begins as a comment does, none is one.
FirstLines sample_of(const std::string& path, const Mapping& mapping, TextLayout& layout) {
    FirstLines sample = first_lines_of(path, layout);
    if (!sample.lines.empty() || sample.head.empty() || mapping.has("comment")) return sample;
    layout.comment.clear();
    return first_lines_of(path, layout);
}

struct Look {
    Look(const std::string& path, const Mapping& mapping)
        : layout{layout_of(mapping)}, sample{sample_of(path, mapping, layout)}, lines{sample} {}
    Look(const Look&) = delete;
    Look& operator=(const Look&) = delete;

    TextLayout layout;
    FirstLines sample;
    PartedLines lines;
    Dialect dialect;
    std::vector<std::string> units;
    std::vector<std::string> preamble;
};

std::vector<std::string> words_of(const std::string& line, const Dialect& dialect) {
    std::vector<Field> fields;
    split_fields(line, dialect.separator, fields);
    // LabVIEW names a column of comments, which its rows leave out.
    if (fields.size() == dialect.n_fields + 1 && (fields.back().text.empty() || fields.back().text == "Comment"))
        fields.pop_back();
    if (fields.size() + 1 == dialect.n_fields && dialect.ends_empty) fields.emplace_back();
    if (fields.size() != dialect.n_fields) return {};
    std::vector<std::string> words;
    for (const Field& field : fields) words.emplace_back(field.text);
    return words;
}

// Lines of words above the numbers: the last two may be names and units.
void find_table(Look& look, const std::string& path, const Mapping& mapping) {
    std::string reason;
    for (std::int64_t skipped = 0; skipped <= max_preamble && !look.lines.lines().empty(); ++skipped) {
        try {
            look.dialect = dialect_of(look.lines, path, look.layout);
            if (names_our_columns(look.lines)) look.layout.separator = TextSeparator::comma;
            for (std::size_t f = 0; f < look.dialect.n_fields; ++f)
                if (is_numeric(look.lines, look.dialect, f)) return;
        } catch (const FormatError& error) {
            if (reason.empty()) reason = error.what();
        }
        if (mapping.has("skip_lines") || !may_be_preamble(look.lines)) break;
        look.preamble.push_back(look.lines.lines().front().text);
        look.lines.skip_line();
        ++look.layout.skip_lines;
    }
    if (reason.empty()) reason = fmt::format("{}: holds no rows of numbers", path);
    if (!mapping.has("skip_lines") || !mapping.has("sensor"))
        reason += fmt::format(
            "; a head of more than {} lines is skipped by --map skip_lines=NUMBER, rows without a word of those that "
            "are wanted by --map sensor=WORD",
            max_preamble);
    throw FormatError(reason);
}

// One line of numbers may be a record that was written without ends of lines, and is none of rows.
void refuse_one_row(const Look& look, const std::string& path) {
    if (!look.sample.is_whole || look.lines.lines().size() != (look.dialect.has_header ? 2u : 1u)) return;
    throw FormatError(fmt::format("{}:{}: holds one row, of {} field{}; allowed are rows, one below the other", path,
                                  look.lines.lines().back().number, look.dialect.n_fields,
                                  look.dialect.n_fields == 1 ? "" : "s"));
}

std::string without_brackets(std::string unit) {
    while (!unit.empty() && std::string_view{"[(<"}.find(unit.front()) != std::string_view::npos) unit.erase(0, 1);
    while (!unit.empty() && std::string_view{"])>"}.find(unit.back()) != std::string_view::npos) unit.pop_back();
    return unit;
}

// Most of the words are units: of angles, of times, or in brackets.
bool are_units(const std::vector<std::string>& words) {
    constexpr std::array<std::string_view, 18> others{"s", "ms", "us", "ns", "min", "h",    "hz",    "c", "degc",
                                                      "k", "v",  "mv", "a",  "ma",  "m/s2", "m/s^2", "g", "m/s"};
    std::size_t n_units = 0, n_words = 0;
    for (const std::string& word : words) {
        if (word.empty() || word == "-") continue;
        ++n_words;
        const std::string unit = without_brackets(word);
        n_units += std::string_view{"[(<"}.find(word.front()) != std::string_view::npos || unit_named(unit) ||
                           unit.starts_with("\xC2\xB0") ||
                           std::ranges::find(others, text::lower_case(unit)) != others.end()
                       ? 1u
                       : 0u;
    }
    return 2 * n_units > n_words;
}

// Names in one line and units in the next: the reader took the units for the names, or nothing.
void take_names_above(Look& look) {
    if (look.preamble.empty()) return;
    const std::vector<std::string> above = words_of(look.preamble.back(), look.dialect);
    if (above.empty()) return;
    if (look.dialect.has_header && !look.dialect.names.empty()) {
        if (!are_units(look.dialect.names)) return;
        look.units = look.dialect.names;
    } else if (are_units(above) && look.preamble.size() > 1) {
        // Units such as [°/s] are no names for the reader.
        const std::vector<std::string> names = words_of(look.preamble[look.preamble.size() - 2], look.dialect);
        const bool are_names =
            !names.empty() && std::ranges::all_of(names, [](const std::string& w) { return may_be_name(w); });
        if (are_names) {
            look.units = above;
            look.dialect.names = names;
            return;
        }
    }
    if (std::ranges::all_of(above, [](const std::string& w) { return w.empty() || may_be_name(w); }))
        look.dialect.names = above;
    else
        look.units.clear();
}

ForeignColumn column_of(Look& look, const std::string& path, std::size_t f) {
    ForeignColumn column{.number = static_cast<std::int64_t>(f) + 1, .name = {}, .first = {}, .values = {}};
    if (f < look.dialect.names.size()) column.name = look.dialect.names[f];
    if (const std::size_t at = column.name.find("\"\""); at != std::string::npos) column.name.erase(at, 1);
    if (f < look.units.size() && !look.units[f].empty())
        column.name += fmt::format(" [{}]", without_brackets(look.units[f]));
    column.is_number = is_numeric(look.lines, look.dialect, f);
    Dates dates;
    std::size_t n_numbers = 0, n_words = 0;
    const std::size_t header = look.dialect.has_header ? 1 : 0;
    for (const std::vector<Field>& fields : look.lines.rows(look.dialect.separator).subspan(header)) {
        if (f >= fields.size()) break;
        if (column.values.empty()) column.first = text::excerpt(fields[f].text, 30, ' ');
        const auto number = number_of(fields[f].text, look.dialect.mark);
        double value = number ? number->value : std::numeric_limits<double>::quiet_NaN();
        n_numbers += number ? 1u : 0u;
        if (!number && !says_missing(fields[f].text) && n_words++ == 0)
            column.word =
                fmt::format("{}:{}, column {}: '{}'", path, look.lines.lines()[column.values.size() + header].number,
                            column.number, text::excerpt(fields[f].text, 60, ' '));
        if (!column.is_number) {
            if (const auto date = date_time(fields[f].text)) value = dates.since_first(*date);
            const auto known = std::ranges::find(column.words, fields[f].text);
            column.kinds.push_back(known - column.words.begin());
            if (known == column.words.end() && column.words.size() <= most_words)
                column.words.emplace_back(fields[f].text);
        }
        column.values.push_back(value);
    }
    if (n_words >= n_numbers) column.word.clear();
    column.holds_dates = dates.any() && std::ranges::all_of(column.values, [](double v) { return std::isfinite(v); });
    return column;
}

std::string nature_of(const Look& look) {
    std::string nature = "text";
    if (look.dialect.n_fields > 1) nature += ", columns parted by " + separator_words.at(look.dialect.separator);
    if (look.dialect.mark != Mark::none)
        nature += look.dialect.mark == Mark::comma ? ", decimal comma" : ", decimal point";
    const std::int64_t first_row = look.lines.lines()[look.dialect.has_header ? 1 : 0].number;
    nature += look.dialect.names.empty() ? ", no names of columns" : ", named columns";
    if (!look.units.empty()) nature += " with a line of units";
    return nature + fmt::format(", numbers from line {} on", first_row);
}

}  // namespace

ForeignTable text_table_of(const std::string& path, const Mapping& mapping) {
    Look look{path, mapping};
    if (look.sample.has_other_letters && !mapping.has("encoding"))
        throw MappingError(
            fmt::format("{}: its letters are neither UTF-8 nor plainly Latin-1; say which by --map "
                        "encoding=windows-1251 or latin-1",
                        path));
    find_table(look, path, mapping);
    refuse_one_row(look, path);
    take_names_above(look);
    ForeignTable table{.path = path, .nature = nature_of(look), .columns = {}, .notes = {}, .n_rows = {}, .read = {}};
    table.head = look.sample.head;
    table.head.insert(table.head.end(), look.preamble.begin(), look.preamble.end());
    for (std::size_t f = 0; f < look.dialect.n_fields; ++f) table.columns.push_back(column_of(look, path, f));
    if (!ends_with_a_line(path))
        table.notes.emplace_back("its last line has no end: if the file was cut off, its last number may be too short");
    std::vector<std::string> names;
    for (const ForeignColumn& column : table.columns) names.push_back(column.name);
    table.read = [path, layout = look.layout, names](const std::vector<std::int64_t>& wanted, std::int64_t times) {
        TextLayout asked = layout;
        asked.columns = wanted;
        asked.time_column = times;
        try {
            TextTable read = read_text_table(path, asked);
            for (TextColumn& column : read.columns) column.name = names[static_cast<std::size_t>(column.number - 1)];
            if (read.times) read.times->name = names[static_cast<std::size_t>(read.times->number - 1)];
            return read;
        } catch (const FormatError& error) {
            const std::string message = in_words_of_mapping(error.what());
            const bool is_open = message.find("; say ") != std::string::npos;
            if (is_open) throw MappingError(message);
            throw FormatError(message);
        }
    };
    return table;
}

}  // namespace zlg::logs
