#!/usr/bin/env python3
"""The gas whose bias with saturated dispersion is nearest to the paper's parabola: docs/physics.md.

    /usr/bin/python3 bench/search_gas.py        # NumPy and SciPy, three minutes

Written from the equations of the four waves alone, two of them lit, in closed form with SciPy's Faddeeva function.
"""

import numpy
from scipy.optimize import differential_evolution
from scipy.special import wofz

RANGE_HZ = 299792458.0 / 0.16
PLACES = (0.05, 0.10, 0.15, 0.20)  # wavelengths
PAPER_CHI = 3.6
LOSS = 0.007
SHIFT_HZ = 15.0 * 1.82e6
DIRECTION = numpy.array([1.0, -1.0, 1.0, -1.0])
COMPONENT = numpy.array([1.0, -1.0, -1.0, 1.0])


def steady(gain, saturation):
    """The one set of waves that nothing disturbs."""
    for lit in range(16):
        on = [i for i in range(4) if lit >> i & 1]
        light = numpy.zeros(4)
        light[on] = numpy.linalg.solve(saturation[numpy.ix_(on, on)], gain[on])
        spare = gain - saturation @ light
        if min(light) >= -1e-13 and max(spare[[i for i in range(4) if i not in on]], default=-1.0) <= 1e-13:
            return light
    return numpy.zeros(4)


def bias(detuning, gamma_hz, doppler_hz, isotope_hz, coupling, gain_loss):
    y = gamma_hz / doppler_hz
    lines = numpy.array([0.5, -0.5]) * isotope_hz / doppler_hz
    whole = gain_loss * LOSS / numpy.mean(numpy.sqrt(numpy.pi) * y * wofz(lines + 1j * y).real)
    frequency = numpy.array([detuning, detuning, detuning - 0.5, detuning - 0.5]) * RANGE_HZ / doppler_hz
    pair = numpy.where(numpy.equal.outer(COMPONENT, COMPONENT), 1.0, coupling)
    gain, dispersion = numpy.full(4, -LOSS), numpy.zeros(4)
    saturation, push = numpy.zeros((4, 4)), numpy.zeros((4, 4))
    for line in lines:
        place = DIRECTION * (frequency - line - COMPONENT * SHIFT_HZ / doppler_hz) + 1j * y
        w = wofz(place)
        gain += 0.5 * whole * numpy.sqrt(numpy.pi) * y * w.real
        dispersion += 0.5 * DIRECTION * numpy.sqrt(numpy.pi) * y * w.imag
        apart = (place[:, None] - place[None, :]).real
        equal = numpy.abs(apart) < 1e-9
        slope = numpy.where(equal, (-2.0 * place * w + 2j / numpy.sqrt(numpy.pi))[:, None],
                            (w[:, None] - w[None, :]) / numpy.where(equal, 1.0, apart))
        both = 0.5 * numpy.sqrt(numpy.pi) * y * y * ((w[:, None] + w.conj()[None, :]) / (apart + 2j * y) - slope)
        saturation -= 0.5 * whole * pair * both.imag
        push += 0.5 * DIRECTION[:, None] * pair * both.real
    pulled = dispersion - push @ steady(gain, saturation)
    return RANGE_HZ / (4.0 * numpy.pi) * whole * (pulled[1] - pulled[0])


def chi(gas):
    centre = bias(0.0, *gas)
    return [(1.0 - bias(place, *gas) / centre) / place**2 for place in PLACES]


def main():
    print("default", [f"{c:.2f}" for c in chi((130e6, 907e6, 885e6, 0.6, 1.2))])
    published = [(80e6, 200e6), (850e6, 960e6), (875e6, 1000e6), (0.2, 1.0), (1.05, 1.4)]
    uncoupled = [*published[:3], (0.0, 1.0), published[4]]
    thin = [(20e6, 200e6), *published[1:]]
    for name, ranges in (("published", published), ("without coupling", uncoupled), ("thin", thin)):
        found = differential_evolution(lambda gas: max(abs(c - PAPER_CHI) for c in chi(gas)), ranges, maxiter=25, popsize=10, seed=1)
        print(name, [f"{x:.4g}" for x in found.x], "chi", [f"{c:.2f}" for c in chi(found.x)])


if __name__ == "__main__":
    main()
