#include "rest_start.hpp"

#include <cmath>
#include <limits>

namespace zlg::calibration {
namespace {

constexpr std::int64_t min_relocks = 4;
constexpr double noise_sigmas = 4.0;
constexpr double as_long_again = 1.5;
constexpr std::size_t tail_halves = 8;

std::vector<Moments> decay_of(const std::vector<Relock>& relocks) {
    std::vector<Moments> decay(relock_halves);
    for (const Relock& relock : relocks) {
        if (!is_whole(relock, &core::HalfRecord::detuning_lambda)) continue;
        const double sign = std::copysign(1.0, relock.halves.front().detuning_lambda);
        for (std::size_t h = 0; h < relock_halves; ++h) decay[h].add(sign * relock.halves[h].detuning_lambda);
    }
    return decay;
}

// Of a mean, from the last halves together: that of a few re-locks alone would be known too badly.
double noise_of(const std::vector<Moments>& decay) {
    double variance = 0.0;
    for (std::size_t h = relock_halves - tail_halves; h < relock_halves; ++h)
        variance += decay[h].variance() / static_cast<double>(tail_halves);
    return noise_sigmas * std::sqrt(variance / static_cast<double>(decay.front().n));
}

double mean_over(const std::vector<Moments>& decay, std::size_t from) {
    double sum = 0.0;
    for (std::size_t h = from; h < from + tail_halves; ++h) sum += std::abs(decay[h].mean);
    return sum / static_cast<double>(tail_halves);
}

// Until the tail of what was kept has fallen to noise: it decays as it did over the later half of it.
double beyond_kept_halves(const std::vector<Moments>& decay, double noise) {
    const std::size_t from = relock_halves / 2;
    const std::size_t to = relock_halves - tail_halves;
    const double folds = std::log(mean_over(decay, from) / mean_over(decay, to));
    if (!(folds > 0.0)) return std::numeric_limits<double>::infinity();
    const double to_noise = std::log(mean_over(decay, to) / noise);
    return std::fmax(0.0, to_noise) * static_cast<double>(to - from) / folds;
}

}  // namespace

double rest_after_ticks(const std::vector<Relock>& relocks) {
    constexpr auto least = static_cast<double>(settled_after_ticks);
    const std::vector<Moments> decay = decay_of(relocks);
    if (decay.front().n < min_relocks) return least;
    const double noise = noise_of(decay);
    std::size_t halves = relock_halves;
    while (halves > 0 && !(std::abs(decay[halves - 1].mean) > noise)) --halves;
    double until_halves = static_cast<double>(halves);
    if (halves + tail_halves > relock_halves) until_halves += beyond_kept_halves(decay, noise);
    return std::fmax(least, 0.5 * as_long_again * until_halves);
}

}  // namespace zlg::calibration
