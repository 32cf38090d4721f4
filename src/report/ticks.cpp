#include "ticks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include <fmt/format.h>

#include "text.hpp"

namespace zlg::report {
namespace {

// Labels of round numbers, held as n * 10^exponent so that no digit of a label comes from binary rounding.
struct Decimal {
    long long n = 0;
    int exponent = 0;
};

constexpr const char* hard_space = "\u00A0";
constexpr const char* minus_sign = "\u2212";

std::string grouped(const std::string& digits) {
    if (digits.size() < 5) return digits;
    std::string out;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0) out += hard_space;
        out += digits[i];
    }
    return out;
}

int n_digits(long long n) { return static_cast<int>(std::to_string(std::llabs(n)).size()); }

double value_of(Decimal decimal) {
    const double n = static_cast<double>(decimal.n);
    const double power = std::pow(10.0, std::abs(decimal.exponent));
    return decimal.exponent < 0 ? n / power : n * power;
}

// Every digit written out, thousands parted from five digits on.
std::string plain_label(Decimal decimal) {
    if (decimal.n == 0) return "0";
    const std::string sign = decimal.n < 0 ? minus_sign : "";
    std::string digits = std::to_string(std::llabs(decimal.n));
    if (decimal.exponent >= 0) {
        return sign + grouped(digits + std::string(static_cast<std::size_t>(decimal.exponent), '0'));
    }
    const auto n_decimals = static_cast<std::size_t>(-decimal.exponent);
    if (digits.size() <= n_decimals) digits.insert(0, n_decimals + 1 - digits.size(), '0');
    const std::size_t point = digits.size() - n_decimals;
    return sign + grouped(digits.substr(0, point)) + "." + digits.substr(point);
}

// 10 to the power, with superscript digits.
std::string power_label(int exponent) { return "10" + superscript(std::to_string(exponent)); }

std::string with_power(Decimal decimal, int power) {
    if (decimal.n == 0) return "0";
    return plain_label({decimal.n, decimal.exponent - power}) + "\u00B7" + power_label(power);
}

double total_width(const std::vector<std::string>& labels) {
    double width = 0.0;
    for (const std::string& label : labels) width += text_width(label, 1.0);
    return width;
}

// Labels of the marks of one axis, all in one form: plain, or with a common power of ten where that is shorter.
std::vector<std::string> labels_of(const std::vector<Decimal>& decimals) {
    int power = -400;  // below every double
    for (const Decimal& d : decimals) {
        if (d.n != 0) power = std::max(power, n_digits(d.n) - 1 + d.exponent);
    }
    std::vector<std::string> plain;
    for (const Decimal& d : decimals) plain.push_back(plain_label(d));
    if (power == -400 || (power >= -3 && power < 6)) return plain;
    std::vector<std::string> scientific;
    for (const Decimal& d : decimals) scientific.push_back(with_power(d, power));
    return total_width(scientific) < total_width(plain) ? scientific : plain;
}

constexpr int max_intervals = 8;
constexpr std::size_t max_fine_lines = 56;  // denser, the fine grid is a grey field

// Multiples of a step of 1, 2 or 5 times a power of ten, at most n_intervals + 1 of them, within the extent.
std::vector<Decimal> round_numbers(Extent extent, int n_intervals) {
    const double raw_step = (extent.hi - extent.lo) / n_intervals;
    int exponent = static_cast<int>(std::floor(std::log10(raw_step)));
    const double lead = raw_step / std::pow(10.0, exponent);
    long long factor = lead <= 1.0 ? 1 : lead <= 2.0 ? 2 : lead <= 5.0 ? 5 : 10;
    if (factor == 10) {
        factor = 1;
        ++exponent;
    }
    const double step = value_of({factor, exponent});
    std::vector<Decimal> out;
    const auto last = static_cast<long long>(std::floor(extent.hi / step));
    for (auto k = static_cast<long long>(std::ceil(extent.lo / step)); k <= last; ++k) {
        out.push_back({k * factor, exponent});
    }
    return out;
}

// All of one form; a power of ten alone is written without its factor 1 where the others need powers.
std::vector<std::string> log_labels(const std::vector<Decimal>& numbers) {
    const bool plain =
        std::all_of(numbers.begin(), numbers.end(), [](Decimal d) { return d.exponent >= -3 && d.exponent <= 4; });
    std::vector<std::string> out;
    for (const Decimal& d : numbers) {
        const std::string factor = d.n == 1 ? "" : std::to_string(d.n) + "\u00B7";
        out.push_back(plain ? plain_label(d) : factor + power_label(d.exponent));
    }
    return out;
}

std::vector<Tick> placed(const std::vector<Decimal>& numbers, const std::vector<std::string>& labels,
                         const std::vector<double>& axis_values, const Scale& scale) {
    std::vector<Tick> out;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (!(axis_values[i] >= scale.limits.lo && axis_values[i] <= scale.limits.hi)) continue;
        out.push_back({scale.at_axis(axis_values[i]), labels[i]});
    }
    return out;
}

bool fits(const std::vector<Tick>& ticks, Side side) {
    for (std::size_t i = 1; i < ticks.size(); ++i) {
        const double widths =
            text_width(ticks[i - 1].label, tick_font_size) + text_width(ticks[i].label, tick_font_size);
        const double needed = side == Side::left ? 1.5 * tick_font_size : 0.5 * widths + tick_font_size;
        if (std::fabs(ticks[i].at - ticks[i - 1].at) < needed) return false;
    }
    return true;
}

Ticks linear_ticks(const Scale& scale, int n_intervals) {
    const Extent values =
        scale.log ? Extent{std::pow(10.0, scale.limits.lo), std::pow(10.0, scale.limits.hi)} : scale.limits;
    std::vector<Decimal> numbers = round_numbers(values, n_intervals);
    std::vector<double> axis_values;
    for (const Decimal& d : numbers) axis_values.push_back(on_axis(value_of(d), scale.log));
    Ticks out;
    out.major = placed(numbers, labels_of(numbers), axis_values, scale);
    return out;
}

Ticks fitting_linear_ticks(const Scale& scale, Side side) {
    for (int n = max_intervals; n > 2; --n) {
        Ticks ticks = linear_ticks(scale, n);
        if (fits(ticks.major, side)) return ticks;
    }
    return linear_ticks(scale, 2);
}

// Labels at every `stride`-th decade, at `factors` times it.
std::vector<Tick> decade_ticks(const Scale& scale, int stride, const std::vector<int>& factors) {
    std::vector<Decimal> numbers;
    std::vector<double> axis_values;
    for (int decade = static_cast<int>(std::floor(scale.limits.lo)); decade <= scale.limits.hi; ++decade) {
        if (decade % stride != 0) continue;
        for (const int factor : factors) {
            const double axis_value = decade + std::log10(factor);
            if (!(axis_value >= scale.limits.lo && axis_value <= scale.limits.hi)) continue;
            numbers.push_back({factor, decade});
            axis_values.push_back(axis_value);
        }
    }
    return placed(numbers, log_labels(numbers), axis_values, scale);
}

std::vector<double> fine_grid(const Scale& scale, int stride) {
    const std::vector<int> factors = stride == 1 ? std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8, 9} : std::vector<int>{1};
    std::vector<double> out;
    for (const Tick& tick : decade_ticks(scale, 1, factors)) out.push_back(tick.at);
    if (out.size() > max_fine_lines) out.clear();
    return out;
}

Ticks log_ticks(const Scale& scale, Side side) {
    const double n_decades = scale.limits.hi - scale.limits.lo;
    if (n_decades < 0.7) return fitting_linear_ticks(scale, side);
    if (n_decades < 2.2) {
        std::vector<Tick> ticks = decade_ticks(scale, 1, {1, 2, 5});
        if (fits(ticks, side)) return {std::move(ticks), fine_grid(scale, 1)};
    }
    for (const int stride : {1, 2, 3, 5, 10, 20, 50}) {
        std::vector<Tick> ticks = decade_ticks(scale, stride, {1});
        if (fits(ticks, side)) return {std::move(ticks), fine_grid(scale, stride)};
    }
    return {decade_ticks(scale, 100, {1}), {}};
}

}  // namespace

Ticks ticks_of(const Scale& scale, Side side) {
    return scale.log ? log_ticks(scale, side) : fitting_linear_ticks(scale, side);
}

}  // namespace zlg::report
