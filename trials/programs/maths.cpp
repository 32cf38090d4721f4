// The errors of the core's elementary functions; exit 1 where one reaches a unit in the last place.

#include <algorithm>
#include <map>
#include <memory>
#include <string_view>

#include <fmt/format.h>

#include "campaigns.hpp"
#include "mathematics/errors.hpp"

namespace zlg::trials {
namespace {

int print_errors(int n_points) {
    std::map<std::string_view, double> worst;
    fmt::print("| function | points | largest error, ulp | at |\n|---|---|---|---|\n");
    for (const Region& region : regions()) {
        const WorstError error = worst_error(region, n_points);
        fmt::print("| {} | {} | {:.3f} | {:a}, {:a} |\n", region.function.name, region.points, error.ulps, error.at.x,
                   error.at.y);
        double& of_function = worst[region.function.name];
        of_function = std::max(of_function, error.ulps);
    }
    fmt::print("\n| function | largest error, ulp |\n|---|---|\n");
    for (const auto& [name, ulps] : worst) fmt::print("| {} | {:.3f} |\n", name, ulps);
    return std::ranges::all_of(worst, [](const auto& each) { return each.second < 1.0; }) ? 0 : 1;
}

}  // namespace

Work maths(CLI::App& app) {
    const auto n_points = std::make_shared<int>(1'000'000);
    app.add_option("--points", *n_points, "in each region");
    return [n_points] { return print_errors(*n_points); };
}

}  // namespace zlg::trials
