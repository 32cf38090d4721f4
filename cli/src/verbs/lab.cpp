#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <zlg/logs/follower.hpp>

#include "lab_follow.hpp"
#include "lab_page.hpp"
#include "src/as_json.hpp"
#include "src/failure.hpp"
#include "src/options.hpp"
#include "src/output.hpp"
#include "src/verbs.hpp"

namespace zlg::cli {
namespace {

constexpr std::uint16_t default_port = 8137;

void write_page(const Options& options) {
    if (options.out.empty()) throw UsageError{"--out: name the file of the page, for example --out lab.html"};
    require_suffix(options.out, ".html");
    write_file(options.out, lab_page(), options.force);
    if (options.json)
        print(pretty(nlohmann::json{{"page", options.out}}));
    else
        print(fmt::format("open {} in a browser\n", printable(options.out)));
}

void lab(const LabFollowOptions& options) {
    if (options.source.empty()) return write_page(options);
    if (options.json) throw UsageError{"--json: --follow has no result; leave one of them out"};
    follow_in_page(options);
}

}  // namespace

void add_lab(CLI::App& program) {
    const auto options = std::make_shared<LabFollowOptions>();
    options->baud = logs::default_baud;
    options->port = default_port;
    CLI::App* verb =
        program.add_subcommand("lab", "the gyro in one page, which runs in a browser without network or server");
    CLI::Option* follow =
        verb->add_option("--follow", options->source,
                         "show what a gyro gives now: SOURCE of `zlg follow`, or an HDF5 log that is being written; "
                         "the page is then served to this machine alone, and --out names an angle log to record")
            ->type_name("FILE|DEVICE|ADDRESS")
            ->check(is_a_name());
    verb->add_option("--port", options->port, fmt::format("of 127.0.0.1, 0: any that is free ({})", default_port))
        ->needs(follow)
        ->check(CLI::Range(0, 65535).description(""));
    verb->add_option("--baud", options->baud, "speed of a serial device (921600)")->needs(follow);
    add_config_options(*verb, *options);
    for (const char* option : {"--config", "--set"}) verb->get_option(option)->needs(follow);
    add_output_options(*verb, *options);
    verb->callback([options] { lab(*options); });
}

}  // namespace zlg::cli
