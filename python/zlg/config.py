"""Configurations: a dataclass per section of the TOML file, one member per key, the unit in its name."""

from __future__ import annotations

import copy
import dataclasses
import json
import math
import os
import tomllib
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Optional, Union

from . import _zlg
from . import sections as _sections
from .section import give, given_of, keys_of
from .sections import *
from .sections import Sections

__all__ = ["Config"]
__all__ += _sections.__all__


def _toml(value: Any) -> str:
    """A value as TOML; numbers of NumPy as those of Python."""
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, (list, tuple)) or hasattr(value, "__array__") and getattr(value, "ndim", 0) == 1:
        return "[" + ", ".join(_toml(each) for each in value) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int) or hasattr(value, "__index__"):
        return str(int(value))
    number = float(value)
    return repr(number) if math.isfinite(number) else "nan" if math.isnan(number) else f"{number:+}".lower()


@dataclass(repr=False)
class Config(Sections):
    """Everything configurable. The defaults are the gyro of the paper.

    Members are the sections `run`, `gyro`, `laser`, `drift`, `perimeter`, `piezo`, `photodiodes`, `temperature`, `field`, `switching`, `compensation`, `motion`, `faults`,
    `design` and `analysis`. A member that is None is unset. What is out of its range is refused by `check`, and by every function
    that takes a configuration, as ConfigError: key, value, what is allowed.
    """

    @classmethod
    def of(cls, *settings: str) -> Config:
        """The defaults, and over them settings "section.key=value".

        Raises ConfigError.
        """
        return cls.from_toml("", "", *settings)

    @classmethod
    def load(cls, path: Union[str, os.PathLike[str]], *settings: str) -> Config:
        """A TOML file, and over it settings as for `of`.

        Raises ConfigError; OSError where the file cannot be read.
        """
        with open(path, encoding="utf-8") as file:
            return cls.from_toml(file.read(), os.fspath(path), *settings)

    @classmethod
    def from_toml(cls, text: str, source: str = "text", *settings: str) -> Config:
        """TOML text; `source` begins the messages.

        Raises ConfigError.
        """
        return cls._of_checked(_zlg.CheckedConfig.of_layers(text, source, list(settings)))

    @classmethod
    def from_settings(cls, settings: Union[Mapping[str, str], Sequence[tuple[str, str]]], name: str = "log") -> Config:
        """The settings of a log, "section.key" to TOML text; what belongs to no section is ignored.

        Raises ConfigError, also for a key that stands twice with different values.
        """
        pairs = list(settings.items()) if isinstance(settings, Mapping) else list(settings)
        return cls._of_checked(_zlg.CheckedConfig.of_log(pairs, name))

    def with_(self, *settings: str, **sections: Mapping[str, Any]) -> Config:
        """A changed copy: settings as for `of`, or a mapping of keys for a section.

        config.with_("motion.kind=rest", switching={"interval_s": 60})
        """
        changed = copy.deepcopy(self)
        for section, values in sections.items():
            part = getattr(changed, section)
            for key, value in values.items():
                if key not in keys_of(part):
                    raise TypeError(f"[{section}] has no key {key!r}")
                setattr(part, key, value)
        return type(self)._of_checked(_zlg.CheckedConfig(changed.settings(), list(settings))) if settings else changed

    def says(self, key: str) -> bool:
        """Whether "section.key" was given: in a text, as a setting, as an attribute, or as a value that is not the default."""
        return any(key == given for given, _ in self.settings())

    def settings(self) -> list[tuple[str, str]]:
        """What was given or differs from the defaults, as ("section.key", TOML text)."""
        defaults = Sections()
        pairs = []
        for section in dataclasses.fields(Sections):
            mine, theirs = getattr(self, section.name), getattr(defaults, section.name)
            for key in keys_of(mine):
                value = getattr(mine, key)
                if value is not None and (key in given_of(mine) or not _same(value, getattr(theirs, key))):
                    pairs.append((f"{section.name}.{key}", _toml(value)))
        return pairs

    def __repr__(self) -> str:
        """What was given or is not the default, as the call that makes the same."""
        return f"zlg.Config.of({', '.join(repr(f'{key}={value}') for key, value in self.settings())})"

    def check(self) -> None:
        """Raises ConfigError with the first rule that is broken."""
        self._checked()

    def to_toml(self) -> str:
        """Every key that is set, as a TOML file. Raises ConfigError."""
        return self._checked().toml()

    def _checked(self) -> _zlg.CheckedConfig:
        return _zlg.CheckedConfig(self.settings())

    @classmethod
    def _of_checked(cls, checked: _zlg.CheckedConfig) -> Config:
        config = cls()
        for section, values in tomllib.loads(checked.toml()).items():
            part = getattr(config, section)
            for key, value in values.items():
                setattr(part, key, _like(value, getattr(part, key)))
        given = checked.given()
        for field in dataclasses.fields(Sections):
            part = getattr(config, field.name)
            give(part, (key for key in keys_of(part) if f"{field.name}.{key}" in given))
        return config


def _same(value: Any, default: Any) -> bool:
    if isinstance(value, (list, tuple)) or hasattr(value, "__array__"):
        return list(value) == list(default) if isinstance(default, list) else False
    return not isinstance(value, bool) and bool(value == default)


def _like(value: Any, default: Any) -> Any:
    """As the member's type has it: a list stays one where TOML has a single value, a real stays one where it is whole."""
    if isinstance(default, list):
        values = value if isinstance(value, list) else [value]
        return [each if isinstance(each, str) else float(each) for each in values]
    return float(value) if isinstance(default, float) and isinstance(value, int) else value


def checked(config: Optional[Config]) -> _zlg.CheckedConfig:
    """What C++ takes; None is the gyro of the paper."""
    return (Config() if config is None else config)._checked()


def resolved(config: Optional[Config]) -> tuple[_zlg.CheckedConfig, list[str]]:
    """With what it leaves open decided, as the program does it, and what contradicts itself: each a UserWarning too."""
    made, _, contradictions = _zlg.resolved(checked(config))
    for line in contradictions:
        warnings.warn(line, stacklevel=3)
    return made, contradictions
