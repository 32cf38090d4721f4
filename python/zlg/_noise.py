"""Noise terms and their fits, drift by mode, rate tables, spectra; public by `zlg.analysis`."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike

from . import _zlg
from ._columns import floats, made_of, mask, signs
from ._shown import Row, Shown, axes_of, short
from ._deviations import DataType, Floats, Unit

__all__ = [
    "DiscreteNoise", "FittedTerm", "ModeSplit", "NoiseFit", "NoiseTerms", "RateTable", "data_sheet",
    "discrete_noise", "fit_noise", "imu_yaml", "rate_table", "split_modes",
    "terms_of_data_sheet", "welch_spectrum",
]  # fmt: skip


@dataclass(repr=False)
class NoiseTerms(Shown):
    """The terms of a gyro's noise, arcsec and seconds; 0: absent."""

    quantisation_arcsec: float = 0.0
    angle_random_walk_arcsec_sqrt_s: float = 0.0
    #: of the low pass behind which angle random walk is seen
    filter_time_s: float = 0.0
    bias_instability_arcsec_s: float = 0.0
    rate_random_walk_arcsec_s_sqrt_s: float = 0.0
    ramp_arcsec_s2: float = 0.0
    #: (deviation_arcsec_s, time_s)
    markov: list[tuple[float, float]] = field(default_factory=list)
    #: (amplitude_arcsec_s, frequency_hz)
    sines: list[tuple[float, float]] = field(default_factory=list)

    def __repr__(self) -> str:
        """Those that are there."""
        return f"NoiseTerms({', '.join(f'{name}={short(value)}' for name, value in vars(self).items() if value)})"

    def allan_variance(self, tau_s: ArrayLike) -> Floats:
        """Allan variance of the rate at tau_s, (arcsec/s)^2, shape of tau_s."""
        return _zlg.allan_variance(self, tau_s)

    def rate_spectrum(self, frequency_hz: ArrayLike, rate_hz: float) -> Floats:
        """Two-sided spectrum of the rate, (arcsec/s)^2/Hz, shape of frequency_hz."""
        return _zlg.rate_spectrum(self, frequency_hz, rate_hz)


class FittedTerm(Row):
    """A noise term: name, unit, found, value, sigma; NaN: not known.

    second, second_sigma  of a Markov term the time, s; of a sinusoid the frequency, of angle random walk the bandwidth, -3 dB, Hz
    limit                 where not found: 95 % of such gyros have less
    read_at_s             tau at which the Allan deviation of the term alone is read
    """


@dataclass(repr=False)
class NoiseFit(Shown):
    """The terms of a gyro's noise, and the Hadamard variances from which they were found."""

    terms: NoiseTerms
    fitted: list[FittedTerm]
    tau_s: Floats
    #: (arcsec/s)^2, shape (taus,)
    measured: Floats
    fitted_variance: Floats
    chi2: float
    dof: int
    probability: float
    #: relative error that each variance is allowed beside chance
    model_error: float
    #: False: the terms do not describe the record
    describes: bool
    #: shorter averaging times are left free: the sensor's filter or rounding rules them
    from_tau_s: float

    def __getitem__(self, name: str) -> FittedTerm:
        """The term of a name, such as "angle random walk". Raises KeyError."""
        for term in self.fitted:
            if term.name == name:
                return term
        raise KeyError(f"{name}: allowed are {', '.join(term.name for term in self.fitted)}")

    def plot(self, ax: Any = None) -> Any:
        """Measured and fitted Hadamard deviation, arcsec/s; on these axes of matplotlib, or on new ones, returned."""
        ax = axes_of(ax)
        ax.loglog(self.tau_s, np.sqrt(self.measured), "o", label="measured")
        ax.loglog(self.tau_s, np.sqrt(self.fitted_variance), label="fitted")
        ax.set(xlabel="averaging time, s", ylabel="Hadamard deviation, arcsec/s")
        ax.legend()
        return ax


def fit_noise(
    data: ArrayLike, *, rate_hz: float, data_type: DataType, unit: Unit, valid: Optional[ArrayLike] = None,
    markov: bool = True, most_sines: int = 3, least_known_ratio: float = 0.9, threads: int = 1,
) -> NoiseFit:  # fmt: skip
    """Quantisation, angle random walk, bias instability, rate random walk, ramp, Markov and sinusoidal terms, with errors.

    data  shape (samples,). Raises SeriesError: as `deviation`; fewer than 64 intervals.
    """
    samples = (floats(data), rate_hz, data_type, unit, mask(valid))
    return made_of(NoiseFit, _zlg.fit_noise(samples, markov, most_sines, least_known_ratio, threads))


def data_sheet(terms: NoiseTerms) -> dict[str, float]:
    """The terms in deg/sqrt(h), deg/h and so on; the unit is in each name."""
    return _zlg.data_sheet(terms)


def terms_of_data_sheet(
    *,
    quantisation_arcsec: float = 0.0,
    angle_random_walk_deg_sqrt_h: float = 0.0,
    bias_instability_deg_h: float = 0.0,
    rate_random_walk_deg_h_sqrt_h: float = 0.0,
    ramp_deg_h_h: float = 0.0,
) -> NoiseTerms:
    """From a data sheet; bias instability is B, 0.664 B the floor of the Allan deviation."""
    sheet = (
        quantisation_arcsec, angle_random_walk_deg_sqrt_h, bias_instability_deg_h, rate_random_walk_deg_h_sqrt_h,
        ramp_deg_h_h,
    )  # fmt: skip
    return made_of(NoiseTerms, _zlg.terms_of_sheet(*sheet))


class DiscreteNoise(Row):
    """Standard deviations of one sample: white_rate_arcsec_s, white_increment_arcsec, walk_step_arcsec_s, angle_error_arcsec, ramp_step_arcsec_s.

    markov_factor, markov_step_arcsec_s  lists, of each Markov term: b[k+1] = factor b[k] + step
    """


def discrete_noise(terms: NoiseTerms, rate_hz: float) -> DiscreteNoise:
    """What a filter or a simulation at that rate needs. Raises SeriesError: rate not positive."""
    return made_of(DiscreteNoise, _zlg.discrete_noise(terms, rate_hz))


def imu_yaml(terms: NoiseTerms, rate_hz: float) -> str:
    """The gyro's part of Kalibr's imu.yaml; it knows angle and rate random walk, other terms are lost."""
    return _zlg.imu_yaml(terms, rate_hz)


def welch_spectrum(
    rates_arcsec_s: ArrayLike, rate_hz: float, piece: int, least_known_ratio: float = 0.5
) -> tuple[Floats, Floats]:
    """Frequencies, Hz, and one-sided density, (arcsec/s)^2/Hz; NaN in the rates is missing and neither filled nor cut out.

    piece  samples of each piece; they overlap by half. Raises SeriesError.
    """
    return _zlg.welch_spectrum(floats(rates_arcsec_s), rate_hz, piece, least_known_ratio)


class ModeSplit(Row):
    """A switched gyro's rate, in what follows the mode and what does not. An estimate is (value, sigma), None: not determined.

    segment_time_s, segment_mode, segment_rate_arcsec_s  of every segment, shape (segments,)
    time_s, magnetic_arcsec_s, nonmagnetic_arcsec_s      of every segment with two neighbours
    nonmagnetic, magnetic, magnetic_thermal, thermal_time  estimates; magnetic at the start, its growth by warming, the time of that, s
    switch_time_s, switch_mode_after, switch_error_arcsec  at rest the error of the switch, on a moving base that of the motion too
    switch_rms_arcsec
    """


def split_modes(
    rates_arcsec_s: ArrayLike, mode: ArrayLike, *, rate_hz: float, bridged_arcsec_s: Optional[ArrayLike] = None,
    settling_samples: int = 20,
) -> ModeSplit:  # fmt: skip
    """Magnetic and non-magnetic drift of a switched gyro, and the errors of its switches.

    rates_arcsec_s    shape (samples,), NaN where nothing was measured
    mode              +1 or -1, shape (samples,)
    bridged_arcsec_s  with the gaps filled as compensation did
    Raises SeriesError: lengths differ; ValueError: another mode.
    """
    bridged = None if bridged_arcsec_s is None else floats(bridged_arcsec_s)
    return made_of(ModeSplit, _zlg.split_modes(floats(rates_arcsec_s), signs(mode), rate_hz, bridged, settling_samples))


class RateTable(Row):
    """Scale factor and bias from a rate table. An estimate is (value, sigma), None: not determined.

    input_arcsec_s, output, residual_ppm  of each stage, shape (stages,)
    scale_factor, arcsec_per_unit, bias_arcsec_s, asymmetry_ppm  estimates; the first in units of the output per arcsec
    nonlinearity_ppm, largest_residual_ppm, hysteresis_arcsec_s
    """


def rate_table(
    input_arcsec_s: ArrayLike, output: ArrayLike, settling_samples: int = 0, earth_arcsec_s: float = 0.0
) -> RateTable:
    """A straight line through the stages of a rate-table test.

    input_arcsec_s  of the table, output of the gyro in units a second, shape (samples,); NaN: not known
    Raises SeriesError: fewer than 3 stages, all of one rate.
    """
    return made_of(
        RateTable, _zlg.rate_table(floats(input_arcsec_s), floats(output), settling_samples, earth_arcsec_s)
    )
