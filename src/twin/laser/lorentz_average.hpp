#pragma once
// Lorentzians averaged over the Maxwell distribution of velocities.
//
// A velocity is given by its Doppler shift in units of ku, where the distribution exp(-v^2)/sqrt(pi) falls to 1/e; a
// Lorentzian L_c(v) = y^2/(y^2 + (v - c)^2) burns its hole at v = c. All averages follow from w(c + i y).

#include <complex>
#include <numbers>

#include "faddeeva.hpp"

namespace zlg::twin {

// The hole of one wave in one isotope.
struct Hole {
    std::complex<double> place;  // c + i y
    std::complex<double> w;      // w(place)

    Hole(double centre, double half_width) : place{centre, half_width}, w{faddeeva(place)} {}
};

inline constexpr double root_pi = 1.0 / std::numbers::inv_sqrtpi;

// <L_c> = sqrt(pi) y Re w, the Voigt profile relative to a Lorentzian of height one.
inline double average_line(const Hole& h) { return root_pi * h.place.imag() * h.w.real(); }

// <y (c - v) / (y^2 + (v - c)^2)> = sqrt(pi) y Im w, the dispersion that goes with it.
inline double average_dispersion(const Hole& h) { return root_pi * h.place.imag() * h.w.imag(); }

// <L_a L_b>, by partial fractions: with d = a - b
//
//   sqrt(pi) y^3 / (d^2 + 4 y^2) (Re(w_a + w_b) + 2 y Im((w_a - w_b) / d))
//
// whose quotient is a derivative where the holes coincide.
inline double average_overlap(const Hole& a, const Hole& b) {
    const double y = a.place.imag();
    const double d = a.place.real() - b.place.real();
    const double slope = faddeeva_slope(a.place, a.w, b.place, b.w).imag();
    return root_pi * y * y * y / (d * d + 4.0 * y * y) * (a.w.real() + b.w.real() + 2.0 * y * slope);
}

}  // namespace zlg::twin
