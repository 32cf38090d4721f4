#include <zlg/rig/replay.hpp>

#include <fmt/format.h>

#include <zlg/logs/error.hpp>

namespace zlg::rig {

void Replay::require_a_tick(const std::string& log_name) const {
    if (halves_ < 2)
        throw logs::FormatError{fmt::format("{}: holds no whole tick, which is two half-periods", log_name)};
}

std::string Replay::odd_half(const std::string& log_name) const {
    if (halves_ % 2 == 0) return {};
    return fmt::format("{}: the last half-period ({}) is the first of a tick whose other half is missing; dropped",
                       log_name, halves_ - 1);
}

std::vector<std::string> Replay::contradictions(const std::string& log_name) const {
    std::vector<std::string> found{bias_.complaint(log_name), places_.complaint(log_name)};
    std::erase(found, std::string{});
    return found;
}

}  // namespace zlg::rig
