// The table of errors of the core's elementary functions, for docs/decisions.md.

#include <map>
#include <string_view>

#include "command.hpp"
#include "mathematics/errors.hpp"

namespace {

using namespace zlg::trials;

int print_errors(int n_points) {
    std::map<std::string_view, double> worst;
    fmt::print("| function | points | largest error, ulp | at |\n|---|---|---|---|\n");
    for (const Region& region : regions()) {
        const WorstError error = worst_error(region, n_points);
        fmt::print("| {} | {} | {:.3f} | {:a}, {:a} |\n", region.function.name, region.points, error.ulps, error.at.x,
                   error.at.y);
        double& of_function = worst[region.function.name];
        of_function = error.ulps > of_function ? error.ulps : of_function;
    }
    fmt::print("\n| function | largest error, ulp |\n|---|---|\n");
    bool is_good = true;
    for (const auto& [name, ulps] : worst) {
        fmt::print("| {} | {:.3f} |\n", name, ulps);
        is_good = is_good && ulps < 1.0;
    }
    return is_good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"errors of the elementary functions against MPFR; exit 1 where one reaches a unit in the last place",
                 "zlg_maths_errors"};
    int n_points = 1'000'000;
    app.add_option("--points", n_points, "points in each region");
    return run_command(app, argc, argv, [&] { return print_errors(n_points); });
}
