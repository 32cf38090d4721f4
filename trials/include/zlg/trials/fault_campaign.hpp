#pragma once
// Random faults by the thousand: what of each the processor detects, what it misses, and whether it recovers.
//
// Each fault is of a gyro of its own, in closed loop and with compensation, held against the same gyro without
// the fault: same noise, same motion, same switches.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/twin/faults.hpp>

namespace zlg::trials {

// One gyro and what happens to it.
struct FaultTrial {
    config::Config config;             // [faults] empty
    std::optional<twin::Fault> fault;  // none: what the same figures say of a gyro without
    std::vector<twin::Fault> others;   // at about the same time
    double watched_s = 0.0;            // the time of which angle and validity are asked: from the fault to here
    double end_s = 0.0;
};

struct FaultOutcome {
    bool detected = false;   // a health bit, or a half not valid, that the gyro without fault has not
    double latency_s = 0.0;  // from the fault to the end of that half
    std::int64_t ticks = 0;
    std::int64_t ticks_outside = 0;  // before the fault and after what is watched
    std::int64_t valid_outside = 0;
    std::int64_t ticks_after = 0;  // of these, those after
    std::int64_t valid_after = 0;
    std::int64_t wrong = 0;           // valid ticks, anywhere, wrong by more than 5 sigma
    std::int64_t wrong_bridged = 0;   // the same of ticks that are not valid but have a sigma
    double worst_sigmas = 0.0;        // of a valid tick
    double error_sq_sum = 0.0;        // of the valid ticks outside: squares of error over sigma
    double angle_error_arcsec = 0.0;  // of what is watched, beyond that of the gyro without fault
    double angle_sigma_arcsec = 0.0;  // claimed for it; infinite where no claim is made
    bool recovered = false;           // lit, locked and valid at the end
    bool not_finite = false;          // a record, a row or an actuator held what is no number
    std::string crash;                // what was thrown
};

// What gyros the faults meet. As on a bench: photodiodes that differ and drift, light that decays, both readouts, fast
// swings and vibration, faults of up to 300 s, one in five of them from power-up on; two to six at once.
enum class Surroundings : unsigned char { kind, bench };

// A gyro, its motion and a fault of this kind, as the seed draws them; from 1 ms to 60 s, evenly in the logarithm. Many
// at once: other faults of any kind are near it. A laser is one that the processor knows perfectly.
[[nodiscard]] FaultTrial random_trial(std::optional<twin::FaultKind> kind, std::uint64_t seed,
                                      config::Fidelity fidelity = config::Fidelity::averaged, bool many_at_once = false,
                                      Surroundings surroundings = Surroundings::kind);

[[nodiscard]] FaultOutcome run(const FaultTrial& trial);

// Of all faults of one kind.
struct FaultFigures {
    std::string
        kind;  // "none": gyros without fault; "two at once" or "two to six"; "all": the sum of the others but "none"
    std::int64_t faults = 0;
    std::int64_t detected = 0;
    double median_latency_s = 0.0;  // of those detected; 0 where none is
    double longest_latency_s = 0.0;
    std::int64_t ticks = 0;
    double valid_outside_ratio = 0.0;
    double valid_after_ratio = 0.0;
    double mean_sq_ratio = 0.0;         // of error over sigma, of valid ticks outside
    std::int64_t with_wrong_ticks = 0;  // faults
    std::int64_t wrong_ticks = 0;
    std::int64_t wrong_bridged = 0;  // ticks
    double worst_sigmas = 0.0;
    std::int64_t claimed = 0;         // faults across which an angle is claimed
    std::int64_t angle_beyond_5 = 0;  // of these, wrong by more than 5 sigma
    double angle_rms_arcsec = 0.0;    // of the others
    std::int64_t recovered = 0;
    std::int64_t not_finite = 0;
    std::int64_t crashed = 0;
};

struct FaultCampaign {
    std::int64_t faults = 0;  // of all kinds together, as evenly as can be; so many more gyros of "none" as of a kind
    std::uint64_t seed = 1;
    int threads = 1;
    config::Fidelity fidelity = config::Fidelity::averaged;
    Surroundings surroundings = Surroundings::kind;
    std::vector<twin::FaultKind> kinds;  // none: all
};

// The figures, "none" first, then in the order of the kinds, then two at once (as many as of a kind), then all of them.
// They don't depend on the number of threads.
[[nodiscard]] std::vector<FaultFigures> run(const FaultCampaign& campaign);

// One line for each limit that is not kept; none of a campaign that is good. Of every kind: all recover, no NaN, no
// crash. Of all faults together, of the pairs and of the gyros without fault each: 99.5 % of the ticks outside valid.
// Of all faults together: a mean square of error over sigma of 0.5 to 1.5 outside.
[[nodiscard]] std::vector<std::string> complaints(const std::vector<FaultFigures>& figures);

[[nodiscard]] std::string markdown(const std::vector<FaultFigures>& figures);

}  // namespace zlg::trials
