#pragma once
// The identifiers of the HDF5 library as objects that close themselves, and what it says when something fails.

#include <hdf5.h>

#include <string>
#include <utility>

namespace zlg::logs::hdf5 {

class Handle {
public:
    using Closer = herr_t (*)(hid_t);

    Handle() = default;
    Handle(hid_t id, Closer closer) : id_{id}, closer_{closer} {}
    ~Handle() { close(); }
    Handle(Handle&& other) noexcept : id_{std::exchange(other.id_, -1)}, closer_{other.closer_} {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(id_, other.id_);
        std::swap(closer_, other.closer_);
        return *this;
    }

    [[nodiscard]] hid_t get() const { return id_; }
    [[nodiscard]] bool is_open() const { return id_ >= 0; }

    bool close() { return id_ < 0 || closer_(std::exchange(id_, -1)) >= 0; }

private:
    hid_t id_ = -1;
    Closer closer_ = nullptr;
};

// The library would print every failure to stderr, also one that is expected and handled. Once per thread.
void keep_quiet();

struct Failure {
    std::string reason;         // in the words of the system or, without those, of the library's innermost remark
    bool is_of_system = false;  // the reason is the system's: the file could not be opened, read or written
};

// Of the last call in this thread that failed.
[[nodiscard]] Failure last_failure();

}  // namespace zlg::logs::hdf5
