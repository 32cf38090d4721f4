"""Types of the C++ behind zlg; its modules say what these mean."""

from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

class ActuatorFrame:
    def __init__(self) -> None: ...
    loop_closed: bool
    polarity: int
    edge_offset_ticks: int
    set_point_v: NDArray[np.float64]

class Axes:
    def __init__(self) -> None: ...
    def add(
        self,
        name: str,
        group: str,
        rate_hz: float,
        rates_arcsec_s: NDArray[np.float64],
        mode: Optional[NDArray[np.int8]],
        bridged_arcsec_s: Optional[NDArray[np.float64]],
    ) -> None: ...

class CheckedConfig:
    def __init__(self, settings: list[tuple[str, str]], sets: list[str] = []) -> None: ...
    @staticmethod
    def of_layers(toml: str, source: str, sets: list[str]) -> CheckedConfig: ...
    @staticmethod
    def of_log(settings: list[tuple[str, str]], name: str) -> CheckedConfig: ...
    def given(self) -> list[str]: ...
    def toml(self) -> str: ...
    def settings(self) -> list[tuple[str, str]]: ...

class ClosedLoop:
    def __init__(self, config: CheckedConfig, motion: Optional[Motion]) -> None: ...
    def advance(self, halves: int, light: bool, progress: Any) -> dict[str, Any]: ...

class ConfigError(Error, ValueError): ...

class Control:
    def __init__(self, config: CheckedConfig) -> None: ...
    def initial_actuator(self) -> ActuatorFrame: ...
    def step(self, frame: SensorFrame) -> ControlOutput: ...

class ControlOutput:
    @property
    def actuator(self) -> ActuatorFrame: ...
    @property
    def record(self) -> HalfRecord: ...
    @property
    def health(self) -> int: ...

class DesignError(Error, ValueError): ...

class DeviationOptions:
    def __init__(
        self,
        confidence: float,
        least_known_ratio: float,
        noise: Optional[int],
        bias: str,
        threads: int,
    ) -> None: ...

class DeviationStream:
    def __init__(
        self,
        rate_hz: float,
        data_type: str,
        unit: str,
        kinds: list[str],
        factors: list[int],
        window: int,
        least_known_ratio: float,
    ) -> None: ...
    @staticmethod
    def of_log(
        path: str,
        kinds: list[str],
        factors: list[int],
        window: int,
        least_known_ratio: float,
        final_angles: bool,
    ) -> DeviationStream: ...
    def add(self, values: NDArray[np.float64], valid: Optional[NDArray[np.uint8]]) -> None: ...
    def curve(self, kind: str, confidence: float, noise: Optional[int]) -> dict[str, Any]: ...
    @property
    def n_samples(self) -> int: ...
    @property
    def n_known(self) -> int: ...
    @property
    def memory_bytes(self) -> int: ...

class Error(Exception): ...

class FormatError(Error, ValueError): ...

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

class Line:
    def __init__(self, source: str, baud: int, duration_s: Optional[float]) -> None: ...
    def batch(self, most_rows: int, patience_s: float) -> Optional[dict[str, Any]]: ...
    def stop(self) -> None: ...
    def summary(self) -> dict[str, Any]: ...

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

version: str

class NoiseTerms:
    def __init__(self) -> None: ...
    quantisation_arcsec: float
    angle_random_walk_arcsec_sqrt_s: float
    bias_instability_arcsec_s: float
    rate_random_walk_arcsec_s_sqrt_s: float
    ramp_arcsec_s2: float
    markov: list[tuple[float, float]]
    sines: list[tuple[float, float]]
    def allan_variance(self, tau_s: ArrayLike) -> NDArray[np.float64]: ...
    def rate_spectrum(self, frequency_hz: ArrayLike, rate_hz: float) -> NDArray[np.float64]: ...

class Samples:
    def __init__(
        self,
        values: NDArray[np.float64],
        rate_hz: float,
        data_type: str,
        unit: str,
        valid: Optional[NDArray[np.uint8]],
    ) -> None: ...

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

class Twin:
    def __init__(self, config: CheckedConfig, motion: Optional[Motion] = None) -> None: ...
    def advance(self, actuator: ActuatorFrame) -> tuple[SensorFrame, TwinTruth]: ...

class TwinTruth:
    @property
    def dtheta_arcsec(self) -> float: ...
    @property
    def false_relock_arcsec(self) -> float: ...
    @property
    def detuning_end_lambda(self) -> float: ...
    @property
    def perimeter_v(self) -> float: ...
    @property
    def rounding_arcsec(self) -> float: ...
    @property
    def random_walk_arcsec(self) -> float: ...
    @property
    def lit(self) -> bool: ...

angle_flags: dict[str, int]

def analyze(
    config: CheckedConfig,
    axes: Axes,
    settling_samples: int,
    threads: int,
    progress: Any,
) -> dict[str, Any]: ...

def angle_settings(config: CheckedConfig) -> list[tuple[str, str]]: ...

def calibrate(
    names: list[str],
    held: dict[str, dict[str, Any]],
    rate_arcsec_s: list[float],
    said: CheckedConfig,
    progress: Any,
) -> dict[str, Any]: ...

def calibrated_by_laser(config: CheckedConfig) -> CheckedConfig: ...

def compensate(
    columns: dict[str, Any],
    config: CheckedConfig,
    settings: list[tuple[str, str]],
    timer_hz: float,
    progress: Any,
) -> dict[str, Any]: ...

def config_keys() -> list[dict[str, Any]]: ...

def data_sheet(terms: NoiseTerms) -> dict[str, Any]: ...

def design_gyro(config: CheckedConfig) -> dict[str, Any]: ...

default_baud: int

def deviation(
    kind: str,
    samples: Samples,
    taus: Union[str, list[float]],
    per_decade: int,
    drop_long_taus: bool,
    options: DeviationOptions,
) -> dict[str, Any]: ...

def discrete_noise(terms: NoiseTerms, rate_hz: float) -> dict[str, Any]: ...

def drift_arcsec_s(config: CheckedConfig, run_s: float, interval_s: ArrayLike, method: str) -> NDArray[np.float64]: ...

def fit_noise(
    samples: Samples,
    markov: bool,
    most_sines: int,
    least_known_ratio: float,
    threads: int,
) -> dict[str, Any]: ...

health_bits: dict[str, int]

def imu_yaml(terms: NoiseTerms, rate_hz: float) -> str: ...

line_flags: dict[str, int]

def line_settings() -> list[tuple[str, str]]: ...

def log_kind(path: str) -> str: ...

not_measured: int

def optimum(config: CheckedConfig, run_s: float, method: str) -> tuple[float, float, str]: ...

def paper(config: CheckedConfig, threads: int, switches_per_point: int, progress: Any) -> dict[str, Any]: ...

def rate_table(
    input_arcsec_s: NDArray[np.float64],
    output: NDArray[np.float64],
    settling_samples: int,
    earth_arcsec_s: float,
) -> dict[str, Any]: ...

def read_angles(path: str, progress: Any) -> dict[str, Any]: ...

def read_imu_yaml(path: str) -> tuple[NoiseTerms, float]: ...

def read_raw(path: str, light: bool, progress: Any) -> dict[str, Any]: ...

def read_sweep(path: str) -> tuple[str, list[tuple[str, str, Any]]]: ...

def read_text_columns(
    path: str, columns: list[str], comment: str, skip_lines: int, separator: str, decimal: str
) -> list[NDArray[np.float64]]: ...

def relock(config: CheckedConfig, miss_lambda: float, ticks: int) -> dict[str, Any]: ...

def resolved(config: CheckedConfig) -> tuple[CheckedConfig, list[str], list[str]]: ...

def run(
    config: CheckedConfig,
    warnings: list[str],
    raw: bool,
    angles: bool,
    page: bool,
    threads: int,
    progress: Any,
) -> dict[str, Any]: ...

def run_ticks(config: CheckedConfig, motion: Optional[Motion]) -> int: ...

def spectrogram(
    rates_arcsec_s: NDArray[np.float64],
    rate_hz: float,
    piece: int,
    least_known_ratio: float,
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]: ...

def sobol(
    samples: NDArray[np.float64],
    values: NDArray[np.float64],
    n_resamples: int,
    seed: int,
) -> dict[str, Any]: ...

def split_modes(
    rates_arcsec_s: NDArray[np.float64],
    mode: NDArray[np.int8],
    rate_hz: float,
    bridged_arcsec_s: Optional[NDArray[np.float64]],
    settling_samples: int,
) -> dict[str, Any]: ...

def substitution_response(
    order: int,
    gap_ticks: int,
    points: tuple[int, int, int],
    extrapolate: bool,
    tick_s: float,
    frequency_hz: ArrayLike,
) -> NDArray[np.float64]: ...

def sweep(
    description: str,
    source_name: str,
    out: str,
    part: int,
    parts: int,
    threads: int,
    force: bool,
    progress: Any,
) -> list[tuple[str, str, Any]]: ...

def terms_of_sheet(
    quantisation_arcsec: float,
    angle_random_walk_deg_sqrt_h: float,
    bias_instability_deg_h: float,
    rate_random_walk_deg_h_sqrt_h: float,
    ramp_deg_h_h: float,
) -> NoiseTerms: ...

timer_hz: float
format_version: int

def welch_spectrum(
    rates_arcsec_s: NDArray[np.float64],
    rate_hz: float,
    piece: int,
    least_known_ratio: float,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...

def without_switching(config: CheckedConfig) -> CheckedConfig: ...

def write_angles(
    path: str,
    columns: dict[str, Any],
    tick_s: float,
    settings: list[tuple[str, str]],
    force: bool,
    progress: Any,
) -> None: ...

def write_raw(
    path: str,
    columns: dict[str, Any],
    settings: list[tuple[str, str]],
    timer_hz: float,
    force: bool,
    progress: Any,
) -> None: ...

def write_text(path: str, text: str, force: bool) -> None: ...
