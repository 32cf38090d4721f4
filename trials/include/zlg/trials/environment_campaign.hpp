#pragma once
// Gyros in changing temperature and field: is none lost, is sigma right, does the magnetic estimator do harm?

#include <cstdint>
#include <string>
#include <vector>

#include <zlg/config/config.hpp>

namespace zlg::trials {

struct EnvironmentCampaign {
    std::size_t gyros = 60;
    std::uint64_t seed = 1;
    int threads = 2;
    double run_s = 3600.0;
};

struct EnvironmentGyro {
    std::string family;  // profile, field
    config::Config config;
};

// The gyros of the campaign of random gyros, averaged, in ramps of 10 C/h, soaks, cycles of a chamber or their own
// warming, and in no field but their own drift, or one that is constant, swings or steps.
[[nodiscard]] EnvironmentGyro environment_gyro(const EnvironmentCampaign& campaign, std::uint64_t number);

struct EnvironmentOutcome {
    std::string family;
    std::string crash;
    bool lost = false;
    std::int64_t switches = 0;
    double sum_sq_ratio = 0.0;  // of their errors over sigma
    // Rms over the second half of the run of the angle's error without the constant drift, and with the drift that
    // changes its sign with the mode left in it and estimated.
    double none_arcsec = 0.0;
    double estimate_arcsec = 0.0;
};

[[nodiscard]] std::vector<EnvironmentOutcome> run(const EnvironmentCampaign& campaign);

// What breaks a limit; empty where nothing does.
[[nodiscard]] std::vector<std::string> complaints(const std::vector<EnvironmentOutcome>& outcomes);

[[nodiscard]] std::string markdown(const std::vector<EnvironmentOutcome>& outcomes);

}  // namespace zlg::trials
