#include <zlg/core/control/counter_monitor.hpp>

#include <algorithm>
#include <bit>

namespace zlg::core {
namespace {

// Not judged: bit 0, and those whose errors are out of the bias's band.
constexpr std::uint32_t judged = (1u << judged_bits) - 2;

constexpr std::int32_t calm_halves = 400;

// Of R, where the counter turns evenly: the rounding of seven readings.
constexpr std::uint32_t rounding = 4;

constexpr std::uint32_t most_residual = 1u << 16;

// Readings that prove a bit. Errors of a higher one are less like what a motion leaves.
constexpr int proof(int bit) noexcept { return std::max(28 - 2 * bit, 12); }

// The bits that may be stuck: 1/4 to 3/2 of 2^k is what their errors make of a residual.
std::uint32_t bits_of(std::uint32_t residual) noexcept {
    return 2 * std::bit_floor(residual + residual / 4 + 1) - std::bit_ceil(residual / 7 + 1);
}

// One of 64 places. Numbers at even distances fill them as any others do.
std::uint32_t hashed(std::uint32_t x) noexcept {
    x *= 0x9E3779B1u;
    return ((x ^ (x >> 15)) * 0x85EBCA6Bu) >> 26;
}

// None of these is stuck.
void acquit(CounterMonitorState& s, std::uint32_t bits) noexcept {
    std::uint32_t left = bits & s.suspected;
    if (left == 0) return;
    s.suspected &= ~bits;
    s.stuck &= ~bits;
    for (; left != 0; left &= left - 1) s.readings[static_cast<std::size_t>(std::countr_zero(left))] = 0;
}

// In a reading these bits show what they should not. It is told from others by itself and the one before of its sign.
void accuse(CounterMonitorState& s, std::uint32_t bits, std::uint32_t residual, std::uint32_t usual) noexcept {
    const std::uint32_t tolerance = usual + rounding;
    const std::uint64_t place = std::uint64_t{1} << hashed(s.last[3] + 5 * s.last[1]);
    for (std::uint32_t left = bits; left != 0; left &= left - 1) {
        const std::uint32_t bit = left & (0 - left);
        if (((residual + tolerance) & (bit - 1)) > 2 * tolerance) continue;
        const int k = std::countr_zero(left);
        std::uint64_t& seen = s.readings[static_cast<std::size_t>(k)];
        if ((seen & place) == 0 || (s.stuck & bit) != 0) s.n_calm = 0;
        seen |= place;
        s.suspected |= bit;
        if (std::popcount(seen) >= proof(k)) s.stuck |= bit;
    }
}

void compare(CounterMonitorState& s) noexcept {
    const auto& [y0, y1, y2, y3, y4, y5, y6] = s.last;
    const auto r = static_cast<std::int32_t>(4 * y3 - y2 - y4 - 2 * (y1 + y5) + y0 + y6);
    const std::uint32_t residual = r < 0 ? 0 - static_cast<std::uint32_t>(r) : static_cast<std::uint32_t>(r);
    if (residual >= most_residual) return;
    const std::uint32_t usual = s.rough >> 6;
    std::uint32_t wrong = 0;
    if (residual > usual + 1) {
        const std::uint32_t apart = (residual - usual + 2) / 4;
        wrong = ((r < 0 ? y3 + apart : y3 - apart) ^ y3) & judged;
        if (wrong != 0) wrong &= bits_of(residual);
    }
    if (wrong != 0) return accuse(s, wrong, residual, usual);
    s.rough += std::min(residual, 4 * usual + 4) - usual;
}

}  // namespace

bool step(CounterMonitorState& state, bool counted, std::uint64_t reading) noexcept {
    const auto low = static_cast<std::uint32_t>(reading);
    acquit(state, low ^ state.last[6]);
    for (std::size_t n = 1; n < state.last.size(); ++n) state.last[n - 1] = state.last[n];
    state.last[6] = low;
    if (++state.n_calm >= calm_halves) {
        acquit(state, judged);
        state.n_calm = 0;
    }
    state.n_known = counted ? state.n_known + 1 : 1;
    if (state.n_known < 7) return state.stuck != 0;
    state.n_known = 7;
    compare(state);
    return state.stuck != 0;
}

}  // namespace zlg::core
