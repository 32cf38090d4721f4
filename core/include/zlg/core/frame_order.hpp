#pragma once
// Order of the frames: whether one that arrived is that of this half, or an old one.

#include <cstdint>

namespace zlg::core {

struct FrameOrderState {
    bool known = false;          // a frame has arrived
    std::uint32_t expected = 0;  // number of the frame of the next half
    std::uint32_t last = 0;      // of the last frame that arrived
    std::int32_t n_in_row = 0;   // frames that did not fit, each with the number after the one before

    friend constexpr bool operator==(const FrameOrderState&, const FrameOrderState&) = default;
};

struct FrameOrderOutput {
    bool fresh = false;    // of this half
    bool follows = false;  // fresh, and its number is the one after that of the half before
    bool error = false;    // arrived with another number than this half's
};

// Advance by one half-period.
//
// A frame that is behind was repeated or is late: all that it holds is of another half. So is one that is ahead, until a
// second one follows it: frames were lost while no half was counted. Frames that stay behind for half a second, each
// following the one before, are believed: their numbers were begun anew.
[[nodiscard]] FrameOrderOutput step(FrameOrderState& state, bool received, std::uint32_t sequence) noexcept;

}  // namespace zlg::core
