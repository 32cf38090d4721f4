#include "raw_timer.hpp"

#include <fmt/format.h>

#include <zlg/logs/error.hpp>

#include "settings_lines.hpp"

namespace zlg::logs {

void check_timer_hz(double timer_hz, const std::string& place) {
    if (timer_hz >= 1.0 && timer_hz <= 1e15) return;
    throw FormatError(
        fmt::format("{}: edge_offset_ticks needs the timer's ticks per second: {} = {}; allowed is 1..1e15", place,
                    timer_setting, timer_hz));
}

double take_timer_hz(Settings& settings, std::optional<double> of_root, const std::string& place) {
    std::optional<double> found = of_root;
    for (const auto& [key, text] : settings) {
        if (key != timer_setting) continue;
        const std::optional<double> value = number_in(text);
        if (value && (!found || *found == *value)) {
            found = value;
            continue;
        }
        throw FormatError(fmt::format("{}: {} = {}; allowed is one number, 1..1e15", place, timer_setting, text));
    }
    if (!found) {
        throw FormatError(fmt::format(
            "{}: the column edge_offset_ticks needs the timer's ticks per second: {} is missing (CSV: a line `# {} = "
            "...`, HDF5: an attribute of the root)",
            place, timer_setting, timer_setting));
    }
    check_timer_hz(*found, place);
    std::erase_if(settings, [](const auto& setting) { return setting.first == timer_setting; });
    return *found;
}

}  // namespace zlg::logs
