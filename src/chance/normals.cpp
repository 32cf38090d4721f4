// Normal deviates of an address, many side by side: loops over arrays, of which the compiler makes instructions for two
// numbers.

#include <zlg/chance/address.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include "box_muller.hpp"
#include "counter.hpp"
#include "philox.hpp"

namespace zlg::chance {
namespace {

// Four deviates of each of n blocks, from the block on.
template <std::size_t n> void fill(const Address& address, std::uint32_t block, double* out) noexcept {
    transform(philox_blocks<n>(counter_of(address, of_normals, block), address.seed), out);
}

// Only the first of them.
template <std::size_t n> void fill_part(const Address& address, std::uint32_t block, std::span<double> out) noexcept {
    std::array<double, 4 * n> all;
    fill<n>(address, block, all.data());
    std::copy_n(all.begin(), out.size(), out.begin());
}

constexpr std::uint32_t many = 8;  // blocks at once

void fill_many(const Address& address, std::uint32_t block, double* out) noexcept { fill<many>(address, block, out); }

// The same operations on four numbers at a time, where the processor has AVX2: a third less time, and the same bits,
// for none of them is fused. What is not compiled into this function remains for every processor.
#if defined(__x86_64__)
[[gnu::target("avx2"), gnu::flatten]] void fill_many_avx2(const Address& address, std::uint32_t block,
                                                          double* out) noexcept {
    fill<many>(address, block, out);
}

const auto fill_many_here = __builtin_cpu_supports("avx2") ? fill_many_avx2 : fill_many;
#else
const auto fill_many_here = fill_many;
#endif

}  // namespace

double normal(const Address& address, std::uint32_t index) noexcept {
    const Block block = philox(counter_of(address, of_normals, index / 4), address.seed);
    std::array<double, 2> pair;
    transform(std::array{block[index / 2 % 2]}, pair.data());
    return pair[index % 2];
}

void normals(const Address& address, std::span<double> out, std::uint32_t first) noexcept {
    assert(first % 4 == 0);
    std::uint32_t block = first / 4;
    for (; out.size() >= 4 * many; block += many, out = out.subspan(4 * many))
        fill_many_here(address, block, out.data());
    if (out.size() >= 16) {
        fill<4>(address, block, out.data());
        block += 4;
        out = out.subspan(16);
    }
    if (out.size() > 4) return fill_part<4>(address, block, out);
    if (!out.empty()) fill_part<1>(address, block, out);
}

}  // namespace zlg::chance
