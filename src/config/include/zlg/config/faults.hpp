#pragma once
// The section [faults]: what breaks in a simulated gyro.

#include <cstdint>
#include <vector>

#include <zlg/twin/fault_kinds.hpp>

namespace zlg::config {

struct Faults {
    // Fault number i is kind[i] from at_s[i] on.
    std::vector<twin::FaultKind> kind;
    std::vector<double> at_s;
    std::vector<double> duration_s;
    std::vector<double> size;  // in the unit of its kind
    double random_per_hour = 0.0;
    std::uint64_t random_seed = 1;
    std::vector<twin::FaultKind> random_kinds;  // none: all
};

}  // namespace zlg::config
