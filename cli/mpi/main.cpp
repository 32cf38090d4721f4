// zlg-mpi: `sweep` of zlg on all the processes that mpirun or srun has started.

#include <cstdint>
#include <deque>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <zlg/sweep/gyros.hpp>
#include <zlg/sweep/motion_files.hpp>
#include <zlg/sweep/row_text.hpp>

#include "distributor.hpp"
#include "messages.hpp"
#include "src/failure.hpp"
#include "src/help.hpp"
#include "src/interrupt.hpp"
#include "src/program.hpp"
#include "src/verbs.hpp"

namespace {

using namespace zlg;
using mpi::Tag;

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

// Its first line names the version of the program, as that of a checkpoint does: another one could give other rows.
sweep::Description same_program(const std::string& text) {
    sweep::Description description = sweep::parse(text, "rank 0");
    const std::string here = first_line(to_toml(description));
    if (here != first_line(text))
        throw std::runtime_error(
            fmt::format("rank 0 is `{}`, this machine has `{}`; allowed is one version", first_line(text), here));
    return description;
}

// A rank above 0: it runs the gyros that rank 0 sends, until rank 0 sends the end.
class Worker {
public:
    void work() {
        interruptible_.will_finish();
        for (;;) {
            read_messages();
            if (is_ended_) return;
            if (interruptible_.is_noted()) stop(Tag::stopped);
            if (waiting_.empty())
                mpi::sleep_a_moment();
            else
                run_next();
        }
    }

private:
    void read_messages() {
        while (const auto message = mpi::received()) obey(*message);
    }

    void obey(const mpi::Message& message) {
        switch (message.tag) {
            case Tag::description:
                try {
                    gyros_.emplace(sweep::with_motion_checksums(same_program(message.text)));
                } catch (const std::exception& error) {
                    stop(Tag::failed, error.what());
                }
                break;
            case Tag::gyro:
                if (!is_stopped_) waiting_.push_back(std::stoll(message.text));
                break;
            case Tag::stop:
                stop(Tag::stopped);
                break;
            case Tag::end:
                is_ended_ = true;
                break;
            default:
                break;
        }
    }

    // Messages are read meanwhile, so that a run ends soon that rank 0 stops.
    bool is_stopped() {
        read_messages();
        return is_stopped_ || is_ended_ || interruptible_.is_noted();
    }

    void run_next() {
        const std::int64_t gyro = waiting_.front();
        waiting_.pop_front();
        try {
            mpi::send(0, Tag::row, sweep::text_of(gyros_->run(gyro, [this] { return is_stopped(); })));
        } catch (const sweep::Stopped&) {
            // Said by `stop`, or after it was noted.
        } catch (const std::exception& error) {
            stop(Tag::failed, error.what());
        }
    }

    // Rank 0 counts on one such message of each rank.
    void stop(Tag why, const std::string& text = {}) {
        waiting_.clear();
        if (!is_stopped_) mpi::send(0, why, text);
        is_stopped_ = true;
    }

    cli::Interruptible interruptible_;
    std::optional<sweep::Gyros> gyros_;
    std::deque<std::int64_t> waiting_;
    bool is_stopped_ = false;
    bool is_ended_ = false;
};

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
    Worker{}.work();
    return cli::good;
}

}  // namespace

int main(int argc, char** argv) {
    cli::begin_program();
    const mpi::Session session{argc, argv};
    const cli::InterruptGuard guard;
    return mpi::rank() == 0 ? lead(argc, argv) : follow();
}
