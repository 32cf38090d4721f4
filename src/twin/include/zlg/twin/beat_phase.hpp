#pragma once
// Phase of the beat of two counter-propagating waves with backscatter, stepped exactly.
//
//   psi' = 2 pi [f(t) - Im(C exp(i psi))]                    Adler's equation
//
// With u = exp(i psi/2) it is the linear system u' = i pi f u + pi conj(C) conj(u): a Moebius map of exp(i psi), which
// for a constant drive f has a closed form, and for a linear one a product of few factors (Magnus, fourth order).

#include <complex>
#include <cstdint>

namespace zlg::twin {

// An angle as whole turns and a part, so that a month of turns is rounded no coarser than the first second.
struct Turns {
    std::int64_t whole = 0;  // wraps
    double part = 0.0;       // in [0, 1)

    // |turns| < 4.6e18; not checked.
    void add(double turns);
    // Exact while the difference is small, whatever the turns themselves are.
    [[nodiscard]] double minus(const Turns& other) const;
    [[nodiscard]] double part_rad() const;
};

// C of Adler's equation [Hz]: its size is the rate at which the beat locks, its angle the place where it does.
using Coupling = std::complex<double>;

// What the mirrors scatter back, as c r/(2 pi L) [Hz] for either direction.
//
//   C = [first sqrt(I1/I2) exp(-i eps) + second sqrt(I2/I1) exp(i eps)] exp(i origin)
struct Backscatter {
    double first_hz = 75.0;
    double second_hz = 75.0;
    double eps_rad = 0.0;
    double origin_rad = 0.0;  // where the beat locks

    // Equal mirrors that lock at `lock_hz` when the waves are equal; more by (I1 + I2)/(2 sqrt(I1 I2)) when not.
    [[nodiscard]] static Backscatter equal(double lock_hz, double origin_rad);
    // intensities  > 0, any common unit.
    [[nodiscard]] Coupling coupling(double intensity_1, double intensity_2) const;
};

class BeatPhase {
public:
    explicit BeatPhase(const Turns& start = {}) : psi_{start} {}

    [[nodiscard]] const Turns& value() const { return psi_; }

    // Moved at once.
    void kick(double turns) { psi_.add(turns); }

    // Constant drive, in closed form: beating (|f| > |C|), locked (|f| < |C|) and between.
    //
    // errors  std::overflow_error where |drive_hz duration_s| is not below 1e18.
    // cost    about 60 ns.
    void plateau(double drive_hz, Coupling coupling, double duration_s);

    // Drive that goes linearly from start_hz to end_hz, in `ramp_pieces` factors.
    //
    // accuracy  1e-5 rad; 2e-6 on a reversal of +-60 kHz in 50 us. Near an unstable phase inside lock-in it grows with
    //           time as any difference of phases does, by exp(2 pi |C| t).
    // errors    std::overflow_error where |turns| is not below 1e18, or the pieces would be more than 1e7.
    // cost      about 0.2 us for a reversal; grows with the turns where the drive is not small.
    void ramp(double start_hz, double end_hz, Coupling coupling, double duration_s);

    // The same in a number of pieces that the caller answers for. The error falls with its fourth power.
    void ramp_in_pieces(double start_hz, double end_hz, Coupling coupling, double duration_s, int pieces);

    // Drive that goes linearly from start_hz to end_hz: by `plateau` at its mean where that errs by less than 1e-6 rad
    // (a drive that hardly changes, far from lock-in), otherwise by `ramp`.
    void advance(double start_hz, double end_hz, Coupling coupling, double duration_s);

private:
    Turns psi_;
};

// How many pieces keep the error of a ramp near 1e-6 rad: 16 for a reversal of +-60 kHz in 50 us that locks at 300 Hz.
[[nodiscard]] double ramp_pieces(double start_hz, double end_hz, double lock_hz, double duration_s);

}  // namespace zlg::twin
