"""How results show themselves: as one line, as a data frame."""

from __future__ import annotations

import importlib
from types import SimpleNamespace
from typing import Any

import numpy as np

__all__ = ["Columns", "Row", "Shown", "axes_of"]


def short(value: Any) -> str:
    """At most a few words, however much is in it."""
    if isinstance(value, np.ndarray):
        shape = " x ".join(str(n) for n in value.shape)
        if value.ndim != 1 or not len(value):
            return f"<{shape} of {value.dtype}>"
        return f"<{shape}: {short(value[0].item())} .. {short(value[-1].item())}>"
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, str):
        return repr(value) if len(value) <= 60 else f"<{len(value)} characters>"
    if isinstance(value, (list, dict)) and len(value) > 3 or isinstance(value, list) and any(map(_is_large, value)):
        return f"<{len(value)} of {type(next(iter(value))).__name__}>"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(short(each) for each in value) + "]"
    if isinstance(value, Shown):
        return f"<{type(value).__name__}>"
    return repr(value.item() if isinstance(value, np.generic) else value)


def _is_large(value: Any) -> bool:
    return isinstance(value, Shown) or isinstance(value, (list, tuple, dict, str)) and len(value) > 60


class Shown:
    """A record whose repr stays short; arrays are shown by their length and ends."""

    def __repr__(self) -> str:
        members = [f"{name}={short(value)}" for name, value in vars(self).items() if value is not None]
        return f"{type(self).__name__}({', '.join(members)})"


class Row(Shown, SimpleNamespace):
    """A part of a result as C++ gives it; what it holds, by name, its own kind says."""


class Columns(Shown):
    """A dataclass of columns of one length."""

    #: member that numbers the rows of the data frame; empty: they are counted from 0
    _index = ""

    def to_pandas(self) -> Any:
        """The columns as a pandas.DataFrame; those of light samples, which are tables, are left out. Needs pandas."""
        columns = {name: each for name, each in vars(self).items() if isinstance(each, np.ndarray) and each.ndim == 1}
        index = columns.pop(self._index, getattr(self, self._index)) if self._index else None
        frame = importlib.import_module("pandas").DataFrame(columns, index=index)
        frame.index.name = self._index or None
        return frame


def axes_of(ax: Any) -> Any:
    """The given axes of matplotlib, or new ones."""
    return importlib.import_module("matplotlib.pyplot").subplots()[1] if ax is None else ax
