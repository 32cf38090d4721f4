#include <algorithm>
#include <csignal>
#include <exception>
#include <new>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <zlg/config/schema.hpp>
#include <zlg/design/error.hpp>
#include <zlg/logs/byte_source.hpp>
#include <zlg/logs/mapping.hpp>
#include <zlg/text/inputs.hpp>

#include "failure.hpp"
#include "help.hpp"
#include "interrupt.hpp"
#include "manual.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace {

using namespace zlg;

void print_keys() {
    cli::print(config::reference_markdown());
    throw CLI::Success{};
}

// What was wrong with a command line, in one line: where its verb is unknown, with the nearest one that exists.
std::string explain(const CLI::App& program, const CLI::ParseError& error, int argc, char** argv) {
    if (argc == 1) return "no verb is given";
    const std::string first = argv[1];
    const bool known = cli::find_verb(program, first) != nullptr;
    if (!known && !first.empty() && first[0] != '-') return cli::unknown_verb(program, first);
    std::string reason = error.what();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    return fmt::format("{} (zlg {}--help lists what is allowed)", reason, known ? first + " " : "");
}

int parse_and_run(CLI::App& program, int argc, char** argv) {
    try {
        if (argc == 1) cli::print(program.help());
        program.parse(argc, argv);
        return cli::good;
    } catch (const CLI::CallForHelp&) {
        cli::print(program.help());
        return cli::good;
    } catch (const CLI::CallForVersion&) {
        cli::print("zlg " ZLG_VERSION "\n");
        return cli::good;
    } catch (const CLI::Success&) {
        return cli::good;
    } catch (const CLI::RuntimeError& error) {
        return error.get_exit_code();
    } catch (const CLI::ParseError& error) {
        cli::report_error(explain(program, error, argc, argv));
        return cli::wrong_usage;
    }
}

// What was asked for is not allowed, by the command line or by the configuration.
bool is_wrong_usage(const std::exception& error) {
    return dynamic_cast<const cli::UsageError*>(&error) || dynamic_cast<const design::DesignError*>(&error) ||
           dynamic_cast<const config::ConfigError*>(&error) || dynamic_cast<const text::OutputIsInput*>(&error) ||
           dynamic_cast<const logs::MappingError*>(&error) || dynamic_cast<const logs::SourceError*>(&error);
}

int guarded(CLI::App& program, int argc, char** argv) {
    try {
        return parse_and_run(program, argc, argv);
    } catch (const std::bad_alloc&) {
        cli::report_error("out of memory");
        return cli::bad_input_or_output;
    } catch (const std::exception& error) {
        cli::report_error(error.what());
        return is_wrong_usage(error) ? cli::wrong_usage : cli::bad_input_or_output;
    }
}

}  // namespace

int main(int argc, char** argv) {
    // A full disk or a closed pipe is a failed write, not the end of the program.
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
    text::watch_inputs();
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
    cli::add_analyze(program);
    cli::complete_help(program);
    cli::add_manual(program);
    const cli::InterruptGuard guard;
    const int exit_code = guarded(program, argc, argv);
    cli::print_notes();
    return exit_code;
}
