#include <zlg/twin/faults.hpp>

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include <zlg/chance/draw.hpp>

namespace zlg::twin {

Fault random_fault(FaultKind kind, double at_s, std::uint64_t seed, std::uint64_t number) {
    const FaultFacts& f = facts(kind);
    chance::Draw draw{seed, chance::Cause::faults, number};
    const double duration_s = draw.within_log(f.random_s.least, f.random_s.most);
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
    for (double at_s = 0.0;;) {
        chance::Draw draw{seed, chance::Cause::fault_times, made.size()};
        at_s += draw.exponential() * 3600.0 / per_hour;
        if (!(at_s < until_s)) return made;
        made.push_back(random_fault(kinds[draw.below(kinds.size())], at_s, seed, made.size()));
    }
}

}  // namespace zlg::twin
