#include <zlg/core/compensation/optimal_bridge.hpp>

#include "smooth_prior.hpp"

namespace zlg::core {
namespace {

// The prior counts as so many windows beside those in memory: for the slow one as little as keeps the matrix regular, since
// a tone of 12 000 arcsec/s brings a prior of 0.2 windows to the level of a counter of 0.8 arcsec.
constexpr std::array<double, 2> prior_windows{10.0, 0.002};

constexpr auto smooth_prior_of_ticks = of_ticks(smooth_prior);

// A product and a halving for each element otherwise.
template <int window>
constexpr auto row_starts = [] {
    std::array<std::int16_t, static_cast<std::size_t>(window)> starts{};
    for (int a = 0; a < window; ++a)
        starts[static_cast<unsigned>(a)] = static_cast<std::int16_t>(moment_index(window, a, 0));
    return starts;
}();

}  // namespace

MotionCovariance::MotionCovariance(const OptimalBridgeConfig& config, const MotionMomentsState& moments,
                                   MotionMemory memory, double scale) noexcept
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
    const double rounding = config.counter_step.value() * config.counter_step.value() / 6.0;
    const double n = moments.moments[memory].n_windows;
    // Readings that repeat are predicted all too well: rounding is not what may be scaled down.
    const double part = config.learns ? (scale > 1.0 ? scale : 1.0) * learnt_rounding_part : 1.0;
    // Of moments in both directions of time.
    per_sum_ = config.learns && n > 0.0 ? 0.5 * scale / n : 0.0;
    if (config.learns) prior_ = per_sum_ * 2.0 * prior_windows[memory] * moments.moments[memory].scatter;
    near_[0] = prior_ * shape_[0] + part * rounding;
    near_[1] = prior_ * shape_[1] - 0.5 * part * rounding;
    if (!config.learns) near_[0] += halves_ ? 0.5 * config.walk_arcsec2 : config.walk_arcsec2;
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
