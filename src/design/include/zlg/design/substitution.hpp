#pragma once
// Substitution of the ticks lost in a mode switch, eqs (14)-(18): its weights, and its exact error on sinusoidal
// motion.
//
// Ticks j = 1..n are lost. P_j is the INTEGRAL of the rate over tick j, not a sample of it. A polynomial of least
// squares through the points x_k gives for one tick, and for the whole gap,
//
//   P^_j = sum_k w_k(j) P(x_k),    S^ = sum_k W_k P(x_k),    W_k = sum_j w_k(j)
//
// extrapolation (14): x_k = -(e-1)..0.  interpolation (15): x_k = -(b-1)..0 and n+1..n+a.
// The error (18) that stays in the angle is S^ - sum_j P_j of the interpolation, whatever was extrapolated before.
//
// All functions throw DesignError for n outside 1..64, an order outside 0..4, more than 64 points on a side, no more
// points than the order, a tick_s that is not positive, numbers that are not finite.

#include <complex>
#include <span>
#include <vector>

namespace zlg::design {

struct Points {
    int extrapolation = 4;
    int before = 2;
    int after = 2;
};

enum class Fit { extrapolation, interpolation };

struct Substitution {
    Fit fit = Fit::interpolation;
    int order = 2;
    int n = 3;  // ticks lost
    Points points{};
    double tick_s = 0.005;
};

// Where the points lie, in ticks, ascending.
[[nodiscard]] std::vector<int> positions(const Substitution& substitution);

// W_k, in the order of positions().
//
// accuracy  1e-13 of the largest weight (orthogonal polynomials in extended precision).
[[nodiscard]] std::vector<double> sum_weights(const Substitution& substitution);

// One oscillation of the case: rate = amplitude * sin(2 pi frequency t + phase), t = 0 in the middle of the gap.
struct Tone {
    double amplitude_arcsec_s = 0.0;  // finite
    double frequency_hz = 0.0;        // >= 0, finite; not limited to half the tick rate
};

// How the error answers to an oscillation of the rate:
//
//   H(f) = T sinc(pi f T) [ sum_k W_k e^(i w (x_k - c) T) - sum_j e^(i w (j - c) T) ],   w = 2 pi f, c = (n + 1)/2
//   error = A Im(H e^(i phase))                                             [s; times arcsec/s gives arcsec]
//
// With points symmetric about the gap H is real, so the error is 0 where a zero crossing of the rate lies in the middle
// of the gap, and worst where an extremum does.
class ErrorResponse {
public:
    explicit ErrorResponse(const Substitution& substitution);

    [[nodiscard]] std::complex<double> operator()(double frequency_hz) const;

    // Ticks from the first to the last that the error looks at: H varies over 1/(span T).
    [[nodiscard]] double span_ticks() const;
    [[nodiscard]] double tick_s() const { return tick_s_; }

private:
    void add(const std::vector<double>& weights, const std::vector<int>& at);

    double tick_s_ = 0.0;
    double middle_ticks_ = 0.0;
    std::vector<double> offset_ticks_;  // from the middle of the gap; the lost ticks are points of weight -1
    std::vector<double> weight_;
};

struct WorstPhase {
    double error_arcsec = 0.0;  // >= 0
    double phase_rad = 0.0;  // of the rate in the middle of the gap, at which the error is +error_arcsec; in (-pi, pi]
};

// A |H| and where: pi/2 - arg H.
[[nodiscard]] WorstPhase worst(const ErrorResponse& response, const Tone& tone);

// Random phase: A |H| / sqrt 2.
[[nodiscard]] double rms_arcsec(const ErrorResponse& response, const Tone& tone);

// A sum of oscillations: the sum of the worst errors, which is a bound that is reached when the frequencies are
// incommensurate; and the root of the sum of squares, exact for independent random phases.
[[nodiscard]] double worst_bound_arcsec(const ErrorResponse& response, std::span<const Tone> tones);
[[nodiscard]] double rms_arcsec(const ErrorResponse& response, std::span<const Tone> tones);

}  // namespace zlg::design
