#pragma once
// Keeps the last ticks of a run and sets one switch aside, to be shown magnified.

#include <cstdint>
#include <deque>
#include <vector>

#include <zlg/rig/closed_loop.hpp>
#include <zlg/study/switch_window.hpp>

namespace zlg::study {

// Two halves of a tick, before anything is made of them.
[[nodiscard]] MagnifiedTick shown_tick(std::int64_t tick, double scale_arcsec, const rig::LoopHalf& first,
                                       const rig::LoopHalf& second);

class Magnifier {
public:
    void take(const MagnifiedTick& tick, const std::deque<SwitchWindow>& windows);
    [[nodiscard]] const std::vector<MagnifiedTick>& ticks() const { return kept_; }

private:
    static constexpr std::int64_t ticks_before = 8;
    static constexpr std::int64_t ticks_after = 16;

    std::deque<MagnifiedTick> recent_;
    std::vector<MagnifiedTick> kept_;
};

}  // namespace zlg::study
