"""The core: control and compensation as they run in the gyro's processor."""

from __future__ import annotations

from typing import Optional

from . import _zlg
from ._columns import Progress, made_of, warn_each
from ._zlg import ActuatorFrame, ControlOutput, HalfRecord, SensorFrame
from .config import Config, checked, resolved
from .logs import AngleLog, RawLog

__all__ = ["Control", "ControlOutput", "HalfRecord", "angle_flags", "compensate", "flag_names", "health_bits"]

#: bits of AngleLog.flags by name
angle_flags: dict[str, int] = _zlg.angle_flags
#: bits of the health word by name
health_bits: dict[str, int] = _zlg.health_bits


def flag_names(flags: int, bits: dict[str, int] = angle_flags) -> list[str]:
    """The names of the bits of a word."""
    return [name for name, bit in bits.items() if int(flags) & bit]


class Control:
    """The controller: what happens between the latch of one half-period and the command for the next. Raises ConfigError."""

    def __init__(self, config: Optional[Config] = None) -> None:
        self._control = _zlg.Control(resolved(config)[0])

    def initial_actuator(self) -> ActuatorFrame:
        """What is commanded before any frame."""
        return self._control.initial_actuator()

    def step(self, frame: SensorFrame) -> ControlOutput:
        """Advance by one half-period: the next command, the record of this half, the health word."""
        return self._control.step(frame)


def compensate(raw: RawLog, config: Optional[Config] = None, progress: Progress = None) -> AngleLog:
    """A raw log through the compensation; the same bits as in the live run.

    config  all of it, tick and scale of the gyro as the log's settings have them; default: what these say. Tick and scale
            have no default: the log's settings say them, or the configuration does.
            `compensation.relock` None: mean_square where the log has detuning_sq_lambda2, none where not.
    Returns an AngleLog of len(raw)//2 ticks; an odd last half is dropped, with a warning. Raises ConfigError, also where the log
    was recorded with another tick or scale; FormatError for a log without a whole tick; ValueError for columns that do not fit.
    """
    used = raw.config if config is None else config
    columns = _zlg.compensate(vars(raw), checked(used), raw.settings, raw.timer_hz, progress)
    warn_each(columns["warnings"])
    return made_of(AngleLog, {**columns, "tick_s": used.gyro.tick_s})
