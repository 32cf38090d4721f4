"""Many gyros of drawn parameters, and what their numbers depend on."""

from __future__ import annotations

import importlib
import os
from dataclasses import dataclass
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _zlg
from ._columns import Progress, made_of
from ._shown import Shown

__all__ = ["SobolIndices", "read_sweep", "sobol", "sweep"]


def _frame(columns: list[tuple[str, str, Any]], description: str) -> Any:
    pandas = importlib.import_module("pandas")
    frame = pandas.DataFrame({name: values for name, _, values in columns})
    frame.attrs["units"] = {name: unit for name, unit, _ in columns if unit}
    frame.attrs["description"] = description
    return frame.set_index("gyro")


def sweep(
    description: Union[str, os.PathLike[str]],
    out: Union[str, os.PathLike[str]],
    *,
    threads: int = 1,
    part: tuple[int, int] = (1, 1),
    force: bool = False,
    progress: Progress = None,
) -> Any:
    """What `zlg sweep` does: runs the gyros that `out` lacks, completes it, and gives its rows as a pandas.DataFrame.

    description  a path of a TOML file, or the TOML itself: a text of more than one line.
    part         (k, n): only the k-th of n parts.
    One row a gyro, with its number as index; `attrs["units"]` has the unit of each column, `attrs["description"]` the TOML. A gyro
    that failed has a status that is not 0, and NaN for what it lacks. `command` repeats a gyro alone. Ctrl-C ends it, and the
    same call goes on. Raises ConfigError, IoError, FormatError. Needs pandas.
    """
    text, source = os.fspath(description), "description"
    if "\n" not in text:
        source = text
        with open(text, encoding="utf-8") as file:
            text = file.read()
    columns = _zlg.sweep(text, source, os.fspath(out), part[0], part[1], threads, force, progress)
    return _frame(columns, text)


def read_sweep(path: Union[str, os.PathLike[str]]) -> Any:
    """The results of `zlg sweep`, or its checkpoint RESULTS.part, as `sweep` gives them. Raises IoError, FormatError. Needs pandas."""
    description, columns = _zlg.read_sweep(os.fspath(path))
    return _frame(columns, description)


@dataclass(repr=False)
class SobolIndices(Shown):
    """Parts of the variance of a number, by input, shape (inputs,), with their intervals of 95 %."""

    #: from the input alone
    first: NDArray[np.float64]
    first_low: NDArray[np.float64]
    first_high: NDArray[np.float64]
    #: from the input with all its interactions
    total: NDArray[np.float64]
    total_low: NDArray[np.float64]
    total_high: NDArray[np.float64]
    #: of the design, that were used
    n_rows: int
    #: of the design, in which a value is not finite
    n_dropped: int
    variance: float


def sobol(samples: ArrayLike, values: ArrayLike, *, n_resamples: int = 1000, seed: Optional[int] = None) -> SobolIndices:
    """Sobol's indices by Jansen's estimators, with intervals by resampling of the rows.

    samples  Saltelli's design, shape (n (d + 2), d): the block A, the block B and A with one column of B after the other
             (OpenTURNS), or for each row A, the mixed points, B (SALib without second order; a sweep with `sensitivity`).
    values   of the function at each point; one that is not finite drops its row of the design.
    seed     of the resampling.
    Raises ValueError where the samples are no such design.
    """
    points = np.ascontiguousarray(samples, dtype=float)
    numbers = np.ascontiguousarray(values, dtype=float).reshape(-1)
    return made_of(SobolIndices, _zlg.sobol(points, numbers, n_resamples, 1 if seed is None else seed))
