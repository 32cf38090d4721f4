"""Allan deviation and its kin, of arrays and of logs; public by `zlg.analysis`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple, Optional, Protocol, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _zlg
from ._columns import floats, made_of, mask
from ._shown import Columns, axes_of
from .logs import AngleLog

__all__ = [
    "Deviations", "KINDS", "adev", "deviation", "deviations_of_log", "hdev",
    "mdev", "oadev", "ohdev", "tdev", "totdev",
]  # fmt: skip

Floats = NDArray[np.float64]
DataType = Literal["increments", "rate", "phase"]
Taus = Union[Literal["octave", "decade", "log", "all"], Sequence[float], Floats, None]
Unit = Literal["arcsec", "rad", "deg", "arcsec/s", "rad/s", "deg/s", "deg/h", "1"]

KINDS = ("adev", "oadev", "mdev", "tdev", "hdev", "ohdev", "totdev")


@dataclass(repr=False)
class Deviations(Columns):
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
    #: of totdev with the bias of mirroring, which is taken out of `deviation`; of others the deviation
    as_computed: Floats

    _index = "tau_s"

    def plot(self, ax: Any = None, **style: Any) -> Any:
        """The curve with its intervals, both scales logarithmic; on these axes of matplotlib, or on new ones, returned."""
        ax = axes_of(ax)
        errors = np.maximum([self.deviation - self.low, self.high - self.deviation], 0.0)
        ax.errorbar(self.tau_s, self.deviation, errors, **{"fmt": ".-", "capsize": 2, "label": self.kind, **style})
        ax.set(xscale="log", yscale="log", xlabel="averaging time, s", ylabel=f"{self.kind}, unit of the data")
        return ax


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
    threads: int = 1,
) -> Deviations:
    """A deviation of a record with gaps, in arcsec/s, with intervals.

    kind        one of KINDS
    data        shape (samples,)
    valid       bool, shape (samples,); default: all that are finite
    taus        "octave" (default), "decade", "log" (per_decade), "all", or times in s
    least_known_ratio  of each averaging window
    noise       exponent of the rate's spectrum, 2 .. -4; default: identified from the data
    Raises SeriesError: no sample, nothing known, all equal, another unit, no tau with a term.
    """
    samples = (floats(data), rate_hz, data_type, unit, mask(valid))
    options = (confidence, least_known_ratio, noise, threads)
    return made_of(Deviations, _zlg.deviation(kind, samples, _taus(taus), per_decade, False, *options))


class Estimator(Protocol):
    """A deviation with the signature that users of other tools know."""

    def __call__(
        self, data: ArrayLike, rate: float = 1.0, data_type: Optional[str] = None, taus: Taus = None,
        valid: Optional[ArrayLike] = None,
    ) -> Known: ...  # fmt: skip


def _estimator(kind: str, name: str) -> Estimator:
    def estimate(
        data: ArrayLike, rate: float = 1.0, data_type: Optional[str] = None, taus: Taus = None,
        valid: Optional[ArrayLike] = None,
    ) -> Known:  # fmt: skip
        if data_type is None:
            raise TypeError('data_type must be given: "increments", "rate" (or "freq") or "phase"')
        called = "rate" if data_type == "freq" else data_type
        samples = (floats(data), rate, called, "1", mask(valid))
        d = made_of(Deviations, _zlg.deviation(kind, samples, _taus(taus), 20, True, 0.6827, 0.9, None, 1))
        mirrored = d.as_computed / np.where(d.deviation > 0.0, d.deviation, 1.0)
        return Known(d.tau_s, d.as_computed, 0.5 * (d.high - d.low) * mirrored, d.terms)

    estimate.__name__ = estimate.__qualname__ = kind
    estimate.__doc__ = f"""{name}, in the unit of the data (a rate; of tdev an angle).

    data       shape (samples,); NaN or valid == False: missing
    rate       samples per second
    data_type  "increments", "rate" (also "freq") or "phase"; must be given
    taus       "octave" (default), "decade", "log", "all", or times in s, of which those that the record has no term of are left out
    Returns (taus, devs, errs, ns), each of shape (taus,). Raises SeriesError; TypeError without data_type.
    """
    return estimate


adev = _estimator("adev", "Allan deviation, from windows side by side")
oadev = _estimator("oadev", "Overlapping Allan deviation")
mdev = _estimator("mdev", "Modified Allan deviation")
tdev = _estimator("tdev", "Time deviation, tau/sqrt(3) times the modified one")
hdev = _estimator("hdev", "Hadamard deviation")
ohdev = _estimator("ohdev", "Overlapping Hadamard deviation")
totdev = _estimator("totdev", "Total deviation, with the bias of mirroring as AllanTools and Stable32 have it")


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
