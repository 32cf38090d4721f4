"""Noise of a gyro from its readings: Allan deviation and its kin, noise terms, drift by mode, rate tables, spectra.

What the numbers are is always said: `data_type` is "increments" (angle turned in each interval), "rate" (mean over each interval) or
"phase" (angle at the borders of the intervals, one more), and has no default. NaN, or valid == False, is a missing sample: it is neither
filled nor closed up.

`deviation` knows units and intervals. `adev` ... `htotdev` have the signature that users of other tools know.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _zlg
from ._columns import floats, made_of, mask, signs
from ._zlg import NoiseTerms
from .logs import AngleLog

__all__ = [
    "Deviations",
    "DeviationStream",
    "DiscreteNoise",
    "FittedTerm",
    "KINDS",
    "ModeSplit",
    "NoiseFit",
    "NoiseTerms",
    "RateTable",
    "adev",
    "data_sheet",
    "deviation",
    "deviations_of_log",
    "discrete_noise",
    "fit_noise",
    "hdev",
    "htotdev",
    "imu_yaml",
    "mdev",
    "mtotdev",
    "oadev",
    "ohdev",
    "rate_table",
    "read_imu_yaml",
    "spectrogram",
    "split_modes",
    "tdev",
    "terms_of_data_sheet",
    "totdev",
    "welch_spectrum",
]

Floats = NDArray[np.float64]
Estimate = Optional[tuple[float, float]]
DataType = Literal["increments", "rate", "phase"]
Taus = Union[Literal["octave", "decade", "log", "all"], Sequence[float], Floats, None]
Unit = Literal["arcsec", "rad", "deg", "arcsec/s", "rad/s", "deg/s", "deg/h", "1"]

KINDS = ("adev", "oadev", "mdev", "tdev", "hdev", "ohdev", "totdev", "mtotdev", "htotdev")


@dataclass
class Deviations:
    """A deviation against averaging time: arrays of shape (taus,). A tau at which nothing is known is left out."""

    kind: str
    #: of the intervals, for instance 0.6827
    confidence: float
    #: averaging factors, tau_s times the rate
    m: NDArray[np.int64]
    tau_s: Floats
    #: arcsec/s; tdev arcsec; without unit for unit "1"
    deviation: Floats
    #: ends of the interval
    low: Floats
    high: Floats
    #: differences that were known
    terms: NDArray[np.int64]
    #: equivalent degrees of freedom
    edf: Floats
    #: exponent of the rate's spectrum f^noise at this tau
    noise: NDArray[np.int32]


class Known(NamedTuple):
    """(taus, devs, errs, ns): s, deviation, half of its 68.27 % interval, number of differences."""

    taus: Floats
    devs: Floats
    errs: Floats
    ns: NDArray[np.int64]


def _taus(taus: Taus) -> Union[str, list[float]]:
    return "octave" if taus is None else taus if isinstance(taus, str) else [float(tau) for tau in taus]


def deviation(
    kind: str,
    data: ArrayLike,
    *,
    rate_hz: float,
    data_type: DataType,
    unit: Unit,
    valid: Optional[ArrayLike] = None,
    taus: Taus = None,
    per_decade: int = 20,
    confidence: float = 0.6827,
    least_known_ratio: float = 0.9,
    noise: Optional[int] = None,
    bias_removed: bool = True,
    threads: int = 1,
) -> Deviations:
    """A deviation of a record with gaps, in arcsec/s, with intervals.

    kind        one of KINDS
    data        shape (samples,)
    valid       bool, shape (samples,); default: all that are finite
    taus        "octave" (default), "decade", "log" (per_decade), "all", or times in s
    least_known_ratio  of each averaging window
    noise       exponent of the rate's spectrum, 2 .. -4; default: identified from the data
    bias_removed  of the total deviations
    Raises SeriesError: no sample, nothing known, all equal, another unit, no tau with a term.
    """
    columns = _zlg.deviation(
        kind, floats(data), rate_hz, data_type, unit, mask(valid), _taus(taus), per_decade, False,
        confidence, least_known_ratio, noise, bias_removed, threads,
    )  # fmt: skip
    return made_of(Deviations, columns)


def _known(
    kind: str, data: ArrayLike, rate: float, data_type: Optional[str], taus: Taus, valid: Optional[ArrayLike]
) -> Known:
    if data_type is None:
        raise TypeError('data_type must be given: "increments", "rate" (or "freq") or "phase"')
    called = "rate" if data_type == "freq" else data_type
    d = made_of(
        Deviations,
        _zlg.deviation(
            kind, floats(data), rate, called, "1", mask(valid), _taus(taus), 20, True, 0.6827, 0.9, None, True, 1
        ),
    )
    return Known(d.tau_s, d.deviation, 0.5 * (d.high - d.low), d.terms)


def adev(
    data: ArrayLike, rate: float = 1.0, data_type: Optional[str] = None, taus: Taus = None,
    valid: Optional[ArrayLike] = None,
) -> Known:  # fmt: skip
    """Allan deviation, from windows side by side, in the unit of the data (a rate).

    data       shape (samples,); NaN or valid == False: missing
    rate       samples per second
    data_type  "increments", "rate" (also "freq") or "phase"; must be given
    taus       "octave" (default), "decade", "log", "all", or times in s, of which those that the record has no term of are left out
    Returns (taus, devs, errs, ns), each of shape (taus,). Raises SeriesError; TypeError without data_type.
    """
    return _known("adev", data, rate, data_type, taus, valid)


def oadev(
    data: ArrayLike, rate: float = 1.0, data_type: Optional[str] = None, taus: Taus = None,
    valid: Optional[ArrayLike] = None,
) -> Known:  # fmt: skip
    """Overlapping Allan deviation; as `adev`."""
    return _known("oadev", data, rate, data_type, taus, valid)


def mdev(
    data: ArrayLike, rate: float = 1.0, data_type: Optional[str] = None, taus: Taus = None,
    valid: Optional[ArrayLike] = None,
) -> Known:  # fmt: skip
    """Modified Allan deviation; as `adev`."""
    return _known("mdev", data, rate, data_type, taus, valid)


def tdev(
    data: ArrayLike, rate: float = 1.0, data_type: Optional[str] = None, taus: Taus = None,
    valid: Optional[ArrayLike] = None,
) -> Known:  # fmt: skip
    """Time deviation, tau/sqrt(3) times the modified one: an angle; as `adev`."""
    return _known("tdev", data, rate, data_type, taus, valid)


def hdev(
    data: ArrayLike, rate: float = 1.0, data_type: Optional[str] = None, taus: Taus = None,
    valid: Optional[ArrayLike] = None,
) -> Known:  # fmt: skip
    """Hadamard deviation; as `adev`."""
    return _known("hdev", data, rate, data_type, taus, valid)


def ohdev(
    data: ArrayLike, rate: float = 1.0, data_type: Optional[str] = None, taus: Taus = None,
    valid: Optional[ArrayLike] = None,
) -> Known:  # fmt: skip
    """Overlapping Hadamard deviation; as `adev`."""
    return _known("ohdev", data, rate, data_type, taus, valid)


def totdev(
    data: ArrayLike, rate: float = 1.0, data_type: Optional[str] = None, taus: Taus = None,
    valid: Optional[ArrayLike] = None,
) -> Known:  # fmt: skip
    """Total deviation, its bias removed; as `adev`."""
    return _known("totdev", data, rate, data_type, taus, valid)


def mtotdev(
    data: ArrayLike, rate: float = 1.0, data_type: Optional[str] = None, taus: Taus = None,
    valid: Optional[ArrayLike] = None,
) -> Known:  # fmt: skip
    """Modified total deviation, its bias removed; as `adev`."""
    return _known("mtotdev", data, rate, data_type, taus, valid)


def htotdev(
    data: ArrayLike, rate: float = 1.0, data_type: Optional[str] = None, taus: Taus = None,
    valid: Optional[ArrayLike] = None,
) -> Known:  # fmt: skip
    """Hadamard total deviation, its bias removed; as `adev`."""
    return _known("htotdev", data, rate, data_type, taus, valid)


def deviations_of_log(
    log: AngleLog, kind: str = "oadev", *, angles: Literal["final", "delivered"] = "final", taus: Taus = None,
    confidence: float = 0.6827, threads: int = 1,
) -> Deviations:  # fmt: skip
    """A deviation of an angle log, arcsec/s; ticks that were not measured are missing. Raises SeriesError."""
    data = log.dtheta_final_arcsec if angles == "final" else log.dtheta_arcsec
    return deviation(
        kind, data, rate_hz=1.0 / log.tick_s, data_type="increments", unit="arcsec", valid=log.measured, taus=taus,
        confidence=confidence, threads=threads,
    )  # fmt: skip


class DeviationStream:
    """Deviations of a stream of any length in bounded memory: oadev, mdev, tdev, ohdev.

    factors  averaging factors m; over `window`, a power of two from 64, they are rounded to a multiple of their stride
    Raises SeriesError.
    """

    def __init__(
        self, *, rate_hz: float, data_type: DataType, unit: Unit, kinds: Sequence[str] = ("oadev",),
        factors: Sequence[int], window: int = 1 << 14, least_known_ratio: float = 0.9,
    ) -> None:  # fmt: skip
        self._stream = _zlg.DeviationStream(
            rate_hz, data_type, unit, list(kinds), list(factors), window, least_known_ratio
        )

    @classmethod
    def of_log(
        cls, path: Union[str, os.PathLike[str]], *, kinds: Sequence[str] = ("oadev",), factors: Sequence[int],
        window: int = 1 << 14, least_known_ratio: float = 0.9, angles: Literal["final", "delivered"] = "final",
    ) -> DeviationStream:  # fmt: skip
        """The stream of an angle log's increments; memory does not grow with the log, Ctrl-C ends it.

        Raises IoError, FormatError, SeriesError.
        """
        made = cls.__new__(cls)
        made._stream = _zlg.DeviationStream.of_log(
            os.fspath(path), list(kinds), list(factors), window, least_known_ratio, angles == "final"
        )
        return made

    def add(self, data: ArrayLike, valid: Optional[ArrayLike] = None) -> None:
        """The samples that follow, shape (samples,). Raises SeriesError."""
        self._stream.add(floats(data), mask(valid))

    def curve(self, kind: str = "oadev", *, confidence: float = 0.6827, noise: Optional[int] = None) -> Deviations:
        """What is known by now. Raises SeriesError: no tau with a term yet."""
        return made_of(Deviations, self._stream.curve(kind, confidence, noise))

    @property
    def n_samples(self) -> int:
        """Samples so far."""
        return self._stream.n_samples

    @property
    def n_known(self) -> int:
        """Of them not missing."""
        return self._stream.n_known

    @property
    def memory_bytes(self) -> int:
        """What the stream holds; it does not grow."""
        return self._stream.memory_bytes


@dataclass
class FittedTerm:
    """A noise term, found or not; NaN: not known."""

    name: str
    unit: str
    found: bool
    value: float
    #: one standard deviation
    sigma: float
    #: of a Markov term the time, s; of a sinusoid the frequency, Hz
    second: float
    second_sigma: float
    #: where not found: 95 % of such gyros have less
    limit: float
    #: tau at which the Allan deviation of the term alone is read
    read_at_s: float


@dataclass
class NoiseFit:
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

    def __getitem__(self, name: str) -> FittedTerm:
        """The term of a name, such as "angle random walk". Raises KeyError."""
        for term in self.fitted:
            if term.name == name:
                return term
        raise KeyError(f"{name}: allowed are {', '.join(term.name for term in self.fitted)}")


def fit_noise(
    data: ArrayLike, *, rate_hz: float, data_type: DataType, unit: Unit, valid: Optional[ArrayLike] = None,
    markov: bool = True, most_sines: int = 3, least_known_ratio: float = 0.9, threads: int = 1,
) -> NoiseFit:  # fmt: skip
    """Quantisation, angle random walk, bias instability, rate random walk, ramp, Markov and sinusoidal terms, with errors.

    data  shape (samples,). Raises SeriesError: as `deviation`; fewer than 64 intervals.
    """
    result = _zlg.fit_noise(
        floats(data), rate_hz, data_type, unit, mask(valid), markov, most_sines, least_known_ratio, threads
    )
    result["fitted"] = [made_of(FittedTerm, each) for each in result["fitted"]]
    return made_of(NoiseFit, result)


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


@dataclass
class DiscreteNoise:
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


def read_imu_yaml(path: Union[str, os.PathLike[str]]) -> tuple[NoiseTerms, float]:
    """Kalibr's imu.yaml: terms, and samples per second. Raises IoError, FormatError."""
    return _zlg.read_imu_yaml(os.fspath(path))


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


def spectrogram(
    rates_arcsec_s: ArrayLike, rate_hz: float, piece: int, least_known_ratio: float = 0.5
) -> tuple[Floats, Floats, Floats]:
    """Times, s, frequencies, Hz, and one-sided density, (arcsec/s)^2/Hz, shape (times, frequencies); NaN: too little known.

    Raises SeriesError.
    """
    return _zlg.spectrogram(floats(rates_arcsec_s), rate_hz, piece, least_known_ratio)


@dataclass
class ModeSplit:
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


@dataclass
class RateTable:
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
