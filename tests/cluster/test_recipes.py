"""The recipes of docs/sweep.md, as they stand there, in a Slurm of this machine's own."""

import re
import subprocess
import time

import pytest

from private_slurm import CannotStart, PrivateSlurm
from ways import ROOT, SWEEP, environment, has_ranks, on_threads, run

DOCUMENT = (ROOT / "docs" / "sweep.md").read_text()
BLOCKS = re.findall(r"^```bash\n(.*?)^```$", DOCUMENT, re.MULTILINE | re.DOTALL)
SCRIPTS = {re.match(r"#!/bin/bash\n# (\S+)\n", block)[1]: block for block in BLOCKS if block.startswith("#!")}
COMMANDS = [block for block in BLOCKS if not block.startswith("#!")]

N_GYROS = 24


@pytest.fixture(scope="module")
def slurm(tmp_path_factory):
    try:
        with PrivateSlurm(tmp_path_factory.mktemp("slurm")) as running:
            running.environment = {**environment(), "SLURM_CONF": running.environment["SLURM_CONF"]}
            yield running
    except CannotStart as why:
        pytest.skip(f"no Slurm can be started here: {why}")


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "tolerances.toml").write_text(SWEEP.format(gyros=N_GYROS, duration_s=200))
    for name, text in SCRIPTS.items():
        (tmp_path / name).write_text(text)
    result = run(on_threads(2, tmp_path / "tolerances.toml", "--out", tmp_path / "here.h5"))
    assert result.returncode == 0, result.stderr
    return tmp_path


def follow(slurm, folder, command, ends_within_s=60):
    """Runs what the document says, and waits for what it has submitted."""
    result = subprocess.run(["bash", "-e", "-c", command], cwd=folder, env=slurm.environment, stdin=subprocess.DEVNULL,
                            capture_output=True, text=True, timeout=90)
    assert result.returncode == 0, result.stderr
    slurm.wait_for_jobs(ends_within_s)


def said(folder):
    """What the jobs have written."""
    return "\n".join(f"{path.name}: {path.read_text()}" for path in sorted(folder.glob("slurm-*.out")))


def with_line(start):
    return next(block for block in COMMANDS if start in block)


def assert_same(folder, name):
    assert (folder / name).exists(), said(folder)
    assert (folder / name).read_bytes() == (folder / "here.h5").read_bytes(), name


def test_every_block_is_followed_by_a_test():
    assert sorted(SCRIPTS) == ["array.sh", "merge.sh", "parts_of_ranks.sh", "ranks.sh"]
    assert len(COMMANDS) == 3


def test_job_array_gives_the_bytes_of_one_machine(slurm, folder):
    follow(slurm, folder, with_line("array.sh"))
    assert_same(folder, "results.h5")
    assert "<svg" in (folder / "results.html").read_text()


def test_job_array_that_was_cancelled_goes_on_where_it_is_submitted_again(slurm, folder):
    submit = subprocess.run(["sbatch", "--parsable", "array.sh"], cwd=folder, env=slurm.environment, capture_output=True, text=True, check=True)
    end = time.monotonic() + 30
    while not list(folder.glob("part_*.h5*")) and time.monotonic() < end:
        time.sleep(0.01)
    subprocess.run(["scancel", "--signal=KILL", "--full", submit.stdout.strip()], env=slurm.environment, check=True)
    subprocess.run(["scancel", submit.stdout.strip()], env=slurm.environment, check=True)
    slurm.wait_for_jobs()
    assert not all((folder / f"part_{k}.h5").exists() for k in (1, 2, 3, 4)), "cancelled too late to show anything"
    follow(slurm, folder, with_line("array.sh"))
    assert_same(folder, "results.h5")


@pytest.mark.skipif(not has_ranks(), reason="no OpenMPI, or zlg-mpi is not built")
def test_mpi_job_gives_the_bytes_of_one_machine(slurm, folder):
    follow(slurm, folder, with_line("ranks.sh"))
    assert_same(folder, "results_of_ranks.h5")


@pytest.mark.skipif(not has_ranks(), reason="no OpenMPI, or zlg-mpi is not built")
def test_array_of_mpi_jobs_gives_the_bytes_of_one_machine(slurm, folder):
    follow(slurm, folder, with_line("parts_of_ranks.sh"))
    assert_same(folder, "results_of_both.h5")
