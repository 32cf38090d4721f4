#include "program.hpp"

#include <algorithm>
#include <csignal>
#include <exception>
#include <filesystem>
#include <new>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/design/error.hpp>
#include <zlg/logs/byte_source.hpp>
#include <zlg/logs/mapping.hpp>
#include <zlg/text/inputs.hpp>

#include "failure.hpp"
#include "help.hpp"
#include "output.hpp"

namespace zlg::cli {
namespace {

// What was wrong with a command line, in one line: where its verb is unknown, with the nearest one that exists.
std::string explain(const CLI::App& program, const CLI::ParseError& error, int argc, char** argv) {
    if (argc == 1) return "no verb is given";
    const std::string first = argv[1];
    const bool known = find_verb(program, first) != nullptr;
    if (!known && !first.empty() && first[0] != '-') return unknown_verb(program, first);
    std::string reason = error.what();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    return fmt::format("{} ({} {}--help lists what is allowed)", reason, program.get_name(), known ? first + " " : "");
}

int parsed(CLI::App& program, int argc, char** argv) {
    try {
        if (argc == 1) print(program.help());
        program.parse(argc, argv);
        return good;
    } catch (const CLI::CallForHelp&) {
        print(program.help());
        return good;
    } catch (const CLI::CallForVersion& version) {
        print(fmt::format("{}\n", version.what()));
        return good;
    } catch (const CLI::Success&) {
        return good;
    } catch (const CLI::RuntimeError& error) {
        return error.get_exit_code();
    } catch (const CLI::ParseError& error) {
        report_error(explain(program, error, argc, argv));
        return wrong_usage;
    }
}

// What was asked for is not allowed, by the command line or by the configuration.
bool is_wrong_usage(const std::exception& error) {
    return dynamic_cast<const UsageError*>(&error) || dynamic_cast<const design::DesignError*>(&error) ||
           dynamic_cast<const config::ConfigError*>(&error) || dynamic_cast<const text::OutputIsInput*>(&error) ||
           dynamic_cast<const logs::MappingError*>(&error) || dynamic_cast<const logs::SourceError*>(&error);
}

int guarded(CLI::App& program, int argc, char** argv) {
    try {
        return parsed(program, argc, argv);
    } catch (const std::bad_alloc&) {
        report_error("out of memory" + after_error);
        return bad_input_or_output;
    } catch (const std::filesystem::filesystem_error& error) {
        report_error(fmt::format("cannot look up {}: {}", error.path1().string(), error.code().message()) +
                     after_error);
        return bad_input_or_output;
    } catch (const std::exception& error) {
        report_error(error.what() + after_error);
        return is_wrong_usage(error) ? wrong_usage : bad_input_or_output;
    }
}

}  // namespace

void begin_program() {
    // A full disk or a closed pipe is a failed write, not the end of the program.
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
    text::watch_inputs();
}

int run_program(CLI::App& program, int argc, char** argv) {
    const int exit_code = guarded(program, argc, argv);
    print_notes();
    return exit_code;
}

}  // namespace zlg::cli
