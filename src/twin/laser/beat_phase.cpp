#include <zlg/twin/beat_phase.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include <zlg/core/common/maths.hpp>

namespace zlg::twin {
namespace {

using std::numbers::pi;

// cos(sqrt x) and sin(sqrt x)/sqrt x, also for x < 0, where they are hyperbolic. accuracy 3e-13 for |x| < 0.6
struct Wave {
    double cosine;
    double sine_over_root;
};

inline Wave wave(double x) {
    constexpr double c1 = -1.0 / 2, c2 = 1.0 / 24, c3 = -1.0 / 720, c4 = 1.0 / 40320, c5 = -1.0 / 3628800,
                     c6 = 1.0 / 479001600;
    constexpr double s1 = -1.0 / 6, s2 = 1.0 / 120, s3 = -1.0 / 5040, s4 = 1.0 / 362880, s5 = -1.0 / 39916800,
                     s6 = 1.0 / 6227020800;
    return {1.0 + x * (c1 + x * (c2 + x * (c3 + x * (c4 + x * (c5 + x * c6))))),
            1.0 + x * (s1 + x * (s2 + x * (s3 + x * (s4 + x * (s5 + x * s6)))))};
}

// std::abs guards against overflow at ten times the cost.
double size_of(Coupling c) { return std::sqrt(std::norm(c)); }

// Im(conj(C) exp(-i psi)) = -Im(C exp(i psi)), and the real part beside it.
struct Pull {
    double re, im;
};

Pull pull_at(const Turns& psi, Coupling c) {
    const double cosine = core::maths::cos(psi.part_rad());
    const double sine = core::maths::sin(psi.part_rad());
    return {c.real() * cosine - c.imag() * sine, -(c.real() * sine + c.imag() * cosine)};
}

// The drive outruns the coupling: the phase never turns back, and each turn takes 1/k.
double beating_turns(double drive_hz, double k_hz, double duration_s, Pull pull) {
    const double total = k_hz * duration_s;
    const double whole = std::floor(total);
    const double rest = pi * (total - whole);
    const double per_k = core::maths::sin(rest) / k_hz;
    const double forward = std::copysign(1.0, drive_hz);
    // Less than a turn is left, forward: rounding must not turn it into one backward.
    const double im = std::max(0.0, forward * per_k * (drive_hz + pull.im));
    const double re = core::maths::cos(rest) + per_k * pull.re;
    return forward * (whole + core::maths::atan2(im, re) / pi);
}

// The coupling holds the phase: it moves to the locked place by less than a turn.
double locked_turns(double drive_hz, double kappa_hz, double duration_s, Pull pull) {
    const double x = pi * kappa_hz * duration_s;
    const double per_kappa = x < 1e-8 ? pi * duration_s : core::maths::tanh(x) / kappa_hz;
    return core::maths::atan2(per_kappa * (drive_hz + pull.im), 1.0 + per_kappa * pull.re) / pi;
}

// exp of the generator of one piece, applied to u.
//
//   G = [[i d, o], [conj o, -i d]],  d = pi f h,  o = pi h conj(C) (1 + i pi f' h^2/6)
struct Spinor {
    double re, im;
};

inline Spinor apply(double d, double o_re, double o_im, Spinor u) {
    const Wave w = wave(d * d - o_re * o_re - o_im * o_im);
    const double ds = w.sine_over_root * d;
    const double a = w.sine_over_root * o_re;
    const double b = w.sine_over_root * o_im;
    return {w.cosine * u.re - ds * u.im + a * u.re + b * u.im, w.cosine * u.im + ds * u.re + b * u.re - a * u.im};
}

void check_span(double turns) {
    if (!(std::abs(turns) < 1e18)) {
        throw std::overflow_error(fmt::format("beat phase: {} turns in one step, allowed is |turns| < 1e18", turns));
    }
}

}  // namespace

void Turns::add(double turns) {
    const double floor = std::floor(turns);
    whole = static_cast<std::int64_t>(static_cast<std::uint64_t>(whole) +
                                      static_cast<std::uint64_t>(static_cast<std::int64_t>(floor)));
    part += turns - floor;
    if (part >= 1.0) {
        part -= 1.0;
        whole = static_cast<std::int64_t>(static_cast<std::uint64_t>(whole) + 1u);
    }
}

double Turns::minus(const Turns& other) const {
    const auto difference =
        static_cast<std::int64_t>(static_cast<std::uint64_t>(whole) - static_cast<std::uint64_t>(other.whole));
    return static_cast<double>(difference) + (part - other.part);
}

double Turns::part_rad() const { return 2.0 * pi * part; }

Backscatter Backscatter::equal(double lock_hz, double origin_rad) {
    return {0.5 * lock_hz, 0.5 * lock_hz, 0.0, origin_rad};
}

Coupling Backscatter::coupling(double intensity_1, double intensity_2) const {
    const double root = std::sqrt(intensity_1 / intensity_2);
    const core::maths::SinCos first = core::maths::sincos(origin_rad - eps_rad);
    const core::maths::SinCos second = core::maths::sincos(origin_rad + eps_rad);
    const double size_1 = first_hz * root;
    const double size_2 = second_hz / root;
    return {size_1 * first.cos + size_2 * second.cos, size_1 * first.sin + size_2 * second.sin};
}

void BeatPhase::plateau(double drive_hz, Coupling coupling, double duration_s) {
    const double lock_hz = size_of(coupling);
    check_span((std::abs(drive_hz) + lock_hz) * duration_s);
    const double square = (drive_hz - lock_hz) * (drive_hz + lock_hz);
    const Pull pull = pull_at(psi_, coupling);
    psi_.add(square > 0.0 ? beating_turns(drive_hz, std::sqrt(square), duration_s, pull)
                          : locked_turns(drive_hz, std::sqrt(-square), duration_s, pull));
}

// A piece errs at the rate h^4 |w'| w^2 w_L/720, w = 2 pi f, but turning with the beat: what is left of it over the
// ramp is its value at the end over w,
//
//   t^4 |w'| max(w, w_L) w_L/(720 n^4)
//
// Where the coupling holds the beat back it adds up instead, by up to w_L t. No piece may turn by more than 1.5 rad,
// which keeps the expansion convergent and the series of `wave` short.
double ramp_pieces(double start_hz, double end_hz, double lock_hz, double duration_s) {
    constexpr double tolerance_rad = 1.5e-6;
    constexpr double max_turn_rad = 1.5;
    const double largest = 2.0 * pi * duration_s * std::max({std::abs(start_hz), std::abs(end_hz), lock_hz});
    const double change = 2.0 * pi * duration_s * std::abs(end_hz - start_hz);
    const double lock = 2.0 * pi * duration_s * lock_hz;
    const double by_error =
        std::sqrt(std::sqrt(change * largest * lock * std::max(1.0, lock) / (720.0 * tolerance_rad)));
    return std::ceil(std::max({4.0, by_error, largest / max_turn_rad}));
}

void BeatPhase::ramp(double start_hz, double end_hz, Coupling coupling, double duration_s) {
    const double lock_hz = size_of(coupling);
    check_span((std::abs(start_hz) + std::abs(end_hz) + lock_hz) * duration_s);
    const double pieces = ramp_pieces(start_hz, end_hz, lock_hz, duration_s);
    if (!(pieces <= 1e7)) {
        throw std::overflow_error(
            fmt::format("beat phase: drive from {} to {} Hz in {} s needs {} pieces, allowed are 1e7", start_hz, end_hz,
                        duration_s, pieces));
    }
    // The turns are found to within one from the drive alone, so the coupling must not pull by more than half of one.
    const int stretches = static_cast<int>(std::ceil(2.0 * lock_hz * duration_s)) | 1;
    const double stretch_s = duration_s / stretches;
    const double change_hz = (end_hz - start_hz) / stretches;
    const int pieces_each = static_cast<int>(std::ceil(pieces / stretches));
    for (int i = 0; i < stretches; ++i) {
        ramp_in_pieces(start_hz + i * change_hz, start_hz + (i + 1) * change_hz, coupling, stretch_s, pieces_each);
    }
}

void BeatPhase::ramp_in_pieces(double start_hz, double end_hz, Coupling coupling, double duration_s, int pieces) {
    const double h = duration_s / pieces;
    const double change = pi * h * (end_hz - start_hz) / pieces;  // of d from piece to piece
    const double tilt = change / 6.0;                             // pi f' h^2/6
    const double o_re = pi * h * (coupling.real() + tilt * coupling.imag());
    const double o_im = pi * h * (tilt * coupling.real() - coupling.imag());
    const Spinor start{core::maths::cos(pi * psi_.part), core::maths::sin(pi * psi_.part)};
    Spinor u = start;
    const double first = pi * h * start_hz + 0.5 * change;
    for (int i = 0; i < pieces; ++i) u = apply(first + i * change, o_re, o_im, u);

    // u knows the phase up to two turns; the drive alone says which.
    const double turned = core::maths::atan2(u.im * start.re - u.re * start.im, u.re * start.re + u.im * start.im) / pi;
    const double free = 0.5 * (start_hz + end_hz) * duration_s;
    psi_.add(turned + 2.0 * std::round(0.5 * (free - turned)));
}

void BeatPhase::advance(double start_hz, double end_hz, Coupling coupling, double duration_s) {
    const double smallest = start_hz * end_hz > 0.0 ? std::min(std::abs(start_hz), std::abs(end_hz)) : 0.0;
    const double lock_hz = size_of(coupling);
    // At the mean drive the ends of the stretch ripple by lock/f too little or too much.
    constexpr double tolerance_rad = 1e-6;
    const bool steady = lock_hz * std::abs(end_hz - start_hz) <= tolerance_rad * smallest * smallest;
    if (steady) {
        plateau(0.5 * (start_hz + end_hz), coupling, duration_s);
    } else {
        ramp(start_hz, end_hz, coupling, duration_s);
    }
}

}  // namespace zlg::twin
