#pragma once
// Where the HDF5 library writes a growing log: an open file that takes no more bytes after the first failure.
//
// HDF5 1.10 cannot close a file whose last writes fail: it hangs or complains at exit. So a failed write is kept from
// it: from then on nothing reaches the file, which stays as if the program had been killed at that moment, and what was
// flushed before stays readable. The writer asks for `error` after each step.

#include <hdf5.h>

#include <map>
#include <vector>

#include "hdf5_handle.hpp"

namespace zlg::logs::hdf5 {

class Storage {
public:
    // `fd` is open for reading and writing, and empty; it outlives the storage.
    explicit Storage(int fd) : fd_{fd} {}

    // The errno of the first write that failed; 0: none has.
    [[nodiscard]] int error() const { return error_; }

    // Until here the file is made in memory, so that nobody ever sees or inherits half of its beginning.
    void publish();

    // From here on nothing reaches the file: it stays as if the program had been killed now.
    void stop();

    // What the driver calls.
    [[nodiscard]] bool read(haddr_t address, size_t size, void* buffer);
    void write(haddr_t address, size_t size, const void* buffer);
    void resize(haddr_t size);
    [[nodiscard]] haddr_t end() const { return end_; }

private:
    int fd_;
    int error_ = 0;
    bool staged_ = true;
    haddr_t end_ = 0;
    std::vector<char> image_;                    // of the file, until it is published
    std::map<haddr_t, std::vector<char>> lost_;  // what did not reach the file, as the library may read it again
};

// File access properties: the latest format, and `storage`, which must outlive the file.
[[nodiscard]] Handle access_to(Storage& storage);

}  // namespace zlg::logs::hdf5
