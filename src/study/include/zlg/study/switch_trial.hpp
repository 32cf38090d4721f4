#pragma once
// What a switch of the configured gyro leaves, found by trying: loop, re-lock, bridge, motion and noise as configured.

#include <cstdint>
#include <string_view>

#include <zlg/config/config.hpp>

namespace zlg::study {

struct SwitchTrial {
    std::int64_t switches = 0;  // that were judged
    double rms_arcsec = 0.0;    // of what adds up from switch to switch
    bool is_resolved = true;    // false: the error is less than the walk lets a trial see, and rms_arcsec is this bound
    double alternating_arcsec = 0.0;  // mean with the sign of the false drift: the next switch takes it back
};

// Switches of the gyro on the twin, without drift and faults, at three short intervals so that a vibration meets them
// at unlike phases. The first ones, in which bridge and piezo learn, are left out; so is the random walk of their
// windows, which a gyro has without switching too. What is left is known no better than the walk's own scatter, the
// standard error sqrt(2 sum walk^4)/(n - 1) of the mean square: no less is ever claimed.
//
// Of a loop that needs many seconds to lock fewer switches are tried. Of a motion file as much is used as it holds. The
// seed is that of the configuration: the answer is the same each time.
//
// accuracy  about 9 %, from 60 switches; the best interval goes with the power 2/3 of it.
// errors    config::ConfigError; those of a motion file.
// cost      two minutes of the gyro's time: 0.1 s in fidelity averaged, 1 s in laser.
[[nodiscard]] SwitchTrial try_switches(const config::Config& config);

// The least interval at which a switch is over before the next one begins: gap, re-lock and the judgement of the lock.
[[nodiscard]] double shortest_interval_s(const config::Config& config);

// Where the error of a switch comes from.
enum class SwitchErrorSource : unsigned char { given, tried, unresolved, presumed };

// "as tried on the twin" and the like.
[[nodiscard]] std::string_view text(SwitchErrorSource source);

struct SwitchCost {
    double error_arcsec = 0.0;
    SwitchErrorSource source = SwitchErrorSource::presumed;
};

// design.switch_error_arcsec where it is given, else that of the trial; where that has no 4 switches, the default.
[[nodiscard]] SwitchCost switch_cost(const config::Config& config);
[[nodiscard]] double switch_error_arcsec(const config::Config& config);

}  // namespace zlg::study
