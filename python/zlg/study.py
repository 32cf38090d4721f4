"""Experiments: one run of the twin, many compensations, statistics."""

from __future__ import annotations

import importlib
import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import _zlg
from ._columns import Progress, floats, made_of, signs, warn_each
from ._shown import Row, Shown, axes_of
from .analysis import Deviations, ModeSplit, NoiseFit
from .config import Config, checked, resolved
from .logs import AngleLog, Path, RawLog, Switches, kind, read_angles, read_raw

__all__ = [
    "Analysis",
    "Axis",
    "AxisResult",
    "EarthLine",
    "Readout",
    "RunResult",
    "Switches",
    "Variant",
    "analyze",
    "axis_of_log",
    "read",
    "run",
]


@dataclass(repr=False)
class Variant(Shown):
    """One way to compensate a run, and what comes of it."""

    name: str
    #: slope of the angle error over the run, arcsec/s
    drift_arcsec_s: float
    #: the same without the constant non-magnetic drift, which a measurement removes as a bias
    drift_without_nonmagnetic_arcsec_s: float
    #: at the end
    angle_error_arcsec: float
    angle_error_without_nonmagnetic_arcsec: float
    #: errors per switch, with the sign of the false drift; None without a switch
    switch_mean_arcsec: Optional[float]
    switch_rms_arcsec: Optional[float]
    switch_max_arcsec: Optional[float]
    #: of each switch, shape (switches,)
    switch_tick: NDArray[np.int64]
    switch_error_arcsec: NDArray[np.float64]
    #: final less true angle over time for a plot, thinned, shape (points,); each tick's is in RunResult.angles.error_arcsec
    t_s: NDArray[np.float64]
    error_arcsec: NDArray[np.float64]

    def plot(self, ax: Any = None) -> Any:
        """The error of the angle over time; on these axes of matplotlib, or on new ones, returned."""
        ax = axes_of(ax)
        ax.plot(self.t_s, self.error_arcsec, label=self.name)
        ax.set(xlabel="time, s", ylabel="angle error, arcsec")
        return ax


@dataclass(repr=False)
class RunResult(Shown):
    """What `run` gives."""

    tick_s: float
    ticks: int
    #: 16 hexadecimal digits: runs with the same ones agree in every bit of what passed between gyro, processor and outside
    fingerprint: str
    variants: list[Variant]
    #: as configured, with the magnetic drift estimated
    magnetic_estimate: Variant
    switches: Switches
    #: in words, one sentence each: length, switches, faults and what the core made of them
    what_happened: list[str]
    #: outside the switches, whose counts could not be trusted
    ticks_invalid: int
    #: true false drift 1, 2, ... ticks after the loop is closed, deg/h, mean over the switches
    relock_false_drift_deg_h: NDArray[np.float64]
    #: after which the gyro went back, had to be searched for, or held nothing
    switches_failed: int
    #: were due when the gyro was not ready, and until the next one
    switches_withheld: int
    #: switches were due, and the gyro holds the mode of none
    none_succeeded: bool
    #: what contradicts itself in the configuration
    warnings: list[str]
    raw: Optional[RawLog]
    #: of the configured compensation, with the truth
    angles: Optional[AngleLog]
    #: the report, HTML
    page: Optional[str]

    def __getitem__(self, name: str) -> Variant:
        """The variant of a name: "one_mode", "switching", ..., "configured", "magnetic_estimate". Raises KeyError."""
        variants = [*self.variants, self.magnetic_estimate]
        for variant in variants:
            if variant.name == name:
                return variant
        raise KeyError(f"{name}: allowed are {', '.join(variant.name for variant in variants)}")

    def to_pandas(self) -> Any:
        """One row a variant: drift, error at the end and errors of switches, as a pandas.DataFrame. Needs pandas."""
        columns = ("drift_arcsec_s", "angle_error_arcsec", "switch_mean_arcsec", "switch_rms_arcsec", "switch_max_arcsec")
        values = [[getattr(variant, column) for column in columns] for variant in self.variants]
        names = [variant.name for variant in self.variants]
        return importlib.import_module("pandas").DataFrame(values, index=names, columns=columns)

    def plot(self, ax: Any = None) -> Any:
        """The error of the angle over time, of each variant; on these axes of matplotlib, or on new ones, returned."""
        ax = axes_of(ax)
        for variant in self.variants:
            variant.plot(ax)
        ax.legend()
        return ax


def run(
    config: Optional[Config] = None,
    *,
    raw: bool = False,
    angles: Optional[bool] = None,
    page: bool = False,
    threads: int = 1,
    progress: Progress = None,
) -> RunResult:
    """The main experiment: a gyro that switches modes, every compensation on the same records, and the gyro in one mode.

    config  default: an hour of the paper's gyro.
    raw, angles, page  what to keep beside the figures; angles, unless it is said, of a gyro that is simulated half by half.
    Raises ConfigError, of fidelity "events" where a log is asked for, IoError and FormatError for a motion file.
    """
    used, contradictions = resolved(config)
    if angles is None:
        angles = (config or Config()).gyro.fidelity != "events"
    result = _zlg.run(used, contradictions, raw, angles, page, threads, progress)
    if raw:
        result["raw"].update(settings=used.settings(), timer_hz=_zlg.timer_hz)
    if angles:
        result["angles"].update(settings=_zlg.angle_settings(used), tick_s=result["tick_s"])
    return made_of(RunResult, result)


@dataclass(repr=False)
class Axis(Shown):
    """One axis of a gyro as it was read."""

    name: str
    rate_hz: float
    #: NaN where nothing was measured, shape (samples,)
    rates_arcsec_s: NDArray[np.float64]
    #: +1 or -1, of a switched gyro
    mode: Optional[NDArray[np.int8]] = None
    #: the rates with the gaps filled as compensation did
    bridged_arcsec_s: Optional[NDArray[np.float64]] = None
    #: three axes of one group stand at right angles
    group: str = ""
    #: where angles were recorded: those, one more
    phase_arcsec: Optional[NDArray[np.float64]] = None
    #: values that may be no measurements, a line each
    warnings: list[str] = field(default_factory=list)
    #: what `zlg.read` understood of the file
    notes: list[str] = field(default_factory=list)


class Readout(Row):
    """The Allan deviation at a time, between two points of its curve: what, tau_s, deviation_arcsec_s."""


class AxisResult(Row):
    """What is known of the noise of one axis: name, n_samples, n_known, n_gaps, mean_arcsec_s, mean_sigma_arcsec_s, warnings.

    no_fit       why there is no fit
    readouts     at 1 s, and where each term is read
    modes        of a switched gyro, as mode_curves: mode +1, mode -1, and both with the magnetic part taken out
    """

    deviations: list[Deviations]
    fit: Optional[NoiseFit]
    readouts: list[Readout]
    modes: Optional[ModeSplit]
    mode_curves: list[Deviations]


class EarthLine(Row):
    """The Earth's rate as three axes at right angles see it, the norm of their mean rates: group, n_axes, norm_arcsec_s, sigma_arcsec_s."""


class Analysis(Row):
    """What `analyze` gives: axes; earth, of each group of three axes; page, HTML."""

    axes: list[AxisResult]
    earth: list[EarthLine]


def axis_of_log(log: AngleLog, name: str = "gyro") -> Axis:
    """The final increments of an angle log; ticks that were not measured are missing."""
    rates: NDArray[np.float64] = np.divide(log.dtheta_final_arcsec, log.tick_s)
    return Axis(name, 1.0 / log.tick_s, np.where(log.measured, rates, np.nan), log.mode, rates)


def read(path: Path, progress: Progress = None, **said: Union[str, float, Sequence[Union[str, int]]]) -> Union[RawLog, AngleLog, list[Axis]]:
    """A file of any program: a log of zlg as it is, another one by the rules of `zlg import`.

    said  the keys of `zlg import --keys`: axis="gyro_z", unit="deg/s", rate_hz=100, ...
    Returns a RawLog of a file with counts, for `compensate` and `calibrate`; else the axes, for `analyze`. Warns of values that may be no
    measurements. Raises IoError; MappingError: what the file leaves open, with the keys that answer it; FormatError.
    """
    found = kind(path)
    if not said and found != "unknown":
        return read_raw(path, progress=progress) if found == "raw" else read_angles(path, progress)
    axis = said.pop("axis", [])
    axes = [axis] if isinstance(axis, (str, int, float)) else axis
    pairs = [(key, str(value)) for key, value in said.items()]
    columns = _zlg.read_foreign(os.fspath(path), pairs, [str(each) for each in axes], progress)
    if columns["raw"] is not None:
        return made_of(RawLog, columns["raw"])
    read_axes = [made_of(Axis, dict(each, group=os.fspath(path), notes=columns["notes"])) for each in columns["axes"]]
    warn_each(f"{os.fspath(path)}: {warning}" for each in read_axes for warning in each.warnings)
    return read_axes


def analyze(
    axes: Sequence[Axis],
    config: Optional[Config] = None,
    settling_samples: int = 20,
    threads: int = 1,
    progress: Progress = None,
) -> Analysis:
    """What `zlg analyze` computes of axes in memory, and draws; [analysis] says which deviations.

    settling_samples  after a gap that belong to the switch
    progress          called, and Ctrl-C looked for, before each axis
    Raises ConfigError; SeriesError with the axis' name.
    """
    records = []
    for axis in axes:
        mode = None if axis.mode is None else signs(axis.mode)
        bridged = None if axis.bridged_arcsec_s is None else floats(axis.bridged_arcsec_s)
        phase = None if axis.phase_arcsec is None else floats(axis.phase_arcsec)
        records.append((axis.name, axis.group, axis.rate_hz, floats(axis.rates_arcsec_s), mode, bridged, phase, axis.warnings))
    return made_of(Analysis, _zlg.analyze(checked(config), records, settling_samples, threads, progress))
