#include <zlg/recorded/motion.hpp>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/time_check.hpp>
#include <zlg/rig/wiring.hpp>

namespace zlg::recorded {
namespace {

using config::ConfigError;

// Two days of 200 rows a second, a quarter of a gigabyte; and no device that never ends.
constexpr std::size_t max_rows = std::size_t{1} << 25;
constexpr std::int64_t max_bytes = std::int64_t{1} << 30;

// The words of the configuration are those of the reader, in their order.
static_assert(static_cast<int>(config::TextSeparator::bar) == static_cast<int>(logs::TextSeparator::bar) &&
              static_cast<int>(config::DecimalMark::comma) == static_cast<int>(logs::TextMark::comma));

void refuse_times(const config::Motion& m, const logs::TextLayout& layout, const logs::TextTable& table) {
    const std::string mistaken = logs::mistaken_times(table, m.path, layout, !m.column.empty(), "motion");
    if (!mistaken.empty()) throw ConfigError{mistaken};
    const logs::TimeCheck check = logs::check_times(table, m.path, layout, m.rate_hz);
    if (!check.contradiction.empty()) throw ConfigError{check.contradiction};
    // A twin has nobody to warn.
    if (!check.presumption.empty())
        throw ConfigError{fmt::format("{}; motion.time_column = 0 leaves it out", check.presumption)};
    if (check.times && check.times->n_missing > 0)
        throw logs::FormatError{logs::missing_in_words(table, m.path, *check.times) + "; a motion has no holes"};
}

twin::Motion motion_of_file(const config::Motion& m) {
    const logs::TextLayout layout = text_layout(m);
    logs::TextTable table = logs::read_text_table(m.path, layout);
    refuse_times(m, layout, table);
    std::vector<double> values = table.columns.front().values.vector();
    for (std::size_t row = 0; row < values.size(); ++row) {
        const double read = values[row];
        values[row] = rig::motion_increment_arcsec(m, read);
        if (!std::isfinite(values[row]))
            throw logs::FormatError{fmt::format("{}, {}: {} in row {}, allowed is a finite number", m.path,
                                                logs::described(table.columns.front()), read, row + 1)};
    }
    return twin::Motion::from_increments(std::move(values), m.rate_hz);
}

}  // namespace

logs::TextLayout text_layout(const config::Motion& m) {
    return {.columns = {m.column.empty() ? "1" : m.column},
            .comment = m.comment,
            .skip_lines = m.skip_lines,
            .separator = static_cast<logs::TextSeparator>(m.separator),
            .mark = static_cast<logs::TextMark>(m.decimal),
            .time_column = m.time_column,
            .section = "motion",
            .max_rows = max_rows,
            .max_bytes = max_bytes};
}

twin::Motion motion(const config::Config& config) {
    return config.motion.kind == config::MotionKind::file ? motion_of_file(config.motion) : rig::motion(config);
}

}  // namespace zlg::recorded
