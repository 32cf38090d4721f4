#include <zlg/rig/replay.hpp>

#include <fmt/format.h>

namespace zlg::rig {

std::string Replay::odd_half(const std::string& log_name) const {
    if (halves_ % 2 == 0) return {};
    return fmt::format("{}: the last half-period ({}) is the first of a tick whose other half is missing; dropped",
                       log_name, halves_ - 1);
}

std::string Replay::uncorrected(const std::string& log_name) const {
    if (n_open_ == 0 || config_.relock.method != core::RelockMethod::none) return {};
    return fmt::format(
        "{}: has no column detuning_sq_lambda2, and compensation.relock is not set: the false drift after the loop is "
        "closed is not subtracted, and sigma_arcsec of {} ticks after each closing presumes a miss of 0.18 wavelength; "
        "compensation.relock = \"frequency\" needs no such column",
        log_name, config_.relock.ticks);
}

std::vector<std::string> Replay::contradictions(const std::string& log_name) const {
    std::vector<std::string> found{bias_.complaint(log_name), places_.complaint(log_name)};
    if (2 * n_open_ > halves_)
        found.push_back(
            fmt::format("{}: the loop is open in {} of {} half-periods, and nothing of them is in the angle; right is "
                        "loop_closed 1 wherever the perimeter is controlled",
                        log_name, n_open_, halves_));
    std::erase(found, std::string{});
    return found;
}

}  // namespace zlg::rig
