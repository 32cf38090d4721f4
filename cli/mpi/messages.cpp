#include "messages.hpp"

#include <mpi.h>

#include <chrono>
#include <thread>

namespace zlg::mpi {

Session::Session(int& argc, char**& argv) {
    int provided = 0;
    // The other thread of rank 0 runs gyros and knows nothing of MPI.
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
}

Session::~Session() { MPI_Finalize(); }

int rank() {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank;
}

int n_ranks() {
    int n = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &n);
    return n;
}

void send(int rank, Tag tag, const std::string& text) {
    MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, rank, static_cast<int>(tag), MPI_COMM_WORLD);
}

std::optional<Message> received() {
    int is_there = 0;
    MPI_Status status{};
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &is_there, &status);
    if (is_there == 0) return std::nullopt;
    int n = 0;
    MPI_Get_count(&status, MPI_CHAR, &n);
    Message message{status.MPI_SOURCE, static_cast<Tag>(status.MPI_TAG), std::string(static_cast<std::size_t>(n), ' ')};
    MPI_Recv(message.text.data(), n, MPI_CHAR, message.rank, status.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return message;
}

void sleep_a_moment() { std::this_thread::sleep_for(std::chrono::milliseconds{1}); }

}  // namespace zlg::mpi
