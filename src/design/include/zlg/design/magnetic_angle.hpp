#pragma once
// The false angle that the magnetic drift leaves when the helicity alternates.
//
// The magnetic drift (5) takes the sign of the mode, so that segments between switches count +, -, +, -.
// Notation: Om0 magnetic drift at start, A its total thermal change, tau thermal time constant, L interval, D = d/dt.
// Angles and rates keep the signs of Om0 and A, both of which may be negative. All formulas are exact unless said
// otherwise.

#include <cstdint>
#include <span>
#include <vector>

#include <zlg/config/config.hpp>

namespace zlg::design {

using config::FirstSegment;  // `half`: the first segment lasts L/2, the sequence is A BB AA BB ...

struct GyroDrift {
    double nonmagnetic_arcsec_s = 0.05;
    double magnetic_arcsec_s = 0.7;          // Om0, at start
    double magnetic_thermal_arcsec_s = 0.7;  // A = A_qm A_T: what a full warm-up adds to Om0
    double thermal_time_s = 3000.0;          // tau, > 0
};

// errors  DesignError unless all members are finite and tau > 0. The functions below presume a gyro that passed.
void check(const GyroDrift& gyro);

//   Om(t) = A (1 - exp(-t/tau)) + Om0    eq (5)
//
// at_s  >= 0.
[[nodiscard]] double magnetic_rate_arcsec_s(const GyroDrift& gyro, double at_s);

// Integral of (5) between two instants, arcsec.
[[nodiscard]] double magnetic_integral_arcsec(const GyroDrift& gyro, double from_s, double to_s);

//   K[Om](t), linear in Om, with K[1] = L/2 and K[exp(-t/tau)] = tau tanh(L/2tau) exp(-t/tau)
// The kernel of plain alternation: the angle after n segments is S - (-1)^n K[Om](t), S from the start alone.
//
// interval_s  L > 0, any ratio to tau.
[[nodiscard]] double kernel_arcsec(const GyroDrift& gyro, double interval_s, double at_s);

//   K = L/2 - L^3 D^2/24 + O(L^5 D^4)
// The kernel to third order.
//
// accuracy  |A| L^5/(240 tau^4), for L < tau.
[[nodiscard]] double kernel_series_arcsec(const GyroDrift& gyro, double interval_s, double at_s);

//   S = K[Om](0)                                                  first segment full
//   S = int_0^{L/2} Om dt - K[Om](L/2) = -A tau tanh(L/2tau) tanh(L/4tau)    first segment half; about -A L^2/(8 tau)
// What the start leaves in the angle for good.
[[nodiscard]] double start_residue_arcsec(const GyroDrift& gyro, double interval_s, FirstSegment first);

//   S - (-1)^n K[Om](t),   t = n L (first segment full) or (n - 1/2) L (half)
// The angle at the end of segment n >= 1, just where the next switch begins. With a full first segment that is
// K(0) - K(t) after an even number of segments and K(0) + K(t) after an odd one.
[[nodiscard]] double angle_after_segments_arcsec(const GyroDrift& gyro, double interval_s, FirstSegment first,
                                                 std::int64_t n_segments);

// Lengths of the segments of a run: L or L/2, then L, the last one cut where the run ends.
//
// errors  DesignError unless 0 < interval_s, 0 < run_s, both finite, and there are at most 10^7 segments.
[[nodiscard]] std::vector<double> segments_s(double interval_s, FirstSegment first, double run_s);

// The angle at the end of any alternating sequence of segments: the plain sum of the integrals of (5), the first with
// sign +. It is the definition by which the closed forms above are judged.
//
// errors  DesignError for a segment that is negative or not finite.
[[nodiscard]] double end_error_arcsec(const GyroDrift& gyro, std::span<const double> segments_s);

}  // namespace zlg::design
