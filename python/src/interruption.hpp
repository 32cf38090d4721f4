#pragma once
// Ctrl-C while several threads compute.

#include <atomic>
#include <optional>
#include <thread>

#include <pybind11/pybind11.h>

namespace zlg::python {

// Ctrl-C is seen by the thread that called; the others ask what it saw.
class Interruption {
public:
    bool operator()() {
        if (std::this_thread::get_id() == caller_ && !is_seen_) {
            const pybind11::gil_scoped_acquire interpreter;
            if (PyErr_CheckSignals() != 0) {
                error_.emplace();
                is_seen_ = true;
            }
        }
        return is_seen_;
    }

    // With the interpreter held. errors  what the handler of the signal raised.
    void raise() {
        if (error_) throw *error_;
    }

private:
    std::thread::id caller_ = std::this_thread::get_id();
    std::atomic<bool> is_seen_{false};
    std::optional<pybind11::error_already_set> error_;
};

}  // namespace zlg::python
