"""zlg: a Zeeman laser gyro that switches its mode, its processor, and the analysis of its noise.

    import zlg
    result = zlg.run(zlg.Config.of("run.duration_s=600"))

Modules: `acceptance`, `config`, `logs`, `twin`, `core`, `rig`, `design`, `analysis`, `calibration`, `line`, `study`, `sweeps`. Arrays are NumPy's; what C++ computed is handed over
without a copy, and contiguous arrays of the right type are read where they are. Names carry their unit; 1 arcsec/s is 1 deg/h.
Long calls release the interpreter. `run`, `simulate`, `compensate`, `calibrate`, `paper`, `analyze`, `sweep` and the readers and writers of logs
take `progress`, a function of the fraction done, and end on Ctrl-C, as `follow` does; a deviation, a fit and `design_gyro` go on to their end.
"""

try:
    from . import _zlg
except ImportError as error:
    from importlib.metadata import distributions
    needed = {name for wheel in distributions(name="zlg") for name in wheel.metadata.get_all("Requires-External", [])}
    if not needed:
        raise
    raise ImportError(f"{error}; of Debian the wheel needs: apt install {' '.join(sorted(needed))}") from error
from . import acceptance, analysis, calibration, config, core, design, line, logs, rig, study, sweeps, twin
from ._zlg import ConfigError, DesignError, Error, FormatError, IoError, MappingError, SeriesError
from .acceptance import Acceptance, accept
from .calibration import Calibration, calibrate
from .config import Config
from .line import follow
from .logs import convert
from .rig import simulate
from .core import compensate
from .study import RunResult, analyze, read, run
from .sweeps import read_sweep, sweep

__version__: str = _zlg.version

__all__ = [
    "Acceptance",
    "Calibration",
    "Config",
    "ConfigError",
    "DesignError",
    "Error",
    "FormatError",
    "IoError",
    "MappingError",
    "RunResult",
    "SeriesError",
    "__version__",
    "accept",
    "acceptance",
    "analysis",
    "analyze",
    "calibrate",
    "calibration",
    "compensate",
    "config",
    "convert",
    "core",
    "design",
    "follow",
    "line",
    "logs",
    "read",
    "read_sweep",
    "rig",
    "run",
    "simulate",
    "study",
    "sweep",
    "sweeps",
    "twin",
]
