// zlg-mpi: `sweep` of zlg on all the processes that mpirun or srun has started.

#include <CLI/CLI.hpp>

#include "distributor.hpp"
#include "messages.hpp"
#include "src/failure.hpp"
#include "src/help.hpp"
#include "src/interrupt.hpp"
#include "src/program.hpp"
#include "src/verbs.hpp"
#include "worker.hpp"

namespace {

using namespace zlg;

// The one process that reads the command line, writes and speaks.
int lead(int argc, char** argv) {
    CLI::App program{"Many gyros of a Zeeman laser gyro on many processes: mpirun -np N zlg-mpi sweep ...", "zlg-mpi"};
    program.require_subcommand(1);
    program.set_version_flag("--version", "zlg-mpi " ZLG_VERSION);
    cli::add_sweep(program, mpi::run_on_all_ranks);
    cli::complete_help(program);
    program.get_subcommand("sweep")->footer(
        "Examples:\n"
        "  mpirun -np 4 zlg-mpi sweep tolerances.toml --out results.h5   go on with it by the same line, or by zlg "
        "sweep");
    const int exit_code = cli::run_program(program, argc, argv);
    for (int rank = 1; rank < mpi::n_ranks(); ++rank) mpi::send(rank, mpi::Tag::end);
    return exit_code;
}

int follow() {
    cli::leave_errors_to_another();
    mpi::Worker{}.work();
    return cli::good;
}

}  // namespace

int main(int argc, char** argv) {
    cli::begin_program();
    const cli::InterruptGuard guard;
    const mpi::Session session{argc, argv};
    return mpi::rank() == 0 ? lead(argc, argv) : follow();
}
