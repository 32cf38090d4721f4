#pragma once
// How many switches of a run have succeeded, and how many have not.

#include <cstdint>
#include <string>

#include <zlg/config/config.hpp>
#include <zlg/rig/closed_loop.hpp>

namespace zlg::rig {

struct SwitchTally {
    std::int64_t succeeded = 0;
    std::int64_t failed = 0;
    std::int64_t withheld = 0;  // were due when the gyro was not ready, and until the next one

    [[nodiscard]] std::int64_t due() const { return succeeded + failed + withheld; }
    // Some were due, and the gyro holds the mode of none.
    [[nodiscard]] bool none_succeeded() const { return succeeded == 0 && due() > 0; }
    // More than one in ten of those that were due.
    [[nodiscard]] bool lacks_many() const { return 10 * (failed + withheld) > due(); }
};

// One line for a reader; empty where all were made.
[[nodiscard]] std::string sentence(const SwitchTally& tally);

// Follows a closed loop, half by half. A switch begins where the loop opens for the other helicity; it has succeeded
// when the control sees the mode that it was meant for, and failed when the gyro went back, was searched for, or holds
// nothing by the time at which the control would have given up. One that is due and waits for an interval, or for the
// end, is withheld.
class SwitchCount {
public:
    // errors  config::ConfigError, as `control_config`.
    explicit SwitchCount(const config::Config& config);

    void take(const LoopHalf& half);

    [[nodiscard]] SwitchTally tally() const {
        return {ended_.succeeded, ended_.failed + (is_late() ? 1 : 0), ended_.withheld + (waiting_halves_ > 0 ? 1 : 0)};
    }

private:
    [[nodiscard]] bool is_late() const { return is_switching_ && halves_since_opening_ > patience_halves_; }

    std::int64_t patience_halves_;
    std::int64_t interval_halves_;
    SwitchTally ended_;
    std::int64_t waiting_halves_ = 0;  // that the one that is due has waited
    std::int64_t halves_since_opening_ = 0;
    bool is_under_way_ = false;  // the loop has opened, and no lock has ended that
    bool is_switching_ = false;  // the same, for the other helicity
    bool was_closed_ = true;
    int mode_before_ = 0;
};

}  // namespace zlg::rig
