#include "dates.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>
#include <zlg/text/spelling.hpp>

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

std::optional<std::int64_t> days_since_1970(int year, int month, int day) {
    if (month < 1 || month > 12 || day < 1 || day > days_of(year, month)) return std::nullopt;
    std::int64_t days = day - 1;
    for (int m = 1; m < month; ++m) days += days_of(year, m);
    const std::int64_t before = year - 1;  // whole years since the year 1
    return days + 365 * before + before / 4 - before / 100 + before / 400 - 719162;
}

struct Day {
    std::optional<std::int64_t> day_first, month_first;  // days since 1970; month_first: of a date with strokes
};

// 2026-11-24, 2026/11/24, 24.11.2026, 24/11/2026, 11/24/2026; neither: it is none.
Day date(std::string_view& text) {
    const bool year_first = text.find_first_of("-/") == 4;
    const auto first = digits(text, year_first ? 4 : 1, year_first ? 4 : 2);
    if (!first || text.empty()) return {};
    const char mark = text.front();
    if ((year_first ? mark != '-' : mark != '.') && mark != '/') return {};
    text.remove_prefix(1);
    const auto second = digits(text, 1, 2);
    if (!second || !take(text, mark)) return {};
    const auto third = digits(text, year_first ? 1 : 4, year_first ? 2 : 4);
    if (!third) return {};
    if (year_first) return Day{days_since_1970(*first, *second, *third), std::nullopt};
    return Day{days_since_1970(*third, *second, *first),
               mark == '/' ? days_since_1970(*third, *first, *second) : std::nullopt};
}

std::optional<DateTime> time_of_day(std::string_view& text, bool has_date) {
    const auto hour = digits(text, 1, 2);
    if (!hour || *hour > 59 || !take(text, ':')) return std::nullopt;
    const auto minute = digits(text, 2, 2);
    if (!minute || *minute > 59) return std::nullopt;
    DateTime time{.seconds = 3600 * *hour + 60 * *minute};
    // 08:30 without a date may be minutes and seconds, and 30:45.6 is.
    if (text.starts_with('.') && !has_date) {
        time.seconds = 60 * *hour + *minute;
    } else {
        if (*hour > 23) return std::nullopt;
        if (!take(text, ':')) return has_date ? std::optional{time} : std::nullopt;
        const auto second = digits(text, 2, 2);
        if (!second || *second > 59) return std::nullopt;
        time.seconds += *second;
    }
    if (!take(text, '.') && !take(text, ',')) return time;
    double unit = 0.1;
    std::size_t n = 0;
    for (; n < text.size() && text[n] >= '0' && text[n] <= '9'; ++n, unit *= 0.1)
        time.fraction += unit * (text[n] - '0');
    if (n == 0) return std::nullopt;
    text.remove_prefix(n);
    return time;
}

// Takes AM or PM off; false where the hour is none of it.
bool take_half_of_day(std::string_view& text, DateTime& time, bool& is_there) {
    while (take(text, ' ')) {
    }
    const std::string half = zlg::text::lower_case(text);
    is_there = half == "am" || half == "pm";
    if (!is_there) return true;
    text = {};
    const std::int64_t hour = time.seconds / 3600;
    if (hour < 1 || hour > 12) return false;
    time.seconds += 3600 * ((half == "pm" ? 12 : 0) - (hour == 12 ? 12 : 0));
    return true;
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
    const bool has_date =
        text.size() > 4 && (text[4] == '-' || std::min(text.find('.'), text.find('/')) < text.find(':'));
    Day day{.day_first = 0, .month_first = {}};
    if (has_date) {
        day = date(text);
        if (!day.day_first && !day.month_first) return std::nullopt;
        if (!take(text, 'T')) {
            if (!take(text, ' ')) return std::nullopt;
            while (take(text, ' ')) {
            }
        }
    }
    auto time = time_of_day(text, has_date);
    bool by_halves = false;
    if (!time || !take_half_of_day(text, *time, by_halves)) return std::nullopt;
    if (by_halves) std::swap(day.day_first, day.month_first);
    if (by_halves && !has_date) day.day_first = 0;
    if (!day.day_first) std::swap(day.day_first, day.month_first);
    const auto east_s = zone(text);
    if (!east_s || !day.day_first) return std::nullopt;
    time->has_zone = !text.empty();
    time->seconds -= *east_s;
    if (day.month_first && *day.month_first != *day.day_first)
        time->otherwise = time->seconds + 86400 * *day.month_first;
    time->seconds += 86400 * *day.day_first;
    return time;
}

// The way that goes on by less is the right one: the other goes by months where this goes by days.
double Dates::since_first(const DateTime& date) {
    if (!first_) first_ = date;
    const auto since = [&](bool other_way) {
        const auto seconds = [other_way](const DateTime& d) {
            return other_way ? d.otherwise.value_or(d.seconds) : d.seconds;
        };
        return static_cast<double>(seconds(date) - seconds(*first_)) + (date.fraction - first_->fraction);
    };
    const double one = since(other_way_), other = since(!other_way_);
    const bool other_is_nearer = std::fabs(other - last_s_) < std::fabs(one - last_s_);
    if (other_is_nearer) other_way_ = !other_way_;
    last_s_ = other_is_nearer ? other : one;
    return last_s_;
}

}  // namespace zlg::logs
