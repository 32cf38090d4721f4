#pragma once
// The lab page over HTTP to this machine, with what a gyro gives now.

#include <cstdint>
#include <string>

#include "src/options.hpp"

namespace zlg::cli {

struct LabFollowOptions : Options {
    std::string source;  // what zlg follow takes, or an HDF5 log that grows
    int baud = 0;        // of a serial device
    std::uint16_t port = 0;
};

// Serves until a signal comes, also when the source has ended. With `out` the angles are recorded meanwhile, as `zlg
// follow` does.
//
// errors  UsageError for a log that cannot be read while it grows; those of the sources and the server.
void follow_in_page(const LabFollowOptions& options);

}  // namespace zlg::cli
