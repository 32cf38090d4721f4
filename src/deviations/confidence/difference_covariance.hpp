#pragma once
// How the terms of a deviation are correlated, for rate noise f^noise.

#include <cstdint>
#include <vector>

namespace zlg::deviations {

// Variogram of flicker, spectrum |2 sin(pi f)|^-1: 2/pi times the sum of 1/(2k - 1).
[[nodiscard]] double flicker_covariance(std::int64_t lag);

// Generalised autocovariance at lags 0 .. n of the angle, spectrum |2 sin(pi f)|^(noise - 2). That of a running sum has
// the given one as its negative second difference.
[[nodiscard]] std::vector<double> sampled_covariance(int noise, std::int64_t n);

// Of the continuous law, t in averaging times; angle averaged twice for `noise`, so of the angle itself it is that of
// noise + 2. C. Greenhall, W. Riley (PTTI 2003), s_w.
[[nodiscard]] double continuous_covariance(double t, int noise);

// Covariances of the d-th differences at distance m of the angle, or of the angle averaged over m, up to a common
// factor.
//
// Up to m = 64 of the sampled law |2 sin(pi f)|^noise; beyond, where sampling makes no difference but to flicker of the
// angle, of the continuous one.
class DifferenceCovariance {
public:
    // noise  2 .. -4 with noise + 2 d > 1; d: 2 or 3.
    // reach  averaging times up to which lags will be asked for.
    DifferenceCovariance(int noise, int d, bool is_averaged, std::int64_t m, std::int64_t reach);
    DifferenceCovariance(int noise, int d, bool is_averaged, std::int64_t m)
        : DifferenceCovariance(noise, d, is_averaged, m, d + 1) {}

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

}  // namespace zlg::deviations
