#include "repeated_stretch.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>

namespace zlg::acceptance {
namespace {

// Of a stretch that repeats by no chance, by how often two values are equal that are up to 16 samples apart.
double telling_length(const std::vector<double>& values) {
    constexpr double shortest = 256.0, of_counts = 4096.0, rare = 20.7;  // -log(1e-9)
    constexpr std::size_t farthest = 16;
    const auto n = static_cast<double>(values.size());
    double equal = 0.0;
    for (std::size_t k = farthest; k < values.size(); ++k)
        for (std::size_t apart = 1; apart <= farthest; ++apart) equal += values[k] == values[k - apart] ? 1.0 : 0.0;
    if (equal == 0.0) return shortest;
    return std::max(of_counts, std::ceil(2.0 * (2.0 * std::log(n) + rare) / std::log(farthest * n / equal)));
}

std::uint64_t bits_of(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value) * 0x9e3779b97f4a7c15u;
    return bits ^ (bits >> 32);
}

}  // namespace

// A rolling sum over every stretch is looked up among those at whole lengths before it (Karp and Rabin, 1987).
std::string repeated_stretch(std::span<const double> values) {
    constexpr std::uint64_t base = 0xd1342543de82ef95u;
    std::vector<double> known;
    std::vector<std::size_t> rows;
    for (std::size_t k = 0; k < values.size(); ++k)
        if (std::isfinite(values[k])) known.push_back(values[k]), rows.push_back(k + 1);
    const double least = telling_length(known);
    if (!(2.0 * least < static_cast<double>(known.size()))) return {};
    const auto length = static_cast<std::size_t>(least);
    const auto at = [&known](std::size_t k) { return known.begin() + static_cast<std::ptrdiff_t>(k); };
    std::uint64_t sum = 0, highest = 1;
    for (std::size_t k = 1; k < length; ++k) highest *= base;
    for (std::size_t k = 0; k + 1 < length; ++k) sum = sum * base + bits_of(known[k]);
    std::unordered_map<std::uint64_t, std::size_t> whole;
    for (std::size_t k = 0; k + length <= known.size(); ++k) {
        sum = sum * base + bits_of(known[k + length - 1]);
        const auto found = whole.find(sum);
        if (found != whole.end() && found->second + length <= k &&
            std::equal(at(k), at(k + length), at(found->second)) &&
            std::adjacent_find(at(k), at(k + length), std::not_equal_to{}) != at(k + length)) {
            std::size_t from = k, to = k + length;
            const std::size_t apart = k - found->second;
            while (from > apart && known[from - 1] == known[from - 1 - apart]) --from;
            while (to < known.size() && known[to] == known[to - apart]) ++to;
            return fmt::format("samples {} to {} are those from {} on once more", rows[from], rows[to - 1],
                               rows[from - apart]);
        }
        if (k % length == 0) whole.emplace(sum, k);
        sum -= highest * bits_of(known[k]);
    }
    return {};
}

}  // namespace zlg::acceptance
