#pragma once
// The words of the recomputed paper: they stand in claims.md and figures.md, and the code fills their places {}.

#include <algorithm>
#include <concepts>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include <zlg/paper/paper_item.hpp>

namespace zlg::paper {

// A number as the page shows it: "{:.2f}" as report::fixed_number, "{}" as report::short_number, and as the report
// names it where there is none.
struct Shown {
    template <class T>
    requires std::integral<T> || std::floating_point<T> Shown(T x) : value{static_cast<double>(x)} {}

    double value;
};

using Value = std::variant<Shown, std::string>;
using Values = std::vector<Value>;

// errors  std::logic_error where there are more or fewer values than places.
[[nodiscard]] std::string filled(const std::string& text, const Values& values);

// The lines under a name of figures.md.
//
// errors  as filled; std::logic_error for an unknown name.
[[nodiscard]] std::vector<std::string> words(std::string_view name, const Values& values = {});

// What the code knows of a figure with the words of that name, or of its own.
[[nodiscard]] report::Figure worded(report::Figure figure, const Values& values = {}, std::string_view name = "");

// Rows under the caption and the header of that name, below those that stand there.
[[nodiscard]] report::Table table_of(std::string_view name, std::vector<std::vector<std::string>> rows,
                                     const Values& values = {});

// A figure or table of the paper: heading and paragraphs of its number, or of another name.
[[nodiscard]] PaperItem item_of(std::string number, const Values& values, std::vector<report::Table> tables,
                                std::vector<report::Figure> figures, std::string_view name = "");

// A claim's place in the paper and the numbers of its entry in claims.md.
struct Finding {
    std::string where;
    Values values;
};

// errors  std::logic_error unless they are all that are in claims.md, in its order.
[[nodiscard]] std::vector<Claim> claims_of(const std::vector<Finding>& findings);

}  // namespace zlg::paper

template <> struct fmt::formatter<zlg::paper::Shown> {
    std::string_view as;

    constexpr auto parse(fmt::format_parse_context& context) {
        const auto* const end = std::find(context.begin(), context.end(), '}');
        as = {context.begin(), end};
        return end;
    }

    auto format(zlg::paper::Shown shown, fmt::format_context& context) const -> fmt::format_context::iterator;
};
