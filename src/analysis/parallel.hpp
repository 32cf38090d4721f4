#pragma once
// Independent pieces of work on a few threads.

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace zlg::analysis {

// work(0) ... work(n - 1), each once, in any order; it must not throw.
template <class Work>
void in_parallel(std::int64_t n, int threads, const Work& work) {
    std::atomic<std::int64_t> next{0};
    const auto take = [&] {
        for (std::int64_t k = next++; k < n; k = next++) work(k);
    };
    std::vector<std::jthread> others;
    for (std::int64_t k = 1; k < std::min<std::int64_t>(threads, n); ++k) others.emplace_back(take);
    take();
}

}  // namespace zlg::analysis
