"""The line of a gyro: its angles as they arrive."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Optional

import numpy as np
from numpy.typing import NDArray

from . import _zlg
from ._columns import made_of
from ._shown import Columns, Row
from .logs import AngleLog, Path

__all__ = ["Batch", "Line", "LineSummary", "follow", "line_flags"]

#: bits of Batch.flags by name that tell of losses of the line, beside zlg.core.angle_flags
line_flags: dict[str, int] = _zlg.line_flags


@dataclass(repr=False)
class Batch(Columns):
    """Some ticks in a row: arrays of shape (ticks,), as in an AngleLog."""

    #: number of each tick, from 0 on without holes over all batches
    tick: NDArray[np.int64]
    #: as delivered in real time, arcsec
    dtheta_arcsec: NDArray[np.float64]
    #: the best increment known afterwards, arcsec
    dtheta_final_arcsec: NDArray[np.float64]
    #: one standard deviation of it; inf where unknown
    sigma_arcsec: NDArray[np.float64]
    mode: NDArray[np.int8]
    #: sum of the bits zlg.core.angle_flags and line_flags
    flags: NDArray[np.uint32]
    #: length of a tick
    tick_s: float

    _index = "t_s"

    def __len__(self) -> int:
        return len(self.tick)

    @property
    def t_s(self) -> NDArray[np.float64]:
        """End of each tick, s since the first batch, shape (ticks,)."""
        ends: NDArray[np.float64] = np.multiply(self.tick_s, self.tick + 1)
        return ends


class LineSummary(Row):
    """What came over a line so far, and what was lost, as counts.

    ticks, angle_arcsec   that were given, and the sum of their dtheta_arcsec
    bytes, telemetry_messages, status_messages, replies
    lost_messages         by their numbers; lost_ticks: their angle is shared out among them; final_lost_ticks: without a final value
    restarts              of the gyro; its turn meanwhile is in no tick
    outages               losses of too many ticks at once: outage_ticks, in which it turned by outage_arcsec, were given by nobody
    other_tick_messages   of ticks of another length, which were left out
    unfitting_messages    that fit neither those before them nor those after
    damaged_frames, damaged_bytes; foreign_frames: of the damaged ones whole, but of another version of the line
    refused_messages      whole frames that no gyro of ours sends; repeated_messages: that came again or too late
    """


class Line:
    """An iterator of batches, which `follow` makes. After Ctrl-C it goes on where it was; ticks that had come are in the next batch."""

    def __init__(self, source: str, baud: int, duration_s: Optional[float], batch_s: float, batch_ticks: int) -> None:
        if batch_ticks < 1:
            raise ValueError(f"batch_ticks = {batch_ticks}: allowed is 1 or more")
        if not batch_s >= 0.0:
            raise ValueError(f"batch_s = {batch_s}: allowed is 0 or more")
        self._source, self._batch_s, self._batch_ticks = source, batch_s, batch_ticks
        self._line = _zlg.Line(source, baud, duration_s)

    def __iter__(self) -> Line:
        return self

    def __next__(self) -> Batch:
        columns = self._line.batch(self._batch_ticks, self._batch_s)
        if columns is None:
            raise StopIteration
        ticks = columns["first_tick"] + np.arange(len(columns["flags"]), dtype=np.int64)
        return made_of(Batch, {**columns, "tick": ticks})

    def __enter__(self) -> Line:
        return self

    def __exit__(self, *error: object) -> None:
        self.stop()

    def stop(self) -> None:
        """Read no more; the ticks of what has arrived are the last batches."""
        self._line.stop()

    def summary(self) -> LineSummary:
        """What `zlg follow` prints at its end, so far."""
        return made_of(LineSummary, self._line.summary())

    def read(self) -> AngleLog:
        """All that is left, to the end, as one log: what `zlg follow --out` writes. Raises IoError where there is no message of a gyro."""
        batches = list(self)
        if not batches:
            raise _zlg.IoError(f"{self._source}: not one message of a gyro in it")
        columns = {
            name: np.concatenate([getattr(batch, name) for batch in batches])
            for name in ("dtheta_arcsec", "dtheta_final_arcsec", "sigma_arcsec", "mode", "flags")
        }
        return made_of(AngleLog, {**columns, "tick_s": batches[0].tick_s, "settings": _zlg.line_settings()})


def follow(
    source: Path,
    *,
    baud: int = _zlg.default_baud,
    duration_s: Optional[float] = None,
    batch_s: float = 0.5,
    batch_ticks: int = 65536,
) -> Line:
    """What a gyro sends over its line, batch by batch as it arrives.

        for batch in zlg.follow("/dev/ttyUSB0"):
            print(batch.t_s[-1], batch.dtheta_arcsec.sum())

    source       a file, a pipe, a serial device, "-" for standard input, "tcp:HOST:PORT" or "unix:PATH"
    baud         speed of a serial device
    duration_s   end after so long, of the ticks or of the clock, whichever comes first; None: when the source ends
    batch_s      a batch is what comes in so long, and one tick at least; it waits for that
    batch_ticks  at most in a batch
    `zlg.follow(source).read()` is all of it as one AngleLog. Raises IoError; ValueError for an address, a speed or a duration
    that is none.
    """
    return Line(os.fspath(source), baud, duration_s, batch_s, batch_ticks)
