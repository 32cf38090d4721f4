#pragma once
// Order of the frames: whether one that arrived is that of this half, or an old one.

#include <cstdint>

namespace zlg::core {

struct FrameOrderState {
    bool known = false;          // a frame has arrived
    std::uint32_t expected = 0;  // number of the frame of the next half
    std::uint32_t last = 0;      // of the last frame that arrived
    bool on_time = false;        // each of the frames in a row was latched in its own half
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
// A frame that is behind was repeated or is late: all that it holds is of another half. The same holds for one that is
// ahead, until a second one follows it: frames were lost while no half was counted. Frames that stay behind for half a
// second, each following the one before, are accepted: their numbers were begun anew. Those that are behind by no more
// than eight are late, for as long as what delays them lasts: the counts of the half before, in place of this one's.
// But where all of them were latched on time, the numbers were begun anew here, too.
//
// The first frame of all may have any number. But where halves were missed before it, it follows only with the number
// of its half: another one does not say which half it ended.
//
// on_time  by its timer stamp the frame is that of this half.
[[nodiscard]] FrameOrderOutput step(FrameOrderState& state, bool received, std::uint32_t sequence,
                                    bool on_time = false) noexcept;

}  // namespace zlg::core
