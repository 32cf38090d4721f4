#include <zlg/numeric/parallel.hpp>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace zlg::numeric {

void in_parallel(std::size_t n, int threads, const std::function<void(std::size_t)>& work) {
    std::atomic<std::size_t> next{0};
    std::atomic<bool> failed{false};
    std::mutex failing;
    std::size_t first_failure = n;
    std::exception_ptr failure;
    const auto run = [&] {
        while (!failed) {
            const std::size_t k = next++;
            if (k >= n) return;
            try {
                work(k);
            } catch (...) {
                const std::scoped_lock lock{failing};
                failed = true;
                if (k < first_failure) {
                    first_failure = k;
                    failure = std::current_exception();
                }
            }
        }
    };
    {
        std::vector<std::jthread> others;
        for (std::size_t k = 1; k < n && k < static_cast<std::size_t>(std::max(threads, 1)); ++k)
            others.emplace_back(run);
        run();
    }
    if (failure) std::rethrow_exception(failure);
}

}  // namespace zlg::numeric
