"""Types of the C++ behind zlg that reach a user; what only the modules of zlg call is Any."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

class ActuatorFrame:
    def __init__(self) -> None: ...
    loop_closed: bool
    polarity: int
    edge_offset_ticks: int
    set_point_v: NDArray[np.float64]

class CheckedConfig:
    def __init__(self, settings: list[tuple[str, str]], sets: list[str] = []) -> None: ...
    @staticmethod
    def of_layers(toml: str, source: str, sets: list[str]) -> CheckedConfig: ...
    @staticmethod
    def of_log(settings: list[tuple[str, str]], name: str) -> CheckedConfig: ...
    def given(self) -> list[str]: ...
    def toml(self) -> str: ...
    def settings(self) -> list[tuple[str, str]]: ...

class ConfigError(Error, ValueError): ...

class ControlOutput:
    @property
    def actuator(self) -> ActuatorFrame: ...
    @property
    def record(self) -> HalfRecord: ...
    @property
    def health(self) -> int: ...

class DesignError(Error, ValueError): ...

class Error(Exception): ...

class FormatError(Error, ValueError): ...

class MappingError(Error, ValueError): ...

class HalfRecord:
    def __init__(self) -> None: ...
    half: int
    counts: int
    detuning_lambda: float
    detuning_sq_lambda2: float
    piezo_v: float
    temperature_c: float
    bias_sign: int
    mode: int
    loop_closed: bool
    valid: bool
    edge_offset_ticks: int
    span: int
    fringe: float
    late: bool
    lit: bool

class IoError(Error, OSError): ...

class Motion:
    @staticmethod
    def rest() -> Motion: ...
    @staticmethod
    def sines(rate_arcsec_s: float, sines: list[tuple[float, float, float]]) -> Motion: ...
    @staticmethod
    def from_increments(increment_arcsec: NDArray[np.float64], rate_hz: float) -> Motion: ...
    def increment_arcsec(self, t0_s: ArrayLike, t1_s: ArrayLike) -> NDArray[np.float64]: ...
    @property
    def duration_s(self) -> float: ...

class SensorFrame:
    def __init__(self) -> None: ...
    sequence: int
    timer_ticks: int
    counter: int
    bias_sign: int
    polarity: int
    loop_closed: bool
    piezo_v: float
    coil_current_a: float
    temperature_c: float
    status: int
    has_fringe: bool
    fringe_quarter: int
    fringe_c: float
    fringe_s: float
    @property
    def light_a(self) -> NDArray[np.float32]: ...
    @property
    def light_b(self) -> NDArray[np.float32]: ...

class SeriesError(Error, ValueError): ...

class TwinTruth:
    dtheta_arcsec: float
    false_relock_arcsec: float
    detuning_end_lambda: float
    perimeter_v: float
    rounding_arcsec: float
    random_walk_arcsec: float
    lit: bool

def __getattr__(name: str) -> Any: ...
