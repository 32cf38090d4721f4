#pragma once
// Drift of long runs in closed loop, over many gyros that differ by their noise: what schedules and compensations
// leave.
//
// The excess at time t is (delivered angle - true angle)/t less the non-magnetic drift, which no switching removes. The
// random walk W of the gyro is in it: no method comes below W/sqrt(t). The twin knows its walk, so that the excess is
// given without it as well, of the same runs.

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <zlg/config/config.hpp>

namespace zlg::trials {

struct DriftMethod {
    std::string name;
    config::Compensation compensation;
};

// A gyro and the compensations of its records. They all take those of one run, unless its schedule is `measured`: then
// a gyro has one method, whose measurements steer it.
struct DriftGyro {
    std::string name;
    config::Config config;  // [compensation] is replaced by that of each method, seed and phase of the motion are drawn
    std::vector<DriftMethod> methods;
};

struct DriftCampaign {
    std::vector<DriftGyro> gyros;
    std::vector<double> times_s;  // growing; the last one is the length of the run
    std::int64_t seeds = 10;
    std::uint64_t seed = 1;  // the first
    int threads = 1;
};

// Gyros without a magnetic drift over pure tones, 10 to 60 Hz, 1000 to 20 000 arcsec/s, 8 to 20 s from switch to
// switch: `joint` without the magnetic estimate and with it.
[[nodiscard]] std::vector<DriftGyro> over_tones(int n, std::uint64_t seed);

// Of one method, over all seeds.
struct DriftAtTime {
    double time_s = 0.0;
    double rms_arcsec_s = 0.0;
    double mean_arcsec_s = 0.0;
    double percentile_95_arcsec_s = 0.0;  // of the magnitudes
    double max_arcsec_s = 0.0;
    double rms_before_arcsec_s = 0.0;     // over the last twentieth of that time, for an end that nobody knew
    double rms_less_walk_arcsec_s = 0.0;  // both without the walk of that very gyro: what a method can avoid
    double rms_before_less_walk_arcsec_s = 0.0;
};

struct DriftFigures {
    std::string gyro;
    std::string method;
    double switches = 0.0;  // mean of the runs
    double switch_mean_arcsec =
        std::numeric_limits<double>::quiet_NaN();  // of the errors of all switches, with the sign of the false angle
    double switch_rms_arcsec =
        std::numeric_limits<double>::quiet_NaN();  // NaN, as the mean, where no switch was repaired
    std::vector<DriftAtTime> at;
};

// In the order of gyros and methods. They don't depend on the number of threads.
//
// errors  config::ConfigError.
[[nodiscard]] std::vector<DriftFigures> run(const DriftCampaign& campaign);

[[nodiscard]] std::string markdown(const std::vector<DriftFigures>& figures);

}  // namespace zlg::trials
