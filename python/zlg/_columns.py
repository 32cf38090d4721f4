"""What the modules have in common: columns of logs, and arrays as C++ takes them."""

from __future__ import annotations

import warnings
from collections.abc import Iterable
from typing import Any, Callable, Optional, TypeVar, Union, get_args, get_origin, get_type_hints

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._shown import Row, Shown

T = TypeVar("T")
Progress = Optional[Callable[[float], object]]


def _of_type(hint: Any, value: Any) -> Any:
    if get_origin(hint) is Union:  # Optional
        hint = get_args(hint)[0]
    if isinstance(value, dict) and isinstance(hint, type) and issubclass(hint, Shown):
        return made_of(hint, value)
    if isinstance(value, list) and get_origin(hint) is list:
        return [_of_type(get_args(hint)[0], each) for each in value]
    return value


def made_of(kind: type[T], columns: dict[str, Any]) -> T:
    """An instance of the dataclass from the columns that bear its field names, a Row of all; nested dictionaries by their types."""
    types = get_type_hints(kind)
    names = columns if issubclass(kind, Row) else types
    return kind(**{name: _of_type(types.get(name), value) for name, value in columns.items() if name in names})


def warn_each(reasons: Iterable[str]) -> None:
    """One warning per reason, shown at the line of the user: the caller of the caller (stacklevel 3)."""
    for reason in reasons:
        warnings.warn(reason, stacklevel=3)


def _filled(masked: Any, value: Any) -> Any:  # Any: the stubs of numpy do not type .filled
    return masked.filled(value)


def floats(values: ArrayLike) -> NDArray[np.float64]:
    """As float64, not copied where they are; what is masked is NaN."""
    if isinstance(values, np.ma.MaskedArray):
        values = _filled(values.astype(np.float64), np.nan)
    return np.ascontiguousarray(values, dtype=np.float64)


def mask(valid: Optional[ArrayLike]) -> Optional[NDArray[np.uint8]]:
    """As bytes 0 and 1, not copied where they are bool; what is masked is not valid. Raises ValueError: anything else."""
    if valid is None:
        return None
    given = np.asarray(_filled(valid, False) if isinstance(valid, np.ma.MaskedArray) else valid)
    flags = np.ascontiguousarray(given, dtype=np.bool_)
    if given.dtype != np.bool_ and not np.array_equal(flags, given):
        raise ValueError("valid: holds other than True and False, or 1 and 0")
    return flags.view(np.uint8)


def signs(mode: ArrayLike) -> NDArray[np.int8]:
    """As int8. Raises ValueError: a mode that is masked, or other than 1 and -1."""
    if not np.all(np.equal(np.abs(floats(mode)), 1.0)):
        raise ValueError("mode: holds other than 1 and -1")
    return np.ascontiguousarray(mode, dtype=np.int8)
