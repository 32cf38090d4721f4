"""The acceptance test of a gyro from its logs."""

from __future__ import annotations

import json
import os
from typing import Optional

from . import _zlg
from ._columns import Progress, made_of
from ._shown import Row
from .config import Config, checked
from .logs import Path

__all__ = ["Acceptance", "Quantity", "accept"]


class Quantity(Row):
    """What the logs say of one quantity, and the verdict. None: not determined, no limit.

    name                name with its unit, "bias.deg_h"
    value, uncertainty  one standard deviation, of degrees_of_freedom, None: known
    limit               "min" and "max", as far as the plan has them
    verdict             "pass", "fail", "undecided", "not determined"
    risk                that the truth lies beyond the limit, of what passes
    more_hours          by which the record would be longer when it decides with an even chance; None: no time does, or it is decided
    """


class Acceptance(Row):
    """What `accept` gives, as the program's record has it.

    passed     whether every limit is met
    unit       serial, type, ... as the plan has them
    risk       of a quantity; unit_risk: that a unit which passes lies beyond one of the limits, None: it does not pass
    runs       files with their checksums, notes, and why a run is no measurement
    html       the page, as `zlg accept --out` writes it
    """

    quantities: list[Quantity]

    def __getitem__(self, name: str) -> Quantity:
        """The quantity of a name, "bias.deg_h". Raises KeyError."""
        for quantity in self.quantities:
            if quantity.name == name:
                return quantity
        raise KeyError(name)

    def write(self, path: Path, force: bool = False) -> None:
        """Write the page. Raises IoError; a file is not overwritten without `force`."""
        _zlg.write_text(os.fspath(path), self.html, force)


def accept(plan: Path, config: Optional[Config] = None, *, threads: int = 1, progress: Progress = None) -> Acceptance:
    """What `zlg accept` does: the plan, a file of TOML, carried out on its logs.

    config  what it was given goes over what the logs say.
    Raises ConfigError, MappingError, IoError, FormatError, as the program refuses.
    """
    record, html = _zlg.accept(os.fspath(plan), checked(config), threads, progress)
    return made_of(Acceptance, {**json.loads(record), "html": html})
