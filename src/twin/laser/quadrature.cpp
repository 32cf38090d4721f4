#include <zlg/twin/quadrature.hpp>

namespace zlg::twin {
namespace {

bool switched(bool high, double signal, double threshold) {
    if (signal > threshold) return true;
    if (signal < -threshold) return false;
    return high;
}

}  // namespace

void QuadratureDecoder::see(const Signals& signals) {
    const int before = quadrant();
    s_high_ = switched(s_high_, signals.s, threshold_);
    c_high_ = switched(c_high_, signals.c, threshold_);
    switch ((quadrant() - before) & 3) {
        case 1: ++quarters_; break;
        case 2: ++n_ambiguous_; break;
        case 3: --quarters_; break;
        default: break;
    }
}

std::int64_t QuarterTurns::floor_of(const Turns& phase) {
    const auto quarter = static_cast<std::uint64_t>(4.0 * phase.part);
    return static_cast<std::int64_t>(4u * static_cast<std::uint64_t>(phase.whole) + quarter);
}

void QuarterTurns::see(const Turns& phase, double lag_turns) {
    Turns late = phase;
    late.add(-lag_turns);
    Turns early = phase;
    early.add(lag_turns);
    // Differences, because the counts wrap.
    const auto distance = [this](std::int64_t to) {
        return static_cast<std::int64_t>(static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(quarters_));
    };
    const std::int64_t least = floor_of(late);
    const std::int64_t most = floor_of(early);
    if (distance(least) > 0) {
        quarters_ = least;
    } else if (distance(most) < 0) {
        quarters_ = most;
    }
}

}  // namespace zlg::twin
