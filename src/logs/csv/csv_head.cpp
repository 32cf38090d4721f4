#include "csv_head.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <zlg/logs/error.hpp>
#include <zlg/logs/log_kind.hpp>

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

std::ptrdiff_t hits(const CsvHead& head, std::initializer_list<std::string_view> known) {
    return std::count_if(head.names.begin(), head.names.end(), [&](std::string_view name) {
        return std::find(known.begin(), known.end(), name) != known.end();
    });
}

}  // namespace

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

}  // namespace zlg::logs
