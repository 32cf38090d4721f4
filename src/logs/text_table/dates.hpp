#pragma once
// Dates and times of the day as the times of rows.

#include <cstdint>
#include <optional>
#include <string_view>

namespace zlg::logs {

// Seconds since 1970, the fraction apart, which a double would round; or since midnight where there is no date.
struct DateTime {
    std::int64_t seconds = 0;
    double fraction = 0.0;
    bool has_zone = false;
};

// 2026-11-24T08:30:00.005Z, 2026-11-24 08:30:00,005+01:00, 24.11.2026 08:30:00, 08:30:00.005. A date with strokes is
// none: which number is the month it does not say.
[[nodiscard]] std::optional<DateTime> date_time(std::string_view text);

}  // namespace zlg::logs
