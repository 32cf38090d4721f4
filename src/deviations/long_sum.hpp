#pragma once
// A sum of any length that is right to the last bit or two.

#include <cmath>

namespace zlg::deviations {

// A. Neumaier, ZAMM 54 (1974) 39: what an addition rounds off is kept beside the sum.
class LongSum {
public:
    void add(double value) {
        const double next = sum_ + value;
        lost_ += std::abs(sum_) >= std::abs(value) ? (sum_ - next) + value : (value - next) + sum_;
        sum_ = next;
    }
    [[nodiscard]] double value() const { return sum_ + lost_; }

private:
    double sum_ = 0.0;
    double lost_ = 0.0;
};

}  // namespace zlg::deviations
