#pragma once
// Numbers in the sentences and tables of the paper: "{:.2f}" is written as report::fixed_number does, "{}" as
// report::short_number, and what is no number as the report names it.

#include <string>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include <zlg/report/number_text.hpp>

namespace zlg::paper {

struct Shown {
    double value;
};

// Only numbers that may not exist are shown in this way; whole numbers and words are as everywhere.
[[nodiscard]] inline Shown shown(double x) { return {x}; }
template <class T>
requires(!std::is_same_v<T, double>) [[nodiscard]] const T& shown(const T& x) { return x; }
template <class T>
using ShownAs = decltype(shown(std::declval<const T&>()));

template <class... Args>
[[nodiscard]] std::string sentence(fmt::format_string<ShownAs<Args>...> text, const Args&... args) {
    return fmt::format(text, shown(args)...);
}

}  // namespace zlg::paper

template <>
struct fmt::formatter<zlg::paper::Shown> {
    int decimals = -1;  // as many as three significant digits need

    constexpr auto parse(fmt::format_parse_context& context) {
        const char* at = context.begin();
        if (at != context.end() && *at == '.') decimals = at[1] - '0', at += 3;
        return at;
    }

    template <class Context>
    auto format(const zlg::paper::Shown& shown, Context& context) const {
        return fmt::format_to(
            context.out(), "{}",
            decimals < 0 ? zlg::report::short_number(shown.value) : zlg::report::fixed_number(shown.value, decimals));
    }
};
