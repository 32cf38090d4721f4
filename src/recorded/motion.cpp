#include <zlg/recorded/motion.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/imported.hpp>
#include <zlg/logs/log_kind.hpp>
#include <zlg/rig/wiring.hpp>

namespace zlg::recorded {
namespace {

// Two days of 200 rows a second, a quarter of a gigabyte.
constexpr std::size_t max_rows = std::size_t{1} << 25;

// The section as the mapping of `zlg import`.
logs::Mapping mapping_of(const config::Motion& m) {
    constexpr std::array<const char*, 6> separators{"", "space", "tab", "semicolon", "comma", "bar"};
    constexpr std::array<const char*, 3> marks{"", "point", "comma"};
    logs::Mapping mapping;
    const auto set = [&mapping](const char* key, const std::string& value) {
        if (!value.empty()) mapping.set(key, value, "[motion]");
    };
    mapping.set("comment", m.comment, "[motion]");
    set("skip_lines", fmt::format("{}", m.skip_lines));
    set("sensor", "none");
    set("separator", separators.at(static_cast<std::size_t>(m.separator)));
    set("decimal", marks.at(static_cast<std::size_t>(m.decimal)));
    set("time", m.time_column == "0" ? "none" : m.time_column);
    set("rate_hz", fmt::format("{}", m.rate_hz));
    set("axis", m.column);
    return mapping;
}

std::string in_words_of_motion(std::string message) {
    constexpr std::array<std::pair<const char*, const char*>, 4> words{
        {{"--map axis", "motion.column"},
         {"--map time=none", "motion.time_column = 0"},
         {"time_unit=s, ms, us, ns, or time=none", "motion.time_column = 0"},
         {"--map ", "motion."}}};
    for (const auto& [from, to] : words)
        for (std::size_t at = message.find(from); at != std::string::npos; at = message.find(from))
            message.replace(at, std::string_view{from}.size(), to);
    return message;
}

logs::TextColumn column_of_file(const config::Motion& m) {
    logs::require_regular_file(m.path);  // it is looked at twice
    std::string key;
    try {
        const logs::Mapping mapping = mapping_of(m);
        const logs::ForeignTable table = logs::foreign_table(m.path, mapping);
        key = fmt::format("motion.rate_hz = {}: ", m.rate_hz);
        return logs::even_column(table, mapping);
    } catch (const logs::MappingError& error) {
        const std::string words = in_words_of_motion(error.what());
        throw config::ConfigError{words.starts_with("motion.") ? words : key + words};
    } catch (const logs::FormatError& error) {
        throw logs::FormatError{in_words_of_motion(error.what())};
    }
}

twin::Motion motion_of_file(const config::Motion& m) {
    const logs::TextColumn column = column_of_file(m);
    if (column.values.size() > max_rows)
        throw logs::FormatError{fmt::format("{}: {} rows; allowed are {}", m.path, column.values.size(), max_rows)};
    std::vector<double> values = column.values.vector();
    for (std::size_t row = 0; row < values.size(); ++row) {
        const double read = values[row];
        values[row] = rig::motion_increment_arcsec(m, read);
        if (!std::isfinite(values[row]))
            throw logs::FormatError{fmt::format("{}, {}: {} in row {}, allowed is a finite number", m.path,
                                                logs::described(column), read, row + 1)};
    }
    return twin::Motion::from_increments(std::move(values), m.rate_hz);
}

}  // namespace

twin::Motion motion(const config::Config& config) {
    return config.motion.kind == config::MotionKind::file ? motion_of_file(config.motion) : rig::motion(config);
}

}  // namespace zlg::recorded
