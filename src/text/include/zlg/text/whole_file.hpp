#pragma once
// A text file that is read as a whole, and so must have an end.

#include <cstddef>
#include <stdexcept>
#include <string>

namespace zlg::text {

struct CannotRead : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct TooLong : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// More than a configuration of every key needs, and little enough to be held and parsed in a blink.
inline constexpr std::size_t max_configuration_bytes = std::size_t{1} << 20;

// Of a regular file, a pipe or a device, which may never end.
//
// errors  CannotRead: what the system says (a folder included), without the path; TooLong: path and limit.
[[nodiscard]] std::string read_whole(const std::string& path, std::size_t max_bytes = max_configuration_bytes);

}  // namespace zlg::text
