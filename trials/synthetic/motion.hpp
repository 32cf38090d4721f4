#pragma once
// Rotation in exact increments over half-periods: the integral of the rate, not samples of it.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <zlg/chance/draw.hpp>

#include "laws.hpp"

namespace zlg::trials {

// Enough that one run has nearly the flat spectrum of its band, few enough to be fast.
inline constexpr int tones_per_band = 96;

class SyntheticMotion {
public:
    SyntheticMotion(const MotionLaw& law, double half_s, const chance::Draw& draw);

    // Rotation in the next half, arcsec.
    double advance();

private:
    void add_tone(double frequency_hz, double amplitude_arcsec_s, double phase);
    void add_band(const Band& band);
    double advance_tones();
    double advance_shocks();

    chance::Draw draw_;
    double half_s_;
    double constant_arcsec_;
    // Each tone is a phasor that turns by a fixed angle a half: its increment is the imaginary part.
    std::vector<double> re_, im_, turn_re_, turn_im_;
    Shocks shocks_;
    std::array<double, 2> ring_{};  // all shocks together, as one decaying phasor: rate in arcsec/s is the second
    double next_shock_s_ = 0.0;     // from the start of the next half
};

// Covariance of the increments of two halves that lie 0, 1, ... n - 1 apart; the constant rate is not in it.
//
// The expectation of the law itself: a band is integrated, not summed over the tones that stand for it.
[[nodiscard]] std::vector<double> increment_covariance(const MotionLaw& law, double half_s, std::size_t n);

}  // namespace zlg::trials
