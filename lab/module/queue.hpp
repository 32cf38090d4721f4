#pragma once
// A queue in a vector: what is small in WebAssembly, where std::deque takes three kilobytes for each type.

#include <cstddef>
#include <utility>
#include <vector>

namespace zlg::lab {

template <class T> class Queue {
public:
    [[nodiscard]] bool empty() const { return first_ == items_.size(); }
    void push_back(const T& item) { items_.push_back(item); }

    // The queue must not be empty. The place is used again once the queue has been empty, or is mostly behind us.
    T take_front() {
        T item = std::move(items_[first_++]);
        if (first_ == items_.size() || first_ >= longest_past) {
            items_.erase(items_.begin(), items_.begin() + static_cast<std::ptrdiff_t>(first_));
            first_ = 0;
        }
        return item;
    }

private:
    static constexpr std::size_t longest_past = 64;

    std::vector<T> items_;
    std::size_t first_ = 0;
};

}  // namespace zlg::lab
