#pragma once
// What happened in a run, in words for whoever reads its figures.

#include <string>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/study/run.hpp>

namespace zlg::study {

// One sentence each: length and switches; where they are none or few; switches that failed; the faults and what the
// core made of them; what the figures leave out.
[[nodiscard]] std::vector<std::string> what_happened(const config::Config& config, const RunResult& result);

// The standard deviations that the random walk W of the gyro alone gives to the figures of a run of the time T: its
// variance is W^2 T at the end, and 1.2 W^2/T that of the least-squares slope. 0 for `laser`, whose walk is not a key.
struct RandomWalkShare {
    double drift_arcsec_s = 0.0;
    double angle_arcsec = 0.0;
};

[[nodiscard]] RandomWalkShare random_walk_share(const config::Config& config, const RunResult& result);

}  // namespace zlg::study
