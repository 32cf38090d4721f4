#pragma once
// Independent pieces of work on a few threads.

#include <cstddef>
#include <functional>

namespace zlg::numeric {

// work(0) ... work(n - 1), each once, begun in this order, on `threads` threads of which the caller's is one.
//
// After a piece that throws no other is begun; those already begun are finished, and the exception of the lowest index
// is thrown again. Everything below that index has been done, so it is the same exception on any number of threads.
void in_parallel(std::size_t n, int threads, const std::function<void(std::size_t)>& work);

}  // namespace zlg::numeric
