"""What all sections of a configuration are."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable
from typing import Any

__all__ = ["Section", "give", "given_of", "keys_of"]


class Section:
    """A dataclass that knows which of its keys were given, be it with the value of the default."""

    _given: set[str]

    def __new__(cls, *values: Any, **named: Any) -> Section:
        section = super().__new__(cls)
        keys = keys_of(cls)
        given = {*keys[: len(values)], *named}
        # dataclasses.replace names all keys, so all say nothing of one.
        object.__setattr__(section, "_given_first", set() if len(given) == len(keys) else given)
        return section

    def __post_init__(self) -> None:
        """From here on what is set is given."""
        give(self, self.__dict__.pop("_given_first"))

    def __setattr__(self, name: str, value: Any) -> None:
        object.__setattr__(self, name, value)
        if "_given" in self.__dict__:
            self._given.add(name)


def keys_of(section: Any) -> list[str]:
    """Names of the keys of a section, of its class or of one of it, in their order."""
    return [key.name for key in dataclasses.fields(section)]


def given_of(section: Section) -> set[str]:
    """Names of the keys that were given, be it with the value of the default."""
    return section._given


def give(section: Section, keys: Iterable[str]) -> None:
    """These were given, no others."""
    object.__setattr__(section, "_given", set(keys))
