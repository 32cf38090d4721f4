#pragma once
// A rank above 0: it runs the gyros that rank 0 sends, until rank 0 sends the end.

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include <zlg/sweep/gyros.hpp>

#include "messages.hpp"

namespace zlg::mpi {

class Worker {
public:
    void work();

private:
    void read_messages();
    void obey(const Message& message);
    void run_next();
    void stop(Tag why, const std::string& text = {});
    [[nodiscard]] bool is_stopped();
    std::optional<sweep::Gyros> gyros_;
    std::deque<std::int64_t> waiting_;
    bool is_stopped_ = false;
    bool is_ended_ = false;
};

}  // namespace zlg::mpi
