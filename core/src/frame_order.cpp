#include <zlg/core/frame_order.hpp>

namespace zlg::core {
namespace {

constexpr std::int32_t ahead_believed = 2;
constexpr std::int32_t behind_believed = 200;

bool believed(const FrameOrderState& s, std::uint32_t sequence) noexcept {
    // Unsigned differences wrap: less than half of all numbers is ahead.
    const bool is_ahead = sequence - s.expected < (std::uint32_t{1} << 31);
    return s.n_in_row >= (is_ahead ? ahead_believed : behind_believed);
}

}  // namespace

FrameOrderOutput step(FrameOrderState& state, bool received, std::uint32_t sequence) noexcept {
    FrameOrderOutput out;
    if (!received) {
        ++state.expected;
        state.n_in_row = 0;
        return out;
    }
    if (!state.known || sequence == state.expected) {
        out.fresh = out.follows = true;
        state.known = true;
        state.n_in_row = 0;
        state.expected = sequence + 1;
    } else {
        out.error = true;
        state.n_in_row = sequence == state.last + 1 && state.n_in_row > 0 ? state.n_in_row + 1 : 1;
        if (believed(state, sequence)) {
            out.fresh = true;
            state.n_in_row = 0;
            state.expected = sequence + 1;
        } else {
            ++state.expected;
        }
    }
    state.last = sequence;
    return out;
}

}  // namespace zlg::core
