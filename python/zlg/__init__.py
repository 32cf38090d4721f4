"""zlg: a Zeeman laser gyro that switches its mode, its processor, and the analysis of its noise.

    import zlg
    result = zlg.run(zlg.Config.of("run.duration_s=600"))

Modules: `acceptance`, `config`, `logs`, `twin`, `core`, `rig`, `design`, `analysis`, `calibration`, `line`, `study`, `sweeps`. Arrays are NumPy's; what C++ computed is handed over
without a copy, and contiguous arrays of the right type are read where they are. Names carry their unit; 1 arcsec/s is 1 deg/h.
Long calls release the interpreter. `run`, `simulate`, `compensate`, `calibrate`, `analyze`, `sweep` and the readers and writers of logs
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
from . import acceptance as acceptance, analysis as analysis, calibration as calibration, config as config, core as core
from . import design as design, line as line, logs as logs, rig as rig, study as study, sweeps as sweeps, twin as twin
from ._zlg import ConfigError as ConfigError, DesignError as DesignError, Error as Error, FormatError as FormatError
from ._zlg import IoError as IoError, MappingError as MappingError, SeriesError as SeriesError
from .acceptance import Acceptance as Acceptance, accept as accept
from .calibration import Calibration as Calibration, calibrate as calibrate
from .config import Config as Config
from .line import follow as follow
from .rig import simulate as simulate
from .core import compensate as compensate
from .study import RunResult as RunResult, analyze as analyze, read as read, run as run
from .sweeps import read_sweep as read_sweep, sweep as sweep

__version__: str = _zlg.version
