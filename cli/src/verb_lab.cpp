#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "as_json.hpp"
#include "failure.hpp"
#include "lab_page.hpp"
#include "options.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace zlg::cli {
namespace {

void lab(const Options& options) {
    if (options.out.empty()) throw UsageError{"--out: name the file of the page, for example --out lab.html"};
    require_suffix(options.out, ".html");
    write_file(options.out, lab_page(), options.force);
    if (options.json)
        print(pretty(nlohmann::json{{"page", options.out}}));
    else
        print(fmt::format("open {} in a browser\n", printable(options.out)));
}

}  // namespace

void add_lab(CLI::App& program) {
    const auto options = std::make_shared<Options>();
    CLI::App* verb =
        program.add_subcommand("lab", "the gyro in one page, which runs in a browser without network or server");
    add_output_options(*verb, *options);
    verb->callback([options] { lab(*options); });
}

}  // namespace zlg::cli
