#include "random_phase_motion.hpp"

#include <numbers>

#include <zlg/chance/address.hpp>
#include <zlg/core/common/maths_kernels.hpp>

namespace zlg::paper {
RandomPhaseMotion::RandomPhaseMotion(const SubstitutionExperiment& e, const SwitchGrid& grid)
    : grid_{grid},
      amplitude_arcsec_s_{e.amplitude_arcsec_s > 0.0 ? e.amplitude_arcsec_s : e.slow_rate_arcsec_s},
      frequency_hz_{e.amplitude_arcsec_s > 0.0 ? e.frequency_hz : 0.0} {
    for (int k = 0; k < grid.switches + 2; ++k) {
        const chance::Address of_switch{
            .seed = e.seed, .cause = chance::Cause::phase_at_switch, .half = static_cast<std::uint64_t>(k)};
        const double u = uniform(of_switch, 0);
        const auto [sine, cosine] = core::maths::sincos_turns_kernel(u);
        about_gap_.push_back(frequency_hz_ > 0.0 ? Quadratures{sine, cosine} : Quadratures{2.0 * u - 1.0, 0.0});
    }
}

// rate = A sin(w t + phase), t = 0 in the middle of the gap. Over a half h about t:
//
//   increment = A h sinc(w h/2) [sin phase cos(w t) + cos phase sin(w t)]
std::vector<double> RandomPhaseMotion::increments_arcsec() const {
    const double half_s = 0.5 * grid_.tick_s;
    const double turn = std::numbers::pi * frequency_hz_ * half_s;
    const double scale_arcsec = amplitude_arcsec_s_ * half_s * (turn > 0.0 ? core::maths::sin(turn) / turn : 1.0);
    const std::int64_t n_halves = 2 * grid_.ticks();
    std::vector<double> increments;
    increments.reserve(static_cast<std::size_t>(n_halves));
    for (std::int64_t half = 0; half < n_halves; ++half) {
        // The middle of gap k is the border of halves 2 k I + n; its stretch reaches half an interval to either side.
        const std::int64_t k = (half - grid_.n + grid_.interval_ticks) / (2 * grid_.interval_ticks);
        const std::int64_t from_middle = half - 2 * k * grid_.interval_ticks - grid_.n;
        const double angle = 2.0 * turn * (static_cast<double>(from_middle) + 0.5);
        const auto [sine, cosine] = core::maths::sincos(angle);
        increments.push_back(scale_arcsec * (at(k).sine * cosine + at(k).cosine * sine));
    }
    return increments;
}

}  // namespace zlg::paper
