#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include "motion_source.hpp"

namespace zlg::twin {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

bool is_separator(char c) { return c == ',' || c == ';' || c == '|' || c == ':' || c == '/'; }

std::string_view without_leading_blanks(std::string_view text) {
    std::size_t n = 0;
    while (n < text.size() && is_blank(text[n])) ++n;
    return text.substr(n);
}

// Split at blanks (a run of them is one border) or at a separator with blanks about it.
//
// return  field `column`, first is 1; n_columns tells how far the line goes, at most to that column.
struct Field {
    std::string_view text;
    int n_columns;
};

Field nth_field(std::string_view line, int column) {
    line = without_leading_blanks(line);
    for (int n = 1;; ++n) {
        std::size_t end = 0;
        while (end < line.size() && !is_blank(line[end]) && !is_separator(line[end])) ++end;
        if (n == column) return {line.substr(0, end), n};
        line = without_leading_blanks(line.substr(end));
        if (line.empty()) return {{}, n};
        if (is_separator(line.front())) line = without_leading_blanks(line.substr(1));
    }
}

std::string read_whole(const std::string& path) {
    std::error_code status;
    if (std::filesystem::is_directory(path, status)) {
        throw std::runtime_error(fmt::format("motion file '{}': is a directory, allowed is a text file", path));
    }
    std::ifstream stream{path, std::ios::binary};
    if (!stream) throw std::runtime_error(fmt::format("motion file '{}': cannot be opened for reading", path));
    std::string text{std::istreambuf_iterator<char>{stream}, std::istreambuf_iterator<char>{}};
    if (stream.bad()) throw std::runtime_error(fmt::format("motion file '{}': reading failed", path));
    return text;
}

double parse(const MotionFile& file, std::string_view line, std::size_t line_number) {
    const Field field = nth_field(line, file.column);
    const auto refuse = [&](const std::string& why) {
        return std::runtime_error(
            fmt::format("motion file '{}', line {}, column {}: {}", file.path, line_number, file.column, why));
    };
    if (field.n_columns < file.column) {
        throw refuse(
            fmt::format("the line '{}' ends before it, allowed is column 1..{}", line.substr(0, 60), field.n_columns));
    }
    std::string_view digits = field.text;
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = fast_float::from_chars(digits.data(), digits.data() + digits.size(), value);
    value *= file.scale_arcsec;
    if (file.holds_rate) value /= file.rate_hz;
    if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value)) {
        throw refuse(fmt::format("'{}', allowed is a finite number", field.text.substr(0, 60)));
    }
    return value;
}

void validate(const MotionFile& file) {
    const auto require = [](bool good, const char* member, double value, const char* allowed) {
        if (good) return;
        throw std::invalid_argument(fmt::format("motion file: {} is {}, allowed is {}", member, value, allowed));
    };
    require(file.column >= 1, "column", file.column, "1 or more");
    require(std::isfinite(file.scale_arcsec), "scale_arcsec", file.scale_arcsec, "a finite number");
    require(file.rate_hz > 0.0 && std::isfinite(file.rate_hz), "rate_hz", file.rate_hz, "finite and > 0");
    require(file.skip_lines >= 0, "skip_lines", file.skip_lines, "0 or more");
}

}  // namespace

std::vector<double> read_increments(const MotionFile& file) {
    validate(file);
    const std::string text = read_whole(file.path);
    std::vector<double> increments;
    std::string_view rest = text;
    int to_skip = file.skip_lines;
    for (std::size_t line_number = 1; !rest.empty(); ++line_number) {
        const std::size_t length = std::min(rest.find('\n'), rest.size());
        const std::string_view line = without_leading_blanks(rest.substr(0, length));
        rest.remove_prefix(std::min(length + 1, rest.size()));
        if (line.empty() || (!file.comment.empty() && line.starts_with(file.comment))) continue;
        if (to_skip > 0) {
            --to_skip;
        } else {
            increments.push_back(parse(file, line, line_number));
        }
    }
    if (increments.empty()) {
        throw std::runtime_error(
            fmt::format("motion file '{}': 0 rows after comments and {} skipped lines, allowed is 1 or more", file.path,
                        file.skip_lines));
    }
    return increments;
}

}  // namespace zlg::twin
