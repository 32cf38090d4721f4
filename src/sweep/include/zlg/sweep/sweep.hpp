#pragma once
// A sweep: the gyros that a result file lacks are run, and the file is completed.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <zlg/sweep/results.hpp>

namespace zlg::sweep {

// Part k of n, from 1: the gyros whose number is k - 1 modulo n. Any partition gives the same rows.
struct Part {
    std::int64_t k = 1;
    std::int64_t n = 1;
};

// Who runs the gyros `asked`: each once, in any order and anywhere, its row to `take`, from one thread or many. Returns
// false where it was stopped before the end.
using Crew = std::function<bool(const Gyros& gyros, const std::vector<std::int64_t>& asked,
                                const std::function<void(Row)>& take)>;

struct Task {
    Description description;
    std::string out;  // RESULTS; RESULTS.part is the checkpoint
    Part part;
    int threads = 1;                   // of this process
    Crew crew;                         // others than these threads
    bool force = false;                // what stands under either name goes, and all gyros are run anew
    std::function<bool()> is_stopped;  // asked from all threads
    std::function<void(std::int64_t done, std::int64_t asked)> on_progress;  // of this call; one thread at a time
};

struct Outcome {
    Rows rows;                // all that the file holds
    std::int64_t n_run = 0;   // of them, in this call
    bool is_stopped = false;  // before the end: the checkpoint holds the rows until then
    std::string checkpoint;   // its path: RESULTS.part, beside what RESULTS names where it is a link
};

// Interrupted or killed at any time, the same call goes on, and repeats at most the gyros that were in flight. The
// bytes of RESULTS depend neither on threads nor on how often that happened. A gyro that fails is a row; see gyros.hpp.
//
// errors  config::ConfigError: the file has more gyros than the description; logs::IoError: of another sweep, the disk
// is
//         full, and so on; logs::FormatError: damaged; those of a motion file, which must not change between calls.
[[nodiscard]] Outcome run(const Task& task);

// Results and checkpoints of one sweep in any order, with gyros in common or not, as one file.
//
// errors  logs::IoError: they are of different sweeps, `out` exists and not `force`; logs::FormatError: damaged, or
// they
//         contradict each other.
struct Merged {
    Description description;
    Rows rows;
};
[[nodiscard]] Merged merge(const std::vector<std::string>& paths, const std::string& out, bool force);

}  // namespace zlg::sweep
