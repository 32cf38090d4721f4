#include "decimal.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include <fmt/format.h>

#include "text.hpp"

namespace zlg::report {
namespace {

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

std::string with_power(Decimal decimal, int power) {
    if (decimal.n == 0) return "0";
    return plain_label({decimal.n, decimal.exponent - power}) + "\u00B7" + power_label(power);
}

double total_width(const std::vector<std::string>& labels) {
    double width = 0.0;
    for (const std::string& label : labels) width += text_width(label, 1.0);
    return width;
}

}  // namespace

double value_of(Decimal decimal) {
    const double n = static_cast<double>(decimal.n);
    const double power = std::pow(10.0, std::abs(decimal.exponent));
    return decimal.exponent < 0 ? n / power : n * power;
}

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

std::string power_label(int exponent) {
    static constexpr const char* digits[] = {"\u2070", "\u00B9", "\u00B2", "\u00B3", "\u2074",
                                             "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    std::string out = exponent < 0 ? "10\u207B" : "10";
    for (const char digit : std::to_string(std::abs(exponent))) out += digits[digit - '0'];
    return out;
}

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

}  // namespace zlg::report
