"""Noise terms and their fits, drift by mode, rate tables, spectra; public by `zlg.analysis`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _zlg
from ._columns import floats, made_of, mask, signs
from ._shown import Shown, axes_of
from ._deviations import DataType, Floats, Unit
from ._zlg import NoiseTerms

__all__ = [
    "DiscreteNoise", "FittedTerm", "ModeSplit", "NoiseFit", "NoiseTerms", "RateTable", "data_sheet",
    "discrete_noise", "fit_noise", "imu_yaml", "rate_table", "split_modes",
    "terms_of_data_sheet", "welch_spectrum",
]  # fmt: skip

Estimate = Optional[tuple[float, float]]


@dataclass(repr=False)
class FittedTerm(Shown):
    """A noise term, found or not; NaN: not known."""

    name: str
    unit: str
    found: bool
    value: float
    #: one standard deviation
    sigma: float
    #: of a Markov term the time, s; of a sinusoid the frequency, of angle random walk the bandwidth, -3 dB, Hz
    second: float
    second_sigma: float
    #: where not found: 95 % of such gyros have less
    limit: float
    #: tau at which the Allan deviation of the term alone is read
    read_at_s: float


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
    samples = _zlg.Samples(floats(data), rate_hz, data_type, unit, mask(valid))
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
    return _zlg.terms_of_sheet(
        quantisation_arcsec, angle_random_walk_deg_sqrt_h, bias_instability_deg_h, rate_random_walk_deg_h_sqrt_h,
        ramp_deg_h_h,
    )  # fmt: skip


@dataclass(repr=False)
class DiscreteNoise(Shown):
    """Noise of one sample at a rate, standard deviations."""

    white_rate_arcsec_s: float
    white_increment_arcsec: float
    walk_step_arcsec_s: float
    angle_error_arcsec: float
    ramp_step_arcsec_s: float
    #: of each Markov term: b[k+1] = factor b[k] + step
    markov_factor: list[float]
    markov_step_arcsec_s: list[float]


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


@dataclass(repr=False)
class ModeSplit(Shown):
    """A switched gyro's rate, in what follows the mode and what does not. An estimate is (value, sigma), None: not determined."""

    segment_time_s: Floats
    segment_mode: NDArray[np.int8]
    segment_rate_arcsec_s: Floats
    #: of every segment with two neighbours
    time_s: Floats
    magnetic_arcsec_s: Floats
    nonmagnetic_arcsec_s: Floats
    nonmagnetic: Estimate
    #: at the start, its growth by warming, and the time of that, s
    magnetic: Estimate
    magnetic_thermal: Estimate
    thermal_time: Estimate
    switch_time_s: Floats
    switch_mode_after: NDArray[np.int8]
    #: at rest the error of the switch, on a moving base that of the motion too
    switch_error_arcsec: Floats
    switch_rms_arcsec: float


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


@dataclass(repr=False)
class RateTable(Shown):
    """Scale factor and bias from a rate table. An estimate is (value, sigma), None: not determined."""

    #: of each stage, shape (stages,)
    input_arcsec_s: Floats
    output: Floats
    residual_ppm: Floats
    #: units of the output per arcsec
    scale_factor: Estimate
    arcsec_per_unit: Estimate
    bias_arcsec_s: Estimate
    asymmetry_ppm: Estimate
    nonlinearity_ppm: float
    largest_residual_ppm: float
    hysteresis_arcsec_s: float


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
