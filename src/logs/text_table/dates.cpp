#include "dates.hpp"

#include <array>
#include <charconv>

namespace zlg::logs {

namespace {

// Takes so many digits, or from one to so many, off the front.
std::optional<int> digits(std::string_view& text, std::size_t least, std::size_t most) {
    std::size_t n = 0;
    while (n < text.size() && n < most && text[n] >= '0' && text[n] <= '9') ++n;
    if (n < least) return std::nullopt;
    int value = 0;
    std::from_chars(text.data(), text.data() + n, value);
    text.remove_prefix(n);
    return value;
}

bool take(std::string_view& text, char letter) {
    if (!text.starts_with(letter)) return false;
    text.remove_prefix(1);
    return true;
}

int days_of(int year, int month) {
    constexpr std::array<int, 12> days{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    const bool leaps = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    return days[static_cast<std::size_t>(month - 1)] + (month == 2 && leaps ? 1 : 0);
}

// Days since 1970.
std::optional<std::int64_t> date(std::string_view& text) {
    std::optional<int> year, month, day;
    if (text.size() > 4 && text[4] == '-') {
        year = digits(text, 4, 4);
        if (!year || !take(text, '-') || !(month = digits(text, 1, 2)) || !take(text, '-') ||
            !(day = digits(text, 1, 2)))
            return std::nullopt;
    } else {
        if (!(day = digits(text, 1, 2)) || !take(text, '.') || !(month = digits(text, 1, 2)) || !take(text, '.') ||
            !(year = digits(text, 4, 4)))
            return std::nullopt;
    }
    if (*month < 1 || *month > 12 || *day < 1 || *day > days_of(*year, *month)) return std::nullopt;
    std::int64_t days = *day - 1;
    for (int m = 1; m < *month; ++m) days += days_of(*year, m);
    const std::int64_t before = *year - 1;  // whole years since the year 1
    return days + 365 * before + before / 4 - before / 100 + before / 400 - 719162;
}

std::optional<DateTime> time_of_day(std::string_view& text, bool has_date) {
    const auto hour = digits(text, 1, 2);
    if (!hour || *hour > 23 || !take(text, ':')) return std::nullopt;
    const auto minute = digits(text, 2, 2);
    if (!minute || *minute > 59) return std::nullopt;
    DateTime time{.seconds = 3600 * *hour + 60 * *minute};
    // 08:30 without a date may be minutes and seconds.
    if (!take(text, ':')) return has_date ? std::optional{time} : std::nullopt;
    const auto second = digits(text, 2, 2);
    if (!second || *second > 59) return std::nullopt;
    time.seconds += *second;
    if (!take(text, '.') && !take(text, ',')) return time;
    double unit = 0.1;
    std::size_t n = 0;
    for (; n < text.size() && text[n] >= '0' && text[n] <= '9'; ++n, unit *= 0.1)
        time.fraction += unit * (text[n] - '0');
    if (n == 0) return std::nullopt;
    text.remove_prefix(n);
    return time;
}

// Z, +01:00, -0130: how far before UTC, s.
std::optional<std::int64_t> zone(std::string_view text) {
    if (text.empty() || text == "Z") return 0;
    const int sign = text.front() == '+' ? 1 : text.front() == '-' ? -1 : 0;
    if (sign == 0) return std::nullopt;
    text.remove_prefix(1);
    const auto hour = digits(text, 2, 2);
    take(text, ':');
    const auto minute = text.empty() ? std::optional{0} : digits(text, 2, 2);
    if (!hour || !minute || !text.empty()) return std::nullopt;
    return sign * (3600 * *hour + 60 * *minute);
}

}  // namespace

std::optional<DateTime> date_time(std::string_view text) {
    const bool has_date = text.size() > 4 && (text[4] == '-' || text.find('.') < text.find(':'));
    std::int64_t days = 0;
    if (has_date) {
        const auto found = date(text);
        if (!found) return std::nullopt;
        days = *found;
        if (!take(text, 'T')) {
            if (!take(text, ' ')) return std::nullopt;
            while (take(text, ' ')) {
            }
        }
    }
    auto time = time_of_day(text, has_date);
    if (!time) return std::nullopt;
    const auto east_s = zone(text);
    if (!east_s) return std::nullopt;
    time->seconds += 86400 * days - *east_s;
    return time;
}

}  // namespace zlg::logs
