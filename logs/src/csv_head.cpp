#include "csv_head.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <zlg/logs/error.hpp>

namespace zlg::logs {

namespace {

constexpr std::string_view blanks = " \t";

// Prose with an equals sign in it is not a setting: a key has no blanks.
bool is_key(std::string_view text) { return !text.empty() && text.find_first_of(blanks) == std::string_view::npos; }

bool looks_like_number(std::string_view text) {
    return !text.empty() && text.find_first_not_of("+-.0123456789eE") == std::string_view::npos;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

void collect_setting(std::string_view line, Settings& settings) {
    line.remove_prefix(1);
    const auto equals = line.find('=');
    if (equals == std::string_view::npos) return;
    const std::string_view key = trimmed(line.substr(0, equals));
    if (is_key(key)) settings.emplace_back(key, trimmed(line.substr(equals + 1)));
}

CsvHead read_head(LineReader& lines) {
    CsvHead head;
    std::string_view line;
    do {
        if (!lines.next(line)) throw FormatError(fmt::format("{} is empty: no line of column names", lines.path()));
        if (line.starts_with('#')) collect_setting(line, head.settings);
    } while (trimmed(line).empty() || line.starts_with('#'));

    for_each_field(line, [&](std::string_view field) { head.names.emplace_back(trimmed(field)); });
    if (std::ranges::all_of(head.names, looks_like_number)) {
        throw FormatError(fmt::format("{}:{}: a row of numbers; the column names must stand above it", lines.path(),
                                      lines.line_number()));
    }
    const auto nameless = std::ranges::find(head.names, std::string{});
    if (nameless != head.names.end()) {
        throw FormatError(fmt::format("{}:{}: column {} of {} has no name", lines.path(), lines.line_number(),
                                      nameless - head.names.begin() + 1, head.names.size()));
    }
    return head;
}

}  // namespace zlg::logs
