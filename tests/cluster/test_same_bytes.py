"""A sweep has one result: by parts, threads and ranks, in any order of merging, after kills at random moments."""

import os
import random
import re
import resource
import signal
import subprocess
import time
from pathlib import Path

import pytest

from ways import SWEEP, ZLG, ZLG_MPI, environment, has_ranks, of_zlg, on_ranks, on_threads, run

needs_ranks = pytest.mark.skipif(not has_ranks(), reason="no OpenMPI, or zlg-mpi is not built")

WAYS = [*((on_threads, n) for n in (1, 2, 4)), *(pytest.param(on_ranks, n, marks=needs_ranks) for n in (1, 2, 3, 5))]


@pytest.fixture(scope="module")
def short(tmp_path_factory):
    return described(tmp_path_factory.mktemp("short"), gyros=23, duration_s=10)


@pytest.fixture(scope="module")
def long(tmp_path_factory):
    return described(tmp_path_factory.mktemp("long"), gyros=40, duration_s=400)


def described(folder, **what):
    """A folder with a sweep, sweep.toml, and its result by one thread, whole.h5."""
    (folder / "sweep.toml").write_text(SWEEP.format(**what))
    swept(on_threads(1, folder / "sweep.toml", "--out", folder / "whole.h5"))
    return folder


def started(command, **options):
    options = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, **options}
    return subprocess.Popen(list(map(str, command)), env=environment(), stdin=subprocess.DEVNULL, **options)


def swept(command):
    result = run(command)
    assert result.returncode == 0, result.stderr


def merged(parts, out):
    swept([ZLG, "sweep", "--merge", *parts, "--out", out])
    return out.read_bytes()


@pytest.mark.parametrize("parts", [1, 2, 3, 5])
@pytest.mark.parametrize("way, n", WAYS)
def test_every_way_and_every_number_of_parts_in_any_order(short, tmp_path, way, n, parts):
    whole = (short / "whole.h5").read_bytes()
    files = [tmp_path / f"{k}.h5" for k in range(1, parts + 1)]
    for k, out in enumerate(files, start=1):
        swept(way(n, short / "sweep.toml", "--part", f"{k}/{parts}", "--out", out))
    if parts == 1:
        assert files[0].read_bytes() == whole
    chance = random.Random(100 * n + parts)
    for trial in range(2):
        chance.shuffle(files)
        assert merged(files, tmp_path / f"merged_{trial}.h5") == whole, files


def ranks_of(launcher):
    """Process numbers by rank."""
    found = {}
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            if int((folder / "stat").read_text().rsplit(")", 1)[1].split()[1]) != launcher.pid:
                continue
            words = dict(word.split("=", 1) for word in (folder / "environ").read_text(errors="replace").split("\0") if "=" in word)
            found[int(words["OMPI_COMM_WORLD_RANK"])] = int(folder.name)
        except (OSError, KeyError, ValueError):
            continue
    return found


def is_alive(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


class Killer:
    """Ends sweeps at random moments: the one process of threads, or one rank, the writer, or launcher and ranks."""

    def __init__(self, seed, wanted=20):
        self.wanted = wanted
        self.chance = random.Random(seed)
        self.kills = {"threads": 0, "a rank": 0, "the writer": 0, "all": 0}

    def is_done(self):
        return sum(self.kills.values()) >= self.wanted and min(self.kills.values()) >= 3

    def turn(self, folder, out):
        """One call of the sweep, killed or not."""
        way, n = self.chance.choice([(on_threads, 1), (on_threads, 2), (on_ranks, 2), (on_ranks, 3), (on_ranks, 5), (on_ranks, 1)])
        call = started(way(n, folder / "sweep.toml", "--out", out))
        time.sleep(self.chance.uniform(0.0, 0.3) + (0.3 if way is on_ranks else 0.0))
        ranks = ranks_of(call) if way is on_ranks else {}
        kind, victims = self.victims(call, ranks) if way is on_ranks else ("threads", [call.pid])
        if call.poll() is None and victims:
            for pid in victims:
                kill(pid)
            self.kills[kind] += 1
        wait_for_the_end(call, was_killed=bool(victims))
        # Who is left holds the checkpoint.
        for pid in ranks.values():
            while is_alive(pid):
                time.sleep(0.005)

    def victims(self, call, ranks):
        kind = min(("a rank", "the writer", "all"), key=lambda name: (self.kills[name], name))
        if kind == "a rank":
            return kind, [pid for rank, pid in ranks.items() if rank == max(ranks) and rank > 0]
        if kind == "the writer":
            return kind, [pid for rank, pid in ranks.items() if rank == 0]
        return kind, [call.pid, *ranks.values()]


def kill(pid):
    try:
        os.kill(pid, signal.SIGKILL)
    except ProcessLookupError:
        pass


def wait_for_the_end(call, was_killed):
    """Of a call from which a process was taken, or not."""
    try:
        call.wait(20 if was_killed else 120)
    except subprocess.TimeoutExpired:
        # After a kill within MPI_Init, mpirun of OpenMPI 4.1.4 can end all ranks and then wait for ever for a lock of its own,
        # in PMIx_server_finalize; a program that calls MPI_Init and sleeps is enough for it (docs/sweep.md).
        assert was_killed and not ranks_of(call)
        kill(call.pid)
        call.wait()


@needs_ranks
def test_twenty_kills_at_random_moments_and_another_number_after_each(long, tmp_path):
    whole = (long / "whole.h5").read_bytes()
    killer = Killer(seed=5)
    outs = []
    while not killer.is_done():
        out = tmp_path / f"{len(outs)}.h5"
        outs.append(out)
        while not out.exists() and not killer.is_done():
            killer.turn(long, out)
    for k, out in enumerate(outs):
        swept((on_threads if k % 2 else on_ranks)(2, long / "sweep.toml", "--out", out))
        assert out.read_bytes() == whole, killer.kills
        assert not out.with_name(out.name + ".part").exists()


@needs_ranks
def test_a_call_repeats_nothing_that_was_recorded(long, tmp_path):
    out = tmp_path / "r.h5"
    part = tmp_path / "r.h5.part"
    call = started(on_ranks(3, long / "sweep.toml", "--out", out), stderr=subprocess.PIPE, text=True)
    wait_for_rows(call, part, 1)  # mpirun takes two seconds to hand the signal on, in which fifteen gyros end
    call.send_signal(signal.SIGINT)
    _, stderr = call.communicate(timeout=30)
    recorded = rows_of(part)
    # mpirun of OpenMPI 5 hands on nothing of what ranks say after Ctrl-C.
    if hands_on_last_words():
        assert f"interrupted by a signal; {len(recorded)} of 40 gyros are in {part}, and the same line goes on" in stderr
    again = started(on_ranks(2, long / "sweep.toml", "--out", out))
    wait_for_rows(again, part, len(recorded) + 1)
    seen = rows_of(part)
    again.send_signal(signal.SIGINT)
    again.wait(30)
    assert seen[:len(recorded)] == recorded
    gyros = [row.split("\t")[0] for row in rows_of(part)]
    assert len(gyros) == len(set(gyros))


def hands_on_last_words():
    return re.search(r"Open MPI\)? 4\.", subprocess.run(["mpirun", "--version"], capture_output=True, text=True, check=True).stdout) is not None


def rows_of(part):
    """Whole lines of the checkpoint, behind its head."""
    text = part.read_text()
    body = text[text.index("\nrows\t"):] if "\nrows\t" in text else ""
    return body.split("\n")[2:-1]


def wait_for_rows(call, part, n):
    while not part.exists() or len(rows_of(part)) < n:
        assert call.poll() is None
        time.sleep(0.005)


@needs_ranks
class TestBadInput:
    """One line of one rank, and its exit code."""

    def refused(self, code, says, *arguments):
        result = run(on_ranks(3, *arguments))
        assert (result.returncode, result.stdout) == (code, ""), result.stderr
        assert len(of_zlg(result.stderr)) == 1, result.stderr
        assert says in result.stderr

    def test_of_the_command_line_and_the_description(self, short, tmp_path):
        sweep, out = short / "sweep.toml", tmp_path / "r.h5"
        self.refused(2, "--out is missing", sweep)
        self.refused(2, "none.toml", tmp_path / "none.toml", "--out", out)
        self.refused(2, "--threads", sweep, "--out", out, "--threads", "2")
        (tmp_path / "bad.toml").write_text((short / "sweep.toml").read_text().replace("half_wave_v", "half_wave"))
        self.refused(2, "did you mean half_wave_v?", tmp_path / "bad.toml", "--out", out)
        assert not list(tmp_path.glob("r.h5*"))

    def test_of_files(self, short, tmp_path):
        (tmp_path / "other.toml").write_text((short / "sweep.toml").read_text().replace("seed = 7", "seed = 8"))
        self.refused(3, "has `seed = 7`, this one `seed = 8`", tmp_path / "other.toml", "--out", short / "whole.h5")
        self.refused(3, "there is no folder", short / "sweep.toml", "--out", tmp_path / "no" / "r.h5")
        (tmp_path / "moved.toml").write_text((short / "sweep.toml").read_text().replace(
            "base.", 'base.motion = {kind = "file", path = "none.csv", column = 1, rate_hz = 100}\nbase.'))
        self.refused(3, "none.csv", tmp_path / "moved.toml", "--out", tmp_path / "m.h5")

    def test_of_a_full_disk_which_loses_nothing(self, long, tmp_path):
        out, part = tmp_path / "full.h5", tmp_path / "full.h5.part"
        call = started(on_ranks(3, long / "sweep.toml", "--out", out), stderr=subprocess.PIPE, text=True)
        wait_for_rows(call, part, 3)
        limit = part.stat().st_size + 100
        resource.prlimit(ranks_of(call)[0], resource.RLIMIT_FSIZE, (limit, limit))
        _, stderr = call.communicate(timeout=30)
        assert (call.returncode, of_zlg(stderr)) == (3, [f"zlg: cannot write {part}: File too large"])
        swept(on_ranks(2, long / "sweep.toml", "--out", out))
        assert out.read_bytes() == (long / "whole.h5").read_bytes()
