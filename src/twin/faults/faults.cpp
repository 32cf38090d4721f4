#include <zlg/twin/faults.hpp>

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "noise.hpp"

namespace zlg::twin {

Fault random_fault(FaultKind kind, double at_s, std::uint64_t seed) {
    const FaultFacts& f = facts(kind);
    NoiseStream draw{seed, NoiseCause::faults};
    const double duration_s = f.random_s.least * std::pow(f.random_s.most / f.random_s.least, draw.uniform());
    const auto [least, most] = f.random_size;
    double size = least + (most - least) * draw.uniform();
    if (f.is_whole) size = std::floor(least + (most - least + 1.0) * draw.uniform());
    if (f.either_sign && draw.uniform() < 0.5) size = -size;
    return {kind, at_s, duration_s, size};
}

std::vector<Fault> random_faults(double per_hour, double until_s, std::uint64_t seed,
                                 std::span<const FaultKind> kinds) {
    constexpr double too_many = 1e6;
    if (!(per_hour >= 0.0 && until_s >= 0.0 && per_hour * until_s / 3600.0 < too_many)) {
        throw std::invalid_argument(
            fmt::format("random faults: {} an hour for {} s, allowed is 0 or more, and less than {} faults", per_hour,
                        until_s, too_many));
    }
    if (kinds.empty()) kinds = all_fault_kinds;
    std::vector<Fault> made;
    if (per_hour == 0.0) return made;
    NoiseStream draw{seed, NoiseCause::fault_times};
    const auto wait_s = [&] { return -std::log1p(-draw.uniform()) * 3600.0 / per_hour; };
    for (double at_s = wait_s(); at_s < until_s; at_s += wait_s()) {
        const auto k = static_cast<std::size_t>(draw.uniform() * static_cast<double>(kinds.size()));
        made.push_back(random_fault(kinds[k], at_s, scrambled(seed) + made.size()));
    }
    return made;
}

}  // namespace zlg::twin
