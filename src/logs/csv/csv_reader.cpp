#include "csv_reader.hpp"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <zlg/logs/error.hpp>
#include <zlg/text/escape.hpp>

#include "settings_lines.hpp"

namespace zlg::logs {

namespace {

// A value as it can stand in a one-line message.
std::string quoted(std::string_view value) { return fmt::format("'{}'", text::excerpt(value, 40, '?')); }

// `+1` is how a sign is written by hand; the parsers do not know it.
std::string_view without_plus(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    return text;
}

}  // namespace

CsvReader::CsvReader(const std::string& path, std::span<const KnownColumn> columns) : lines_{path}, columns_{columns} {
    CsvHead head = read_head(lines_);
    settings_ = std::move(head.settings);
    separator_ = head.separator;
    require_shallow_keys(settings_, path);
    map_ = map_columns(columns, head.names, fmt::format("{}:{}", path, lines_.line_number()));
    fields_.resize(head.names.size());
    if (lines_.at_end()) throw FormatError(fmt::format("{} is empty: no rows below the column names", path));
}

std::string CsvReader::place() const { return fmt::format("{}:{}, row {}", lines_.path(), lines_.line_number(), row_); }

void CsvReader::fail(std::size_t column, std::string_view what) const {
    const bool cut = !lines_.terminated() && *map_.field_of[column] + 1 == fields_.size();
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

std::size_t CsvReader::split_fields_of(std::string_view line) {
    std::size_t n = 0;
    if (separator_ == ',' && line.find('"') == std::string_view::npos) {
        for (;;) {
            const std::size_t comma = line.find(',');
            if (n < fields_.size()) fields_[n] = trimmed(line.substr(0, comma));
            ++n;
            if (comma == std::string_view::npos) return n;
            line.remove_prefix(comma + 1);
        }
    }
    split_fields(line, separator_, quoted_fields_);
    for (; n < std::min(fields_.size(), quoted_fields_.size()); ++n) fields_[n] = quoted_fields_[n].text;
    return quoted_fields_.size();
}

void CsvReader::split(std::string_view line) {
    const std::size_t n = split_fields_of(line);
    if (n == fields_.size()) return;
    if (n < fields_.size() && !lines_.terminated()) {
        throw FormatError(
            fmt::format("{}: truncated: the file ends after {} of {} fields", place(), n, fields_.size()));
    }
    if (line.starts_with('#')) {
        throw FormatError(fmt::format("{}: a line with # must stand above the column names", place()));
    }
    throw FormatError(fmt::format("{}: {} fields, where the column names are {}", place(), n, fields_.size()));
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
