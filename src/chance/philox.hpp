#pragma once
// Philox4x32-10, the generator without a state: a block of 128 random bits is a function of a counter and a key.
//
// Source: J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, "Parallel random numbers: as easy as 1, 2, 3", Proc. SC11
// (2011), section 4.3 and table 2. A round takes the words (a, b, c, d) of the counter and the halves (k, l) of the key
// to
//
//   a' = high(M c) ^ b ^ k,  b' = low(M c),  c' = high(N a) ^ d ^ l,  d' = low(N a)
//
// where high and low are the halves of the product of 64 bits; from round to round constants are added to k and l.

#include <array>
#include <cstddef>
#include <cstdint>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace zlg::chance {

inline constexpr int philox_rounds = 10;
inline constexpr std::uint32_t philox_multiplier_a = 0xd2511f53u;
inline constexpr std::uint32_t philox_multiplier_c = 0xcd9e8d57u;
inline constexpr std::uint32_t philox_step_low = 0x9e3779b9u;   // golden ratio
inline constexpr std::uint32_t philox_step_high = 0xbb67ae85u;  // square root of 3, less 1

// The words of a counter, the first of which counts blocks.
using Counter = std::array<std::uint32_t, 4>;

// The four words of a block as two numbers of 64 bits: words 0 and 1, words 2 and 3, the lower word first.
using Block = std::array<std::uint64_t, 2>;

[[nodiscard]] inline Block philox(Counter x, std::uint64_t key) noexcept {
    auto low_key = static_cast<std::uint32_t>(key);
    auto high_key = static_cast<std::uint32_t>(key >> 32);
    for (int round = 0; round < philox_rounds; ++round) {
        const std::uint64_t of_a = std::uint64_t{philox_multiplier_a} * x[0];
        const std::uint64_t of_c = std::uint64_t{philox_multiplier_c} * x[2];
        x = {static_cast<std::uint32_t>(of_c >> 32) ^ x[1] ^ low_key, static_cast<std::uint32_t>(of_c),
             static_cast<std::uint32_t>(of_a >> 32) ^ x[3] ^ high_key, static_cast<std::uint32_t>(of_a)};
        low_key += philox_step_low;
        high_key += philox_step_high;
    }
    return {x[0] | std::uint64_t{x[1]} << 32, x[2] | std::uint64_t{x[3]} << 32};
}

#ifdef __SSE2__

// Two blocks: each word of theirs in the lower half of a lane of 64 bits. The upper half holds what a product left
// there; the multiplication does not read it.
struct TwoBlocks {
    __m128i a, b, c, d;

    void advance(__m128i low_key, __m128i high_key) noexcept {
        const __m128i of_a = _mm_mul_epu32(a, _mm_set1_epi64x(philox_multiplier_a));
        const __m128i of_c = _mm_mul_epu32(c, _mm_set1_epi64x(philox_multiplier_c));
        a = _mm_xor_si128(_mm_srli_epi64(of_c, 32), _mm_xor_si128(b, low_key));
        b = of_c;
        c = _mm_xor_si128(_mm_srli_epi64(of_a, 32), _mm_xor_si128(d, high_key));
        d = of_a;
    }

    void store(std::uint64_t* words) const noexcept {
        const __m128i lower = _mm_set1_epi64x(0xffffffff);
        const __m128i ab = _mm_or_si128(_mm_and_si128(a, lower), _mm_slli_epi64(b, 32));
        const __m128i cd = _mm_or_si128(_mm_and_si128(c, lower), _mm_slli_epi64(d, 32));
        _mm_storeu_si128(reinterpret_cast<__m128i*>(words), _mm_unpacklo_epi64(ab, cd));
        _mm_storeu_si128(reinterpret_cast<__m128i*>(words + 2), _mm_unpackhi_epi64(ab, cd));
    }
};

[[nodiscard]] inline TwoBlocks two_blocks(const Counter& x, std::uint32_t further) noexcept {
    const std::uint32_t first = x[0] + further;
    return {.a = _mm_set_epi64x(std::int64_t{first + 1}, std::int64_t{first}),
            .b = _mm_set1_epi64x(std::int64_t{x[1]}),
            .c = _mm_set1_epi64x(std::int64_t{x[2]}),
            .d = _mm_set1_epi64x(std::int64_t{x[3]})};
}

// Four blocks, the most that the registers hold at once.
inline void four_blocks(const Counter& x, std::uint32_t further, std::uint64_t key, std::uint64_t* words) noexcept {
    auto low_key = static_cast<std::uint32_t>(key);
    auto high_key = static_cast<std::uint32_t>(key >> 32);
    TwoBlocks left = two_blocks(x, further);
    TwoBlocks right = two_blocks(x, further + 2);
    for (int round = 0; round < philox_rounds; ++round) {
        const __m128i low = _mm_set1_epi64x(std::int64_t{low_key});
        const __m128i high = _mm_set1_epi64x(std::int64_t{high_key});
        left.advance(low, high);
        right.advance(low, high);
        low_key += philox_step_low;
        high_key += philox_step_high;
    }
    left.store(words);
    right.store(words + 4);
}

#endif

// The n blocks from the counter x on: that of x[0] + i at words[2 i] and words[2 i + 1].
template <std::size_t n>
[[nodiscard]] std::array<std::uint64_t, 2 * n> philox_blocks(const Counter& x, std::uint64_t key) noexcept {
    std::array<std::uint64_t, 2 * n> words;
    std::size_t i = 0;
#ifdef __SSE2__
    for (; i + 4 <= n; i += 4) four_blocks(x, static_cast<std::uint32_t>(i), key, &words[2 * i]);
#endif
    for (; i < n; ++i) {
        const Block block = philox({x[0] + static_cast<std::uint32_t>(i), x[1], x[2], x[3]}, key);
        words[2 * i] = block[0];
        words[2 * i + 1] = block[1];
    }
    return words;
}

}  // namespace zlg::chance
