#pragma once
// Texts from one process of a sweep to another, over MPI.
//
// Nobody waits within MPI: its waits occupy a processor. Who has nothing to do looks for a message and sleeps for a
// millisecond.

#include <optional>
#include <string>

namespace zlg::mpi {

enum class Tag : int {
    // From rank 0.
    description,  // of the sweep whose gyros will come
    gyro,         // its number: run it
    stop,         // run no more; the answer is `stopped`
    end,          // of the program
    // To rank 0.
    row,      // of one gyro, as sweep::text_of
    failed,   // why no more gyros are run here
    stopped,  // no more gyros are run here
};

struct Message {
    int rank = 0;  // that sent it
    Tag tag{};
    std::string text;
};

// MPI from here to the end of its life; of one thread.
class Session {
public:
    Session(int& argc, char**& argv);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
};

[[nodiscard]] int rank();
[[nodiscard]] int n_ranks();

// Messages to one rank come in the order in which they were sent.
void send(int rank, Tag tag, const std::string& text = {});

// The next message, if one is there.
[[nodiscard]] std::optional<Message> received();

void sleep_a_moment();

}  // namespace zlg::mpi
