#pragma once
// The parts that are being written, by their file descriptors.

#include <string>

namespace zlg::logs {

// Under `Together`, so that a part is never abandoned while its name changes.
void register_part(int fd, const std::string& part);
void forget_part(int fd);

// The part was renamed to its final name: forget_part was called before.
void note_complete(const std::string& name);

// False where another program has removed NAME or put a file of its own in its place.
[[nodiscard]] bool is_still_named(int fd, const std::string& name);

// It holds rows that can be read without being closed.
void keep_part_if_abandoned(int fd);

}  // namespace zlg::logs
