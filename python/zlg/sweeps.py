"""Many gyros of drawn parameters."""

from __future__ import annotations

import importlib
import os
from typing import Any, Union

from . import _zlg
from ._columns import Progress

__all__ = ["read_sweep", "sweep"]


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
