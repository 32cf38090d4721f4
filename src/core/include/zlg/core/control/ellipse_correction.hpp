#pragma once
// The phase of a fringe from two photodiodes: correction of their ellipse, learnt from the fringes that pass.
//
//   c = c_0 + a cos p,  s = s_0 + b sin(p + e)                                                           (1)
//
// Offsets, amplitudes and the angle e between the photodiodes make an ellipse of the circle. It is fitted to the
// samples by least squares of
//
//   A c^2 + B c s + C s^2 + D c + E s = 1                                                                (2)
//
// and mapped back to the circle. Only where the phases cover the circle is the fit well conditioned: a block takes up
// to `samples_a_bin` samples of each octant and of each sign of the beat, and is used when it has all of them. At rest,
// where the same phases come again and again, nothing is learnt. Blocks are added to a memory that forgets a quarter
// each time.
//
// Source: Heydemann, Appl. Opt. 20 (1981) 3382.

#include <array>
#include <cstdint>

namespace zlg::core {

struct QuadratureSample {
    double c = 0.0;
    double s = 0.0;
};

// Of (1): cos p = cc (c - c_0), sin p = sc (c - c_0) + ss (s - s_0).
struct EllipseMap {
    double c0 = 0.0;
    double s0 = 0.0;
    double cc = 1.0;
    double sc = 0.0;
    double ss = 1.0;

    friend constexpr bool operator==(const EllipseMap&, const EllipseMap&) = default;
};

[[nodiscard]] constexpr QuadratureSample on_circle(const EllipseMap& m, const QuadratureSample& x) noexcept {
    const double c = x.c - m.c0;
    return {m.cc * c, m.sc * c + m.ss * (x.s - m.s0)};
}

inline constexpr std::int32_t samples_a_bin = 8;
inline constexpr std::int32_t ellipse_bins = 16;  // octants of either sign

// Sums of c^i s^j over samples, i + j <= 4.
using PowerSums = std::array<double, 15>;

struct EllipseCorrectionState {
    bool learnt = false;
    EllipseMap map{};          // until it is learnt: the circle of amplitude 1
    double noise_turns = 0.0;  // quality of the last fit: scatter of the radius, as noise of the phase, rms
    PowerSums memory{};
    PowerSums block{};
    std::array<std::int8_t, ellipse_bins> in_bin{};
    std::int32_t n_full = 0;    // bins
    std::int32_t n_halves = 0;  // since the block began

    friend constexpr bool operator==(const EllipseCorrectionState&, const EllipseCorrectionState&) = default;
};

struct EllipseLearning {
    bool taken = false;      // into the block
    bool is_first = false;   // of a block, the one before is used or given up
    bool completes = false;  // the block, and a new ellipse is known, or none
};

// Learn from the sample of one half.
//
// sample  in amplitudes as they are presumed: offsets up to 0.5 and axes of 0.5..2 are an ellipse, all else is not.
// sign    of the beat in the half that ended.
EllipseLearning learn(EllipseCorrectionState& state, const QuadratureSample& sample, int sign) noexcept;

// The photodiodes are no longer what was learnt: all begins anew.
void forget(EllipseCorrectionState& state) noexcept;

}  // namespace zlg::core
