#include <zlg/logs/text_columns.hpp>

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <string_view>
#include <zlg/logs/error.hpp>

#include "line_reader.hpp"

namespace zlg::logs {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

bool is_separator(char c) { return c == ',' || c == ';' || c == '|' || c == ':' || c == '/'; }

std::string_view without_leading_blanks(std::string_view text) {
    std::size_t n = 0;
    while (n < text.size() && is_blank(text[n])) ++n;
    return text.substr(n);
}

// The fields of a line, as far as they are wanted.
void split(std::string_view line, std::size_t most, std::vector<std::string_view>& fields) {
    fields.clear();
    line = without_leading_blanks(line);
    while (!line.empty() && fields.size() < most) {
        std::size_t end = 0;
        while (end < line.size() && !is_blank(line[end]) && !is_separator(line[end])) ++end;
        fields.push_back(line.substr(0, end));
        line = without_leading_blanks(line.substr(end));
        if (!line.empty() && is_separator(line.front())) {
            line = without_leading_blanks(line.substr(1));
            if (line.empty() && fields.size() < most) fields.emplace_back();
        }
    }
}

bool says_missing(std::string_view text) {
    constexpr std::string_view word = "nan";
    return text.empty() || std::ranges::equal(text, word, [](char a, char b) {
               return std::tolower(static_cast<unsigned char>(a)) == b;
           });
}

class Rows {
public:
    Rows(const std::string& path, const TextLayout& layout)
        : lines_(path), layout_(layout), most_(static_cast<std::size_t>(std::ranges::max(layout.columns))) {}

    [[nodiscard]] bool next(std::vector<std::vector<double>>& values) {
        std::string_view line;
        do {
            if (!lines_.next(line)) return false;
            line = without_leading_blanks(line);
        } while (line.empty() || (!layout_.comment.empty() && line.starts_with(layout_.comment)) || skipped_line());
        split(line, most_, fields_);
        for (std::size_t c = 0; c < layout_.columns.size(); ++c) values[c].push_back(number(layout_.columns[c], line));
        return true;
    }

private:
    bool skipped_line() { return n_seen_++ < layout_.skip_lines; }

    [[nodiscard]] FormatError refuse(std::int64_t column, const std::string& why) const {
        return FormatError(fmt::format("{}:{}, column {}: {}", lines_.path(), lines_.line_number(), column, why));
    }

    [[nodiscard]] double number(std::int64_t column, std::string_view line) const {
        if (static_cast<std::size_t>(column) > fields_.size())
            throw refuse(column, fmt::format("the line '{}' ends before it, allowed is column 1..{}",
                                             line.substr(0, 60), fields_.size()));
        const std::string_view field = fields_[static_cast<std::size_t>(column - 1)];
        if (says_missing(field)) return std::numeric_limits<double>::quiet_NaN();
        std::string_view digits = field;
        if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
        double value = 0.0;
        const auto [end, error] = fast_float::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value))
            throw refuse(column, fmt::format("'{}', allowed is a finite number, or nan where it is missing",
                                             field.substr(0, 60)));
        return value;
    }

    LineReader lines_;
    const TextLayout& layout_;
    std::size_t most_;
    std::vector<std::string_view> fields_;
    std::int64_t n_seen_ = 0;
};

}  // namespace

std::vector<std::vector<double>> read_text_columns(const std::string& path, const TextLayout& layout) {
    if (layout.columns.empty() || std::ranges::min(layout.columns) < 1 || layout.skip_lines < 0)
        throw FormatError(
            fmt::format("{}: columns from 1 on are needed, and no negative number of lines to skip", path));
    std::vector<std::vector<double>> values(layout.columns.size());
    Rows rows(path, layout);
    while (rows.next(values)) {
    }
    if (values.front().empty())
        throw FormatError(fmt::format("{}: no rows after comments and {} skipped lines", path, layout.skip_lines));
    return values;
}

}  // namespace zlg::logs
