#pragma once
// Random gyros in closed loop: every key that makes a gyro, over what a real one can have, at both fidelities.
//
// Nothing breaks in them. So none may be lost, no monitor may object, and what each switch leaves in the angle must be
// within what is claimed of it.

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/config/schema.hpp>

namespace zlg::trials {

struct GyroTrial {
    std::uint64_t number = 0;
    config::Settings settings;         // all that was drawn, in order
    config::Config config;             // the same, with what follows from it (study::resolved)
    std::vector<std::string> refused;  // why: earlier draws of this gyro that a user could not have run either
};

// Gyro `number` of a seed, whatever else is drawn.
//
// errors  config::ConfigError where a hundred draws in a row are refused.
[[nodiscard]] GyroTrial random_gyro(std::uint64_t seed, std::uint64_t number, config::Fidelity fidelity);

// The command that runs the same gyro.
[[nodiscard]] std::string command(const GyroTrial& trial);

struct GyroOutcome {
    std::uint64_t number = 0;
    config::Fidelity fidelity = config::Fidelity::averaged;
    std::int64_t refused = 0;  // draws
    std::string command;

    std::int64_t ticks = 0;
    std::int64_t valid = 0;       // neither invalid nor unrepaired, sigma finite
    std::int64_t unrepaired = 0;  // ticks
    bool lost = false;        // not lit, locked and valid in the last stretch between switches, or no switch succeeded
    std::int64_t failed = 0;  // switches after which the gyro went back or had to be searched for
    std::array<std::int64_t, 32> alarms{};  // halves with this health bit, of those that only a fault explains

    std::int64_t judged = 0;   // switches: whole ones whose sigma is finite
    std::int64_t flagged = 0;  // of these, where a tick lacks its re-lock correction
    double mean_sq_ratio = std::numeric_limits<double>::quiet_NaN();  // of error over sigma
    double worst_sigmas = 0.0;                                        // of a switch without that flag
    double worst_flagged_sigmas = 0.0;                                // and with it
    double switch_rms_arcsec = 0.0;
    std::int64_t wrong_ticks = 0;  // valid and off by more than 5 sigma
    double drift_arcsec_s = 0.0;   // slope of the error of the angle, less the non-magnetic drift
    bool not_finite = false;
    std::string crash;  // what was thrown

    [[nodiscard]] std::string alarm_names() const;  // of the bits that were seen, with a comma between
};

[[nodiscard]] GyroOutcome run(const GyroTrial& trial);

struct GyroCampaign {
    std::uint64_t gyros = 0;
    std::uint64_t seed = 1;
    int threads = 1;
    std::vector<config::Fidelity> fidelities{config::Fidelity::averaged};  // in turn
    std::uint64_t first = 0;                                               // number
};

// By number. They do not depend on the number of threads.
[[nodiscard]] std::vector<GyroOutcome> run(const GyroCampaign& campaign);

// One line for each limit that is not kept, with the command of the gyro where it is one: none lost, no false alarm, no
// unrepaired tick, no NaN, no crash, no switch beyond 5 sigma without a flag; of all gyros with 5 switches, where they
// are 50 at least, a median rms of error over sigma of 0.9 to 1.2.
[[nodiscard]] std::vector<std::string> complaints(const std::vector<GyroOutcome>& outcomes);

// A row for each fidelity and one for all; and one for each gyro.
[[nodiscard]] std::string summary_markdown(const std::vector<GyroOutcome>& outcomes);
[[nodiscard]] std::string gyros_markdown(const std::vector<GyroOutcome>& outcomes);

}  // namespace zlg::trials
