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
    std::optional<std::int64_t> otherwise;  // the seconds, where day and month may be the other way round
};

// 2026-11-24T08:30:00.005Z, 2026-11-24 08:30:00,005+01:00, 24.11.2026 08:30:00, 08:30:00.005, 11/24/2026 8:30:00 AM,
// 24/11/2026 08:30:00; 30:00.0 are minutes and seconds. Of a date with strokes that has no number above 12 the month is
// the first where AM or PM stands behind, and else the second, and `otherwise` is the other.
[[nodiscard]] std::optional<DateTime> date_time(std::string_view text);

// The times of rows, one after the other, as seconds from the first one on.
class Dates {
public:
    [[nodiscard]] double since_first(const DateTime& date);
    [[nodiscard]] bool any() const { return first_.has_value(); }

private:
    std::optional<DateTime> first_;
    double last_s_ = 0.0;
    bool other_way_ = false;  // day and month
};

}  // namespace zlg::logs
