#include "error_signal.hpp"

namespace zlg::twin {

ErrorSignal::ErrorSignal(const LaserTable& table, double plateau_g)
    : averaged_{averaged_laser(table.exact(), plateau_g)} {
    const double per_signal = 1.0 / averaged_.discriminator_per_lambda;
    const auto signal = [&](double place) { return table.at(place, plateau_g).discriminator() * per_signal; };
    // One more than the lines have ends, for a place that rounds up to the last.
    for (std::size_t k = 0; k <= n_lines + 1; ++k) {
        value_.push_back(signal(static_cast<double>(k) / static_cast<double>(n_lines)));
    }
    constexpr double step_lambda = 1e-4;
    constexpr double bend = 2e-4;
    const auto is_straight = [&](double x) {
        return std::abs(signal(averaged_.settled_lambda + x) - x) <= bend * std::abs(x);
    };
    for (int k = 1; k * step_lambda < 0.24 && is_straight(k * step_lambda) && is_straight(-k * step_lambda); ++k) {
        straight_lambda_ = k * step_lambda;
    }
}

}  // namespace zlg::twin
