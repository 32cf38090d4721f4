"""Theory for the designer: drift budget, best interval between switches, error of substitution, loop."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Sequence
from types import ModuleType
from typing import Any, Literal, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _zlg
from ._columns import Progress, made_of
from ._shown import Row
from .config import Config, checked, resolved

__all__ = [
    "Choice",
    "Design",
    "IntervalLine",
    "Optimum",
    "Relock",
    "SubstitutionLine",
    "choose",
    "design_gyro",
    "drift_arcsec_s",
    "optimum",
    "relock",
    "substitution_response",
]

Method = Literal["corrected", "worst_case", "as_printed", "closed_form"]


class Optimum(NamedTuple):
    """Best interval between switches: s, the budget there in arcsec/s, and a sentence."""

    interval_s: float
    drift_arcsec_s: float
    status: str


class IntervalLine(Row):
    """The best interval of one budget for one length of run: run_s, method, interval_s, drift_arcsec_s, status."""


class SubstitutionLine(Row):
    """Error of a gap's angle: order of the polynomial, gap_ticks, frequency_hz, NaN: the whole configured motion, noise_gain.

    In arcsec: worst_arcsec, rms_arcsec, counter_arcsec, relock_arcsec, total_arcsec.
    """


class Design(Row):
    """What `design_gyro` gives; page, HTML.

    switch_error_arcsec  rms of a switch: design.switch_error_arcsec where it is given, else of a trial of the gyro on the twin
    best_interval_s      best interval with that, by length of run, s; what switching.interval_s = "optimal" stands for
    relock_s, stable, phase_margin_deg, gain_margin  of the perimeter loop
    false_angle_arcsec   total false angle of one re-lock
    """

    intervals: list[IntervalLine]
    substitution: list[SubstitutionLine]


class Choice(Row):
    """What `choose` gives, as the program's JSON has it: the simplest gyro that meets a requirement, or the one with the least error.

    met, probability, probability_sigma  share of the gyros of the proof that meet it, and its standard deviation
    gyros, refused, lost  of the proof; of these impossible by the tolerances; without their switches
    required_arcsec, least_arcsec  largest error at the end that is allowed; what `confidence` of the gyros keep, None: too many have none
    choice               by section and key; runner_up the next one
    reasons, budget, binding, would_need
    proofs               candidates that were proved, each on gyros of its own
    simulated            the first gyros of the proof, simulated half by half: how many, how many meet it, rms of their errors
    toml, page           what `zlg run` and `Config.loads` take; HTML
    """

    runner_up: dict[str, Any] = {}


class Relock(Row):
    """The perimeter loop from its closing on.

    detuning_lambda       every step_s, wavelengths, shape (steps,)
    false_drift_arcsec_s  false rotation of each tick, arcsec/s, shape (ticks,)
    """


def design_gyro(config: Optional[Config] = None) -> Design:
    """All of it for one gyro. Raises ConfigError; DesignError for a gyro without a budget."""
    return made_of(Design, _zlg.design_gyro(resolved(config)[0]))


def choose(
    require: Union[str, os.PathLike[str]],
    *,
    settings: Sequence[str] = (),
    rules: Literal["all", "paper"] = "all",
    threads: int = 1,
    progress: Progress = None,
) -> Choice:
    """What `zlg design --require` does; `zlg.design(require=...)` is the same.

    require  a path of a TOML file, or the TOML itself: a text of more than one line.
    settings  "section.key=value", over it.
    rules    "paper": by the paper's rules alone, without a gyro tried.
    Ctrl-C ends it. Raises ConfigError, DesignError, IoError, FormatError.
    """
    if rules not in ("all", "paper"):
        raise ValueError(f"rules = {rules!r}: allowed are 'all' and 'paper'")
    text, source = os.fspath(require), "require"
    if "\n" not in text:
        source = text
        with open(text, encoding="utf-8") as file:
            text = file.read()
    found, toml, page = _zlg.choose(text, source, list(settings), rules == "paper", threads, progress)
    return made_of(Choice, {**json.loads(found), "toml": toml, "page": page})


class _Callable(ModuleType):
    """`zlg.design(require=...)` is `zlg.design.choose(...)`."""

    def __call__(self, require: Union[str, os.PathLike[str]], **options: Any) -> Choice:
        return choose(require, **options)


sys.modules[__name__].__class__ = _Callable


def drift_arcsec_s(
    interval_s: ArrayLike, run_s: float = 3600.0, config: Optional[Config] = None, method: Method = "corrected"
) -> NDArray[np.float64]:
    """Apparent drift of a run whose modes are switched every interval_s, arcsec/s, shape of interval_s.

    The gyro is [drift], an error per switch design.switch_error_arcsec. Raises DesignError unless 0 < interval_s <= run_s.
    """
    return _zlg.drift_arcsec_s(checked(config), run_s, interval_s, method)


def optimum(run_s: float = 3600.0, config: Optional[Config] = None, method: Method = "corrected") -> Optimum:
    """The interval with the least drift, found without approximation. Raises DesignError."""
    return Optimum(*_zlg.optimum(checked(config), run_s, method))


def substitution_response(
    frequency_hz: ArrayLike,
    order: int = 2,
    gap_ticks: int = 3,
    points: tuple[int, int, int] = (4, 2, 2),
    extrapolate: bool = False,
    tick_s: float = 0.005,
) -> NDArray[np.float64]:
    """|H|: worst error of a gap's angle over the amplitude of an oscillation of the rate, arcsec per arcsec/s, shape of frequency_hz.

    points  of the extrapolation, before and after the gap. Raises DesignError.
    """
    return _zlg.substitution_response(order, gap_ticks, points, extrapolate, tick_s, frequency_hz)


def relock(config: Optional[Config] = None, miss_lambda: Optional[float] = None, ticks: int = 20) -> Relock:
    """The loop's way to the centre of the mode, and the false rotation meanwhile; the miss is that of [perimeter].

    Raises DesignError.
    """
    used = Config() if config is None else config
    miss = used.perimeter.miss_lambda if miss_lambda is None else miss_lambda
    return made_of(Relock, _zlg.relock(checked(used), miss, ticks))
