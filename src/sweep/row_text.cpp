#include <zlg/sweep/row_text.hpp>

#include <charconv>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include <zlg/wire/crc.hpp>

namespace zlg::sweep {
namespace {

constexpr std::size_t max_fields = 100'000;

std::vector<std::string_view> split(std::string_view line) {
    std::vector<std::string_view> fields;
    for (std::size_t at = 0; fields.size() < max_fields;) {
        const std::size_t end = line.find('\t', at);
        fields.push_back(line.substr(at, end - at));
        if (end == std::string_view::npos) break;
        at = end + 1;
    }
    return fields;
}

template <class T> bool read_number(std::string_view text, T& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
}

}  // namespace

// gyro, status, fingerprint, reason, metrics. Control characters in a reason are escaped already.
std::string fields_of(const Row& row) {
    std::string line =
        fmt::format("{}\t{}\t{}\t{}", row.gyro, static_cast<std::int64_t>(row.status), row.fingerprint, row.reason);
    // One text for what is no number.
    for (const double value : row.metrics) line += std::isnan(value) ? "\tnan" : fmt::format("\t{}", value);
    return line;
}

std::string text_of(const Row& row) {
    const std::string fields = fields_of(row);
    return fmt::format("{}\t{}", fields, text_checksum(fields));
}

std::optional<Row> row_of(std::string_view line, std::size_t n_metrics) {
    const std::size_t last_tab = line.rfind('\t');
    if (last_tab == std::string_view::npos || line.substr(last_tab + 1) != text_checksum(line.substr(0, last_tab)))
        return std::nullopt;
    const std::vector<std::string_view> fields = split(line.substr(0, last_tab));
    Row row;
    std::int64_t status = 0;
    if (fields.size() != 4 + n_metrics || !read_number(fields[0], row.gyro) || !read_number(fields[1], status))
        return std::nullopt;
    if (row.gyro < 0 || row.gyro >= max_gyros) return std::nullopt;
    row.status = static_cast<Status>(status);
    row.fingerprint = fields[2];
    row.reason = fields[3];
    row.metrics.assign(n_metrics, 0.0);
    for (std::size_t k = 0; k < n_metrics; ++k)
        if (!read_number(fields[4 + k], row.metrics[k])) return std::nullopt;
    return row;
}

std::string text_checksum(std::string_view text) {
    return fmt::format("{:08x}", wire::crc32c({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}));
}

}  // namespace zlg::sweep
