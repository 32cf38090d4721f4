#pragma once
// What a configuration leaves open, decided before a gyro runs: the constants that a laser implies, and the best
// interval.

#include <string>
#include <vector>

#include <zlg/config/config.hpp>

namespace zlg::study {

struct Resolved {
    config::Config config;
    std::vector<std::string> notes;     // what was decided
    std::vector<std::string> warnings;  // what contradicts itself and was left as it is; a motion file without its end
};

// With the constants that follow from [laser], as rig::agreed_with_laser, and a number in place of switching.interval_s
// = "optimal". A configuration that leaves nothing open comes back as it is.
//
// errors  config::ConfigError where [laser] does not make a gyro; those of a motion file.
[[nodiscard]] Resolved resolved(const config::Config& config);

}  // namespace zlg::study
