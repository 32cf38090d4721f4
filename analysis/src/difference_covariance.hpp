#pragma once
// How the terms of a deviation are correlated, for rate noise f^noise.

#include <cstdint>
#include <vector>

namespace zlg::analysis {

// Covariances of the d-th differences at distance m of the angle, or of the angle averaged over m, up to a common factor.
//
// Up to m = 64 of the sampled law |2 sin(pi f)|^noise; beyond, where sampling makes no difference but to flicker of the angle,
// of the continuous one.
class DifferenceCovariance {
public:
    // noise  2 .. -4 with noise + 2 d > 1; d: 2 or 3.
    DifferenceCovariance(int noise, int d, bool is_averaged, std::int64_t m);

    // Steps into which one averaging time is divided: m, or fewer where the correlation is smooth.
    [[nodiscard]] std::int64_t steps() const { return steps_; }
    // At `lag` steps.
    [[nodiscard]] double operator()(std::int64_t lag) const;

private:
    [[nodiscard]] double angle(std::int64_t lag) const;

    int noise_, d_;
    bool is_averaged_, is_sampled_;
    std::int64_t steps_;
    std::vector<double> sampled_;  // covariance of the angle, or of its running sum where the angle is averaged
};

}  // namespace zlg::analysis
