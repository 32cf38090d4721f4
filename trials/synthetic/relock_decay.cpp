#include "relock_decay.hpp"

#include <algorithm>
#include <cmath>

#include <zlg/core/common/maths.hpp>

namespace zlg::trials {
namespace {

double slewed(double t) {
    constexpr double slew = 0.28;
    constexpr double tail = 1.1;
    const double t_tail = (1.0 - slew * tail) / slew;
    return t < t_tail ? 1.0 - slew * t : slew * tail * core::maths::exp(-(t - t_tail) / tail);
}

double underdamped(double t) {
    constexpr double damping = 0.6;
    constexpr double natural = 1.0;
    const double ringing = natural * std::sqrt(1.0 - damping * damping);
    return core::maths::exp(-damping * natural * t) *
           (core::maths::cos(ringing * t) + damping * natural / ringing * core::maths::sin(ringing * t));
}

// Simpson's rule over a half, fine enough for the kinks of the laws: 1e-7 of the miss squared.
double mean_square(LoopShape shape, double start_ticks) {
    constexpr int pieces = 400;
    double sum = 0.0;
    for (int i = 0; i <= 2 * pieces; ++i) {
        const double weight = i == 0 || i == 2 * pieces ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
        const double dl = detuning_ratio(shape, start_ticks + 0.5 * i / (2.0 * pieces));
        sum += weight * dl * dl;
    }
    return sum / (6.0 * pieces);
}

}  // namespace

double detuning_ratio(LoopShape shape, double t) {
    switch (shape) {
        case LoopShape::exponential: return core::maths::exp(-t / 3.5);
        case LoopShape::slew: return slewed(t);
        case LoopShape::second_order: return (1.0 + t / 1.05) * core::maths::exp(-t / 1.05);
        case LoopShape::underdamped: return underdamped(t);
        case LoopShape::dead_time: return slewed(std::max(0.0, t - 0.6));
    }
    return 0.0;
}

const char* loop_name(LoopShape shape) {
    constexpr std::array names{"exponential", "slew and tail", "second order", "underdamped", "dead time"};
    return names[static_cast<std::size_t>(shape)];
}

std::vector<DecayHalf> relock_decay(LoopShape shape, int n_samples) {
    constexpr int halves = 80;
    std::vector<DecayHalf> decay(halves);
    for (std::size_t k = 0; k < decay.size(); ++k) {
        const double start = 0.5 * static_cast<double>(k);
        decay[k].mean_sq = mean_square(shape, start);
        for (int j = 0; j < n_samples; ++j)
            decay[k].samples.push_back(detuning_ratio(shape, start + 0.5 * (j + 0.5) / n_samples));
    }
    return decay;
}

}  // namespace zlg::trials
