// Runs the closed loop of one configuration for run.duration_s and prints the fingerprint of the run, which is that of
// `zlg run`: so compilers and machines are held against each other.
//
// usage: zlg_loop_fingerprint [section.key=value...]

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include <zlg/rig/replay.hpp>

#include "loop_run.hpp"

namespace {

std::string run(const std::vector<std::string>& settings) {
    zlg::lab::LoopRun loop{zlg::lab::configured(settings)};
    while (loop.halves() < loop.run_halves()) loop.advance(zlg::rig::ignored);
    return loop.fingerprint() + "\n";
}

}  // namespace

int main(int argc, char** argv) {
    try {
        std::fputs(run({argv + 1, argv + argc}).c_str(), stdout);
        return EXIT_SUCCESS;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "zlg_loop_fingerprint: %s\n", error.what());
        return EXIT_FAILURE;
    }
}
