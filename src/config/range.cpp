#include "range.hpp"

#include <fmt/format.h>

#include <cmath>

namespace zlg::config {

namespace {

// 1e-6 and 1e12, as one writes them, where the library says 1e-06 and 1e+12.
std::string short_number(double value) {
    std::string text = fmt::format("{:g}", value);
    const auto exponent = text.find('e');
    if (exponent == std::string::npos) return text;
    const int power = std::stoi(text.substr(exponent + 1));
    return fmt::format("{}e{}", text.substr(0, exponent), power);
}

}  // namespace

bool contains(const Range& range, double value) {
    if (!std::isfinite(value)) return false;
    if (range.or_zero && value == 0.0) return true;
    if (!(std::abs(value) >= range.min_size)) return false;
    const bool above = range.without_min ? value > range.min : value >= range.min;
    const bool below = range.without_max ? value < range.max : value <= range.max;
    return above && below && !(range.without_zero && value == 0.0);
}

std::string in_words(const Range& range) {
    const bool has_min = std::isfinite(range.min);
    const bool has_max = std::isfinite(range.max);
    if (!has_min && !has_max) return range.without_zero ? "any finite number but 0" : "any finite number";
    if (range.min_size > 0.0)
        return fmt::format("{0}..{1} or -{1}..-{0}", short_number(range.min_size), short_number(range.max));
    if (has_min && has_max && !range.without_min && !range.without_max && range.or_zero)
        return fmt::format("0 or {}..{}", short_number(range.min), short_number(range.max));
    if (has_min && has_max && !range.without_min && !range.without_max) {
        return fmt::format("{}..{}", short_number(range.min), short_number(range.max));
    }
    std::string text;
    if (has_min) text += fmt::format("{} {}", range.without_min ? "above" : "from", short_number(range.min));
    if (has_max) {
        text += fmt::format("{}{} {}", has_min ? " " : "", range.without_max ? "to below" : "up to",
                            short_number(range.max));
    }
    return text;
}

}  // namespace zlg::config
