#include "csv_reader.hpp"

#include <algorithm>
#include <charconv>
#include <initializer_list>

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <zlg/logs/error.hpp>
#include <zlg/logs/log_kind.hpp>
#include <zlg/text/escape.hpp>

#include "settings_lines.hpp"
#include "text_fields.hpp"

namespace zlg::logs {
namespace {

constexpr std::string_view blanks = " \t";

// As much as an HDF5 log may hold.
constexpr std::size_t max_settings_bytes = std::size_t{16} << 20;

bool looks_like_number(std::string_view text) {
    return !text.empty() && text.find_first_not_of("+-.,0123456789eE") == std::string_view::npos;
}

// Of the names of columns: the one that stands there most often; blanks where there is no other.
char separator_of(std::string_view names) {
    char found = blanks_separator;
    std::ptrdiff_t most = 0;
    for (const char separator : {',', ';', '\t', '|'}) {
        const auto n = std::count(names.begin(), names.end(), separator);
        if (n > most) found = separator;
        most = std::max(most, n);
    }
    return trimmed(names).find_first_of(blanks) == std::string_view::npos && most == 0 ? ',' : found;
}

// What stands above the rows: lines `# key = value`, then one line of column names.
struct CsvHead {
    Settings settings;               // in their order; other lines that begin with # are ignored
    std::vector<std::string> names;  // of the columns, without surrounding blanks and quotes
    char separator = ',';            // that parts them: , ; | tab, or ' ' for any run of blanks
};

// errors  FormatError: the file is empty, no line of names, numbers in its place, a nameless column.
CsvHead read_head(LineReader& lines) {
    CsvHead head;
    std::string_view line;
    std::size_t n_bytes = 0;
    do {
        if (!lines.next(line)) throw FormatError(fmt::format("{} is empty: no line of column names", lines.path()));
        if (!line.starts_with('#')) continue;
        const std::size_t before = head.settings.size();
        collect_setting(line, head.settings);
        if (head.settings.size() > before) n_bytes += line.size();
        if (n_bytes > max_settings_bytes)
            throw FormatError(fmt::format("{}:{}: settings of more than {} bytes, which is the most allowed",
                                          lines.path(), lines.line_number(), max_settings_bytes));
    } while (trimmed(line).empty() || line.starts_with('#'));

    head.separator = separator_of(line);
    std::vector<Field> fields;
    split_fields(line, head.separator, fields);
    for (const Field& field : fields) head.names.emplace_back(field.text);
    if (std::all_of(head.names.begin(), head.names.end(), looks_like_number)) {
        throw FormatError(fmt::format("{}:{}: a row of numbers; the column names must stand above it", lines.path(),
                                      lines.line_number()));
    }
    const auto nameless = std::find(head.names.begin(), head.names.end(), std::string{});
    if (nameless != head.names.end()) {
        throw FormatError(fmt::format("{}:{}: column {} of {} has no name", lines.path(), lines.line_number(),
                                      nameless - head.names.begin() + 1, head.names.size()));
    }
    return head;
}

std::ptrdiff_t hits(const CsvHead& head, std::initializer_list<std::string_view> known) {
    return std::count_if(head.names.begin(), head.names.end(), [&](std::string_view name) {
        return std::find(known.begin(), known.end(), name) != known.end();
    });
}

// A value as it can stand in a one-line message.
std::string quoted(std::string_view value) { return fmt::format("'{}'", text::excerpt(value, 40, '?')); }

// `+1` is how a sign is written by hand; the parsers do not know it.
std::string_view without_plus(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    return text;
}

}  // namespace

LogKind recognise_text(const std::string& path) {
    try {
        LineReader lines{path};
        const CsvHead head = read_head(lines);
        const auto raw = hits(head, {"half", "bias_sign", "counts", "loop_closed"});
        const auto angle = hits(head, {"tick", "t_s", "dtheta_arcsec", "dtheta_final_arcsec", "sigma_arcsec", "flags"});
        if (raw >= 2 && raw > angle) return LogKind::raw_csv;
        if (angle >= 2 && angle > raw) return LogKind::angle_csv;
    } catch (const FormatError&) {
        // Not the text of a log: that is the answer, not a failure.
    }
    return LogKind::unknown;
}

CsvReader::CsvReader(const std::string& path, std::span<const KnownColumn> columns) : lines_{path}, columns_{columns} {
    CsvHead head = read_head(lines_);
    settings_ = std::move(head.settings);
    separator_ = head.separator;
    require_shallow_keys(settings_, path);
    map_ = map_columns(columns, head.names, fmt::format("{}:{}", path, lines_.line_number()));
    n_fields_ = head.names.size();
    if (lines_.at_end()) throw FormatError(fmt::format("{} is empty: no rows below the column names", path));
}

std::string CsvReader::place() const { return fmt::format("{}:{}, row {}", lines_.path(), lines_.line_number(), row_); }

void CsvReader::fail(std::size_t column, std::string_view what) const {
    const bool cut = !lines_.terminated() && *map_.field_of[column] + 1 == n_fields_;
    throw FormatError(fmt::format("{}, column '{}': {} {}{}", place(), columns_[column].name, quoted(field(column)),
                                  what, cut ? " (the last line has no end: the file may be truncated)" : ""));
}

void CsvReader::expect_only_empty_lines() {
    const std::string where = place();
    std::string_view line;
    while (lines_.next(line)) {
        if (!trimmed(line).empty()) throw FormatError(fmt::format("{}: an empty line between rows", where));
    }
    if (row_ == 1) throw FormatError(fmt::format("{} is empty: no rows below the column names", lines_.path()));
}

void CsvReader::split(std::string_view line) {
    split_fields(line, separator_, fields_);
    const std::size_t n = fields_.size();
    if (n == n_fields_) return;
    if (n < n_fields_ && !lines_.terminated())
        throw FormatError(fmt::format("{}: truncated: the file ends after {} of {} fields", place(), n, n_fields_));
    if (line.starts_with('#')) {
        throw FormatError(fmt::format("{}: a line with # must stand above the column names", place()));
    }
    throw FormatError(fmt::format("{}: {} fields, where the column names are {}", place(), n, n_fields_));
}

bool CsvReader::next() {
    std::string_view line;
    if (!lines_.next(line)) return false;
    ++row_;
    if (trimmed(line).empty()) {
        expect_only_empty_lines();
        return false;
    }
    split(line);
    return true;
}

std::optional<std::int64_t> CsvReader::integer(std::size_t column) const {
    const std::string_view text = without_plus(field(column));
    std::int64_t value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || stop != text.data() + text.size()) return std::nullopt;
    return value;
}

void CsvReader::fail_integer(std::size_t column, const std::string& allowed) const {
    const std::string_view digits = field(column).substr(field(column).find_first_not_of("+-") == 1 ? 1 : 0);
    const bool whole = !digits.empty() && digits.find_first_not_of("0123456789") == std::string_view::npos;
    fail(column, fmt::format("is {}; allowed is {}", whole ? "out of range" : "not an integer", allowed));
}

std::optional<double> CsvReader::real(std::size_t column) const {
    const std::string_view text = without_plus(field(column));
    double value = 0.0;
    const auto [stop, error] = fast_float::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_whole = error == std::errc{} && stop == text.data() + text.size();
    if (is_whole && separator_ == ',' && mark_ == Mark::none) return value;
    // Where commas do not part columns, they may be decimal; in one file there is one mark.
    const auto number = number_of(text, Mark::none);
    if (!is_whole && !number) return std::nullopt;
    if (number && number->mark != Mark::none) {
        if (mark_ != Mark::none && mark_ != number->mark)
            fail(column, fmt::format("has a decimal {}, and numbers above have the other mark; allowed is one",
                                     number->mark == Mark::comma ? "comma" : "point"));
        mark_ = number->mark;
    }
    return is_whole ? value : number->value;
}

}  // namespace zlg::logs
