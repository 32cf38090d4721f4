#pragma once
// Rank 0: it gives the gyros of a sweep to the ranks, itself among them, and takes their rows.

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include <zlg/sweep/sweep.hpp>

#include "messages.hpp"

namespace zlg::mpi {

// A sweep::Crew of all ranks.
//
// A rank has one gyro to run and, while there are many left, one to go on with: so it need not wait for the answer of
// rank 0, and at the end nobody waits for the second gyro of another. Rank 0 runs gyros in a thread of its own, while
// this thread serves.
//
// errors  logs::IoError of another rank; those of sweep::Gyros::run and of `take` here. No rank runs a gyro then.
[[nodiscard]] bool run_on_all_ranks(const sweep::Gyros& gyros, const std::vector<std::int64_t>& asked,
                                    const std::function<void(sweep::Row)>& take);

class Distributor {
public:
    Distributor(const sweep::Gyros& gyros, const std::vector<std::int64_t>& asked,
                const std::function<void(sweep::Row)>& take);

    // False where it was stopped.
    bool run();

private:
    struct Other {
        int n_in_hand = 0;
        bool is_stopped = false;
    };

    void serve_all();
    void serve(int rank);
    void obey(const Message& message);
    void run_here();
    void stop_all();
    void fail(std::exception_ptr error);
    [[nodiscard]] std::optional<std::int64_t> next();
    [[nodiscard]] std::size_t n_left();
    [[nodiscard]] bool is_everybody_idle() const;

    const sweep::Gyros& gyros_;
    const std::vector<std::int64_t>& asked_;
    const std::function<void(sweep::Row)>& take_;
    std::vector<Other> others_;  // by rank; 0 is unused
    bool has_sent_stop_ = false;

    std::mutex shared_;  // with the thread that runs gyros here: the two below
    std::size_t n_given_ = 0;
    std::exception_ptr error_;  // the first one
    std::atomic<bool> stops_ = false;
    std::atomic<bool> is_done_here_ = false;
};

}  // namespace zlg::mpi
