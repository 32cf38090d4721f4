#pragma once
// A record of any length in bounded memory.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace zlg::live {

// Every stride-th value, from the first on; the stride is doubled whenever `capacity` of them are kept.
template <class Value, std::size_t capacity>
class Thinned {
public:
    void add(const Value& value) {
        const bool is_kept = n_ % stride_ == 0;
        ++n_;
        if (!is_kept) return;
        if (kept_.size() == capacity) {
            for (std::size_t k = 0; 2 * k < capacity; ++k) kept_[k] = kept_[2 * k];
            kept_.resize((capacity + 1) / 2);
            stride_ *= 2;
            if ((n_ - 1) % stride_ != 0) return;
        }
        kept_.push_back(value);
    }

    [[nodiscard]] const std::vector<Value>& kept() const { return kept_; }
    [[nodiscard]] std::int64_t stride() const { return stride_; }

private:
    std::vector<Value> kept_;
    std::int64_t stride_ = 1;
    std::int64_t n_ = 0;
};

}  // namespace zlg::live
