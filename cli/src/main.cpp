#include <CLI/CLI.hpp>

#include <zlg/config/schema.hpp>

#include "help.hpp"
#include "interrupt.hpp"
#include "output.hpp"
#include "program.hpp"
#include "verbs.hpp"

namespace {

using namespace zlg;

void print_keys() {
    cli::print(config::reference_markdown());
    throw CLI::Success{};
}

}  // namespace

int main(int argc, char** argv) {
    cli::begin_program();
    CLI::App program{"Software of a Zeeman laser gyro in the quasi-four-frequency regime", "zlg"};
    program.require_subcommand(1);
    program.set_version_flag("--version", "zlg " ZLG_VERSION);
    program.add_flag_callback("--keys", print_keys, "every key of the configuration, as Markdown")->trigger_on_parse();
    cli::add_run(program);
    cli::add_simulate(program);
    cli::add_process(program);
    cli::add_design(program);
    cli::add_paper(program);
    cli::add_sweep(program);
    cli::add_convert(program);
    cli::add_import(program);
    cli::add_calibrate(program);
    cli::add_follow(program);
    cli::add_inspect(program);
    cli::add_lab(program);
    cli::add_settings(program);
    cli::add_analyze(program);
    cli::add_accept(program);
    cli::complete_help(program);
    const cli::InterruptGuard guard;
    return cli::run_program(program, argc, argv);
}
