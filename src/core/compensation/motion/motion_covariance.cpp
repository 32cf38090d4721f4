#include <zlg/core/compensation/border.hpp>
#include <zlg/core/compensation/optimal_bridge.hpp>

#include "smooth_prior.hpp"

namespace zlg::core {
namespace {

// The smooth prior counts as so many windows beside those in memory. For the fast memory 10 of 500, by trial on
// bench/accuracy; for the slow one just enough to keep the matrix regular, because beside a tone of 12 000 arcsec/s
// already a prior of 0.2 windows is as large as the rounding of a counter of 0.8 arcsec.
constexpr std::array<double, 2> prior_windows{10.0, 0.002};

// While the fast memory fills, its prior grows with it: by trial on first gaps 70 to 300 ticks after the start, where 10 of 50
// windows made errors 1.5 times and the claimed variance of a tone 10 times as large. The slow one's stays below the noise
// of readings by phase as it stays below that of counts.
constexpr double prior_windows_of(MotionMemory memory, double n, double noise_ratio) noexcept {
    constexpr double full = 500.0;
    if (memory == slow_memory) return prior_windows[memory] * noise_ratio;
    return prior_windows[memory] * (n < full ? n / full : 1.0);
}

constexpr auto smooth_prior_of_ticks = of_ticks(smooth_prior);

// Start of each row of the triangle, instead of a product and a halving for each element.
template <int window>
constexpr auto row_starts = [] {
    std::array<std::int16_t, static_cast<std::size_t>(window)> starts{};
    for (int a = 0; a < window; ++a)
        starts[static_cast<unsigned>(a)] = static_cast<std::int16_t>(moment_index(window, a, 0));
    return starts;
}();

}  // namespace

MotionCovariance::MotionCovariance(const CompensationConstants& gyro, const OptimalBridgeConfig& config,
                                   const MotionMomentsState& moments, MotionMemory memory, double scale,
                                   bool with_phase) noexcept
    : sum_{moments.moments[memory].sum.data()},
      row_{config.halves ? row_starts<max_window>.data() : row_starts<window_ticks>.data()},
      window_{window_of(MotionMomentsConfig{config.halves})},
      halves_{config.halves},
      shape_{config.halves ? (config.learns ? smooth_prior : config.prior_arcsec2).data()
                           : smooth_prior_of_ticks.data()} {
    if (!config.learns && !config.halves) {
        given_of_ticks_ = zlg::core::of_ticks(config.prior_arcsec2);
        shape_ = given_of_ticks_.data();
    }
    const double rounding = rounding_arcsec2(gyro, with_phase);
    const double n = moments.moments[memory].n_windows;
    // Rounding that repeats is predicted too well, which makes the scale small: the noise added for it is not scaled
    // down.
    double part = config.learns ? (scale > 1.0 ? scale : 1.0) * learnt_rounding_part : 1.0;
    // Moments that were learnt by phase hold no rounding to counts.
    const double without = config.learns && !with_phase ? moments.moments[memory].by_phase : 0.0;
    if (part < 1.0) part += (1.0 - part) * without;
    // (M + J M J)/2, over the number of windows.
    per_sum_ = config.learns && n > 0.0 ? 0.5 * scale / n : 0.0;
    if (config.learns)
        prior_ = per_sum_ * 2.0 *
                 prior_windows_of(memory, n, reading_counts2(gyro, with_phase) / reading_counts2(gyro, false)) *
                 moments.moments[memory].scatter;
    near_[0] = prior_ * shape_[0] + part * rounding;
    near_[1] = prior_ * shape_[1] - 0.5 * part * rounding;
    if (!config.learns) near_[0] += (halves_ ? 0.5 : 1.0) * walk_arcsec2(gyro);
}

// The four samples of a pair of ticks lie side by side, and so do those of the pair in reversed time.
double MotionCovariance::of_ticks(int a, int b) const noexcept {
    if (!halves_) return of_samples(a, b);
    if (a == b) return of_samples(2 * a, 2 * a) + of_samples(2 * a + 1, 2 * a + 1) + 2.0 * of_samples(2 * a, 2 * a + 1);
    const int low = 2 * (a < b ? a : b);
    const int high = 2 * (a < b ? b : a);
    const auto four = [this](int i, int j) {
        const double* const first = sum_ + row_[i] + j;
        const double* const second = sum_ + row_[i + 1] + j;
        return (first[0] + first[1]) + (second[0] + second[1]);
    };
    const int lag = high - low;
    return per_sum_ * (four(low, high) + four(window_ - 2 - high, window_ - 2 - low)) + 2.0 * by_lag(lag) +
           (by_lag(lag - 1) + by_lag(lag + 1));
}

}  // namespace zlg::core
