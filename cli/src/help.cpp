#include "help.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <zlg/text/spelling.hpp>

#include "failure.hpp"
#include "output.hpp"

namespace zlg::cli {
namespace {

struct VerbHelp {
    std::string_view verb;
    const char* group;
    const char* examples;
};

constexpr const char* simulating = "Simulate a gyro";
constexpr const char* processing = "Process records";
constexpr const char* analysing = "Analyse";
constexpr const char* designing = "Design";

constexpr std::array verb_table{
    VerbHelp{"run", simulating,
             "  zlg run                                       an hour of the paper's gyro\n"
             "  zlg run --duration 600 --set motion.kind=rest --logs none --out demo\n"
             "  zlg run my_gyro.toml --seed 7 --format csv"},
    VerbHelp{"simulate", simulating, "  zlg simulate --duration 600 --set switching.interval_s=60 --out raw.h5"},
    VerbHelp{"lab", simulating,
             "  zlg lab --out lab.html                        then open it in a browser\n"
             "  zlg lab --follow /dev/ttyUSB0 --out angles.h5"},
    VerbHelp{"paper", simulating, "  zlg paper --out paper                         some half a minute"},
    VerbHelp{"sweep", simulating,
             "  zlg sweep tolerances.toml --out results.h5    go on with it by the same line\n"
             "  zlg sweep tolerances.toml --part 1/4 --out part_1.h5\n"
             "  zlg sweep --merge part_1.h5 part_2.h5 part_3.h5 part_4.h5 --out results.h5"},
    VerbHelp{"import", processing,
             "  zlg import logger.csv                         says what it understood and what is missing\n"
             "  zlg import logger.csv --map axis=gyro_z --map holds=rate --map unit=deg/s --out angles.h5"},
    VerbHelp{"process", processing,
             "  zlg process raw.h5 --out angles.h5\n"
             "  zlg process raw.csv --set compensation.relock=none --switches switches.csv --out angles.csv"},
    VerbHelp{"calibrate", processing,
             "  zlg calibrate rest.h5 --out constants.toml\n"
             "  zlg calibrate --from-laser --set laser.perimeter_m=0.2 --out constants.toml"},
    VerbHelp{"follow", processing,
             "  zlg follow /dev/ttyUSB0 --baud 921600 --out angles.h5\n"
             "  zlg follow tcp:192.168.0.7:5000 --duration 3600 --out angles.csv"},
    VerbHelp{"settings", processing,
             "  zlg settings gyro.toml --out settings.bin\n"
             "  zlg settings settings.bin --to /dev/ttyUSB0"},
    VerbHelp{"convert", processing,
             "  zlg convert raw.h5 --out raw.csv\n"
             "  zlg convert angles.h5 --out angles.mat"},
    VerbHelp{"inspect", processing,
             "  zlg inspect raw.h5\n"
             "  zlg inspect raw.h5.part --repair --out raw.h5"},
    VerbHelp{"analyze", analysing,
             "  zlg analyze angles.h5 --out analysis.html\n"
             "  zlg analyze rates.csv --map axis=gyro_z --map unit=deg/s --map holds=rate --map rate_hz=100"},
    VerbHelp{"accept", analysing,
             "  zlg accept --plan static.csv table.csv --out plan.toml\n"
             "  zlg accept plan.toml --out report.html        exit status 1 where a limit is not met\n"
             "  zlg accept --verify report.html static.csv table.csv"},
    VerbHelp{"design", designing,
             "  zlg design --out design.html\n"
             "  zlg design --set drift.magnetic_arcsec_s=2 --set design.run_lengths_s=3600\n"
             "  zlg design --require require.toml --out chosen.toml"},
};

// What kind of value the options of these names take in every verb.
const std::pair<const char*, std::vector<const char*>> kinds[]{
    {"FILE.toml", {"CONFIG", "--config", "SWEEP", "--require", "--mapping", "--write-mapping"}},
    {"FILE", {"RAW", "--wire"}},
    {"FILE.csv", {"--switches"}},
    {"FILE.h5", {"--merge"}},
    {"FILE.html", {"--page"}},
    {"FILE.yaml", {"--imu-yaml"}},
    {"FILE|DEVICE|ADDRESS", {"SOURCE"}},
    {"DEVICE|ADDRESS", {"--to"}},
    {"PATH", {"--out"}},
    {"", {"FILE"}},
    {"KEY=VALUE", {"--set", "--map"}},
    {"NUMBER", {"--seed", "--threads", "--baud", "--port", "--rate-arcsec-s"}},
    {"SECONDS", {"--duration"}},
    {"K/N", {"--part"}},
    {"h5|csv", {"--format"}},
    {"none|angles|all", {"--logs"}},
    {"paper", {"--rules"}},
};

void name_kinds(CLI::App& verb) {
    for (const auto& [value, options] : kinds)
        for (const char* name : options)
            if (CLI::Option* option = verb.get_option_no_throw(name)) option->type_name(value);
}

void complete(CLI::App& verb) {
    const auto* row = std::ranges::find(verb_table, verb.get_name(), &VerbHelp::verb);
    if (row == verb_table.end()) throw std::logic_error{verb.get_name() + ": has no row in the table of the help"};
    verb.group(row->group);
    name_kinds(verb);
    verb.add_flag_callback("--quiet", be_quiet, "no notes, no bar of progress; warnings and errors stay")
        ->trigger_on_parse();
    verb.footer(fmt::format("Examples:\n{}", row->examples));
}

std::vector<const CLI::App*> all_verbs(const CLI::App& program) {
    return program.get_subcommands([](const CLI::App*) { return true; });
}

std::string help_text(const CLI::App& program, const CLI::App& app) {
    // Not App::help, which for the program shows the verb that was parsed.
    const std::string call = &app == &program ? "zlg" : "zlg " + app.get_name();
    return program.get_formatter()->make_help(&app, call, CLI::AppFormatMode::Normal);
}

void add_help(CLI::App& program) {
    const auto name = std::make_shared<std::string>();
    CLI::App* help = program.add_subcommand("help", "the options of a verb, with examples");
    help->group("Help");
    help->add_option("VERB", *name, "which; without it all verbs are listed")->type_name("");
    help->callback([name, &program] {
        const CLI::App* verb = name->empty() ? &program : find_verb(program, *name);
        if (verb == nullptr) throw UsageError{unknown_verb(program, *name)};
        print(help_text(program, *verb));
    });
}

}  // namespace

const CLI::App* find_verb(const CLI::App& program, const std::string& name) {
    const std::vector<const CLI::App*> all = all_verbs(program);
    const auto found = std::ranges::find(all, name, &CLI::App::get_name);
    return found == all.end() ? nullptr : *found;
}

void complete_help(CLI::App& program) {
    for (CLI::App* verb : program.get_subcommands([](CLI::App*) { return true; })) complete(*verb);
    add_help(program);
    program.get_formatter()->label("SUBCOMMAND", "VERB");
    program.footer("zlg help VERB lists the options of a verb, with examples.");
}

std::string unknown_verb(const CLI::App& program, const std::string& name) {
    const std::vector<const CLI::App*> verbs = all_verbs(program);
    const auto apart = [&](const CLI::App* verb) { return text::letters_apart(name, verb->get_name()); };
    return fmt::format("unknown verb '{}'; did you mean '{}'? (zlg --help lists all)", name,
                       (*std::ranges::min_element(verbs, {}, apart))->get_name());
}

}  // namespace zlg::cli
