#include "switch_csv.hpp"

#include <cmath>
#include <concepts>
#include <string_view>

#include <fmt/format.h>

#include <zlg/study/fields.hpp>

namespace zlg::cli {
namespace {

std::string cell(double value) { return std::isnan(value) ? std::string{} : fmt::format("{}", value); }
std::string cell(std::integral auto value) { return fmt::format("{}", value); }

}  // namespace

std::string switch_csv(const std::vector<study::SwitchLine>& switches, bool has_truth) {
    const auto for_each_shown = [has_truth](auto use) {
        study::for_each_field<study::SwitchLine>([&](std::string_view name, auto get) {
            if (has_truth || name != "true_error_arcsec") use(name, get);
        });
    };
    std::vector<std::string> names;
    for_each_shown([&](std::string_view name, auto) { names.emplace_back(name); });
    std::string text = fmt::format("{}\n", fmt::join(names, ","));
    for (const study::SwitchLine& line : switches) {
        std::vector<std::string> cells;
        for_each_shown([&](std::string_view, auto get) { cells.push_back(cell(get(line))); });
        text += fmt::format("{}\n", fmt::join(cells, ","));
    }
    return text;
}

}  // namespace zlg::cli
