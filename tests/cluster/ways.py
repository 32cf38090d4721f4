"""The ways in which a sweep can be run here: zlg on threads, zlg-mpi on ranks, each under its own name for the tests."""

import os
import shutil
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAMS = Path(os.environ.get("ZLG", ROOT / "build" / "release" / "bin" / "zlg")).parent
ZLG = PROGRAMS / "zlg"
ZLG_MPI = PROGRAMS / "zlg-mpi"

# OpenMPI refuses root, and more ranks than cores, unless these allow them; 4 and 5 have other names for most of it.
MPI_ENVIRONMENT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
                   "OMPI_MCA_hwloc_base_binding_policy": "none", "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
                   "OMPI_MCA_orte_execute_quiet": "1", "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe",
                   "PRTE_MCA_hwloc_default_binding_policy": "none"}

SWEEP = """sweep = {{gyros = {gyros}, seed = 7, duration_s = {duration_s}}}
base.switching.interval_s = 2
parameter = [
    {{keys = ["piezo.half_wave_v"], draw = "normal", mean = 40, sd = 1}},
    {{keys = ["compensation.relock"], draw = "list", values = ["mean_square", "detuning"]}},
]
metric = [{{name = "configured.switch_error_rms_arcsec", max = 3}}]
"""


def has_ranks():
    return shutil.which("mpirun") is not None and ZLG_MPI.exists()


def environment():
    return {**os.environ, **MPI_ENVIRONMENT, "PATH": f"{PROGRAMS}:{os.environ['PATH']}"}


def on_threads(n, *arguments):
    return [ZLG, "sweep", *arguments, "--threads", str(n)]


def on_ranks(n, *arguments):
    return ["mpirun", "-np", str(n), ZLG_MPI, "sweep", *arguments]


def of_zlg(stderr):
    """The lines of the program itself; mpirun of OpenMPI 5 has no option to be quiet."""
    return [line for line in stderr.splitlines() if line.startswith("zlg")]


def run(command, **options):
    """stdout, stderr and exit code as text."""
    return subprocess.run(list(map(str, command)), env=environment(), stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          timeout=120, **options)
