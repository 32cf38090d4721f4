#pragma once
// The command line of a campaign, and one way to end it.

#include <exception>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

namespace zlg::trials {

// Reads the command line and does the work.
//
// return  what `work` returns, 0 or 1 where a bound is missed; 2 for a wrong command line; 3 for an exception of
// `work`.
template <class Work>
int run_command(CLI::App& app, int argc, char** argv, const Work& work) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    try {
        return work();
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}: {}\n", app.get_name(), error.what());
        return 3;
    }
}

}  // namespace zlg::trials
