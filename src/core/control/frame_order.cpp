#include <zlg/core/control/frame_order.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

constexpr std::int32_t ahead_accepted = 2;
constexpr std::int32_t behind_accepted = 200;

// Frames that come a few halves late keep coming late for as long as what delays them lasts; their numbers go on.
constexpr std::uint32_t max_late = 8;

bool is_accepted(const FrameOrderState& s, std::uint32_t sequence) noexcept {
    // Unsigned differences wrap: less than half of all numbers is ahead.
    const bool is_ahead = sequence - s.expected < (std::uint32_t{1} << 31);
    if (is_ahead) return s.n_in_row >= ahead_accepted;
    const bool is_late = s.expected - sequence <= max_late && !s.on_time;
    return s.n_in_row >= behind_accepted && !is_late;
}

}  // namespace

FrameOrderOutput step(FrameOrderState& state, bool received, std::uint32_t sequence, bool on_time) noexcept {
    FrameOrderOutput out;
    if (!received) {
        ++state.expected;
        state.n_in_row = 0;
        return out;
    }
    if (!state.known || sequence == state.expected) {
        out.fresh = true;
        // After halves that were missed the first frame of all may be one of theirs, late.
        out.follows = sequence == state.expected || state.expected == 0;
        state.known = true;
    } else {
        out.error = true;
        const bool goes_on = sequence == state.last + 1 && state.n_in_row > 0;
        if (!goes_on) state.n_in_row = 0;
        count_up(state.n_in_row);
        state.on_time = on_time && (!goes_on || state.on_time);
        out.fresh = is_accepted(state, sequence);
    }
    state.expected = (out.fresh ? sequence : state.expected) + 1;
    state.last = sequence;
    return out;
}

}  // namespace zlg::core
