"""Runs the program, writes raw logs, reads angle logs."""

import csv
import os
from pathlib import Path
import random
import re
import signal
import subprocess
import tempfile
import threading
import time
import unittest

ROOT = Path(__file__).resolve().parents[2]
ZLG = Path(os.environ.get("ZLG", ROOT / "build" / "release" / "bin" / "zlg"))

REQUIRED = ["half", "bias_sign", "mode", "counts", "loop_closed"]
OPTIONAL = ["valid", "detuning_lambda", "detuning_sq_lambda2", "piezo_v", "temperature_c"]

# Under nohup the programs that a test starts would ignore it. On a busy machine xdist may run the tests in another thread
# than the main one, which alone may change that.
if threading.current_thread() is threading.main_thread():
    signal.signal(signal.SIGHUP, signal.SIG_DFL)


def run(*arguments, **options):
    """The program's exit code, stdout and stderr as text."""
    options.setdefault("timeout", 300)
    options.setdefault("stdout", subprocess.PIPE)
    options.setdefault("stdin", subprocess.DEVNULL)
    return subprocess.run([str(ZLG), *map(str, arguments)], stderr=subprocess.PIPE, text=True, errors="replace", **options)


def wait_until(is_so, child=None, most_s=60):
    """Until `is_so()`; an error where it is not within that time, or not before the child has ended."""
    end = time.monotonic() + most_s
    while not is_so():
        assert child is None or child.poll() is None or is_so(), f"the program has ended, {child.returncode}"
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.001)


def folder_until(add_cleanup):
    """A folder that is there until what `add_cleanup` belongs to, a class of tests or a module, is done."""
    folder = tempfile.TemporaryDirectory(prefix="zlg-cli-")
    add_cleanup(folder.cleanup)
    return Path(folder.name)


def is_larger(path, n_bytes=0):
    return path.exists() and path.stat().st_size > n_bytes


class Text(str):
    """A field of a log as it is."""

    def __repr__(self):
        return str(self)


def complaints(result):
    """Lines of stderr that are not warnings."""
    lines = [line for line in result.stderr.splitlines() if line.strip()]
    return [line for line in lines if not re.match(r"(zlg[^:]*:\s*)?warning\b", line, re.IGNORECASE)]


def warnings(result):
    return [line for line in result.stderr.splitlines() if re.match(r"(zlg[^:]*:\s*)?warning\b", line, re.IGNORECASE)]


def columns_of(rows):
    return [name for name in REQUIRED + OPTIONAL if name in rows[0]]


# What a log must say, or whoever has it processed.
FACTS = {"gyro.tick_s": "0.005", "gyro.scale_arcsec": "3.263"}

SAID = [word for key, value in FACTS.items() for word in ("--set", f"{key}={value}")]


def csv_text(rows, columns=None, lines=(), facts=True):
    """A raw log: `# key = value` lines, header, rows. Reals in the shortest form that reads back.

    facts  with those of the paper's gyro, as far as `lines` have no others
    """
    said = " ".join(lines)
    if facts:
        lines = [*lines, *(f"{key} = {value}" for key, value in FACTS.items() if key.split(".")[1] not in said)]
    columns = columns or columns_of(rows)
    text = [f"# {line}" for line in lines] + [",".join(columns)]
    text += [",".join(repr(row[name]) for name in columns) for row in rows]
    return "\n".join(text) + "\n"


def quiet_log(n_ticks=40, counts=100, bias=150, gap=range(0)):
    """A gyro in uniform rotation: `counts` a half, loop open in the ticks of `gap`."""
    rows = []
    for half in range(2 * n_ticks):
        sign = 1 if half % 2 == 0 else -1
        rows.append({"half": half, "bias_sign": sign, "mode": 1, "counts": counts + sign * bias,
                     "loop_closed": 0 if half // 2 in gap else 1})
    return rows


def set_options(settings):
    """`--set` for every key of an oracle's settings, tick and scale included."""
    gyro = ["tick_s", "scale_arcsec", "bias_hz", "bias_chi", "reference_temperature_c", "bias_temperature_coefficient_per_c"]
    compensation = ["relock", "relock_ticks", "bridge", "extrapolation_points", "points_before", "points_after"]
    options = []
    for section, names in (("gyro", gyro), ("compensation", compensation)):
        for name in names:
            options += ["--set", f"{section}.{name}={getattr(settings, name)}"]
    return options


class AngleLog:
    """An angle log: bits of the flags by name, rows as numbers."""

    def __init__(self, path):
        lines = Path(path).read_text().splitlines()
        self.comments = [line for line in lines if line.startswith("#")]
        body = [line for line in lines if not line.startswith("#")]
        self.bits = {}
        for line in self.comments:
            found = re.match(r"#\s*flags\s*=\s*(.*)", line)
            if found:
                self.bits = {name: int(bit) for name, bit in re.findall(r"(\w+):(\d+)", found.group(1))}
        self.rows = list(csv.DictReader(body))
        self.dtheta = [float(row["dtheta_arcsec"]) for row in self.rows]
        self.final = [float(row["dtheta_final_arcsec"]) for row in self.rows]
        self.sigma = [float(row["sigma_arcsec"]) for row in self.rows]
        self.t_s = [float(row["t_s"]) for row in self.rows]
        self.mode = [int(row["mode"]) for row in self.rows]
        self.flags = [int(row["flags"]) for row in self.rows]

    def has(self, k, name):
        return bool(self.flags[k] & self.bits[name])


def body_of(path):
    """The header and the rows as bytes, without the `#` lines."""
    return b"".join(line for line in Path(path).read_bytes().splitlines(True) if not line.startswith(b"#"))


class CliTest(unittest.TestCase):
    """A test with a folder of its own and a fixed seed of its own."""

    @classmethod
    def setUpClass(cls):
        if not os.access(ZLG, os.X_OK) or ZLG.is_dir():
            raise AssertionError(f"no program at {ZLG}: build the release or set ZLG")

    def setUp(self):
        self.folder = folder_until(self.addCleanup)
        self.random = random.Random(f"{type(self).__name__}.{self._testMethodName}")

    def write(self, name, text):
        path = self.folder / name
        if isinstance(text, bytes):
            path.write_bytes(text)
        else:
            path.write_text(text)
        return path

    def succeed(self, *arguments, **options):
        result = run(*arguments, **options)
        self.assertEqual(result.returncode, 0, f"zlg {' '.join(map(str, arguments))}\nstderr: {result.stderr}")
        return result

    def lack_switches(self, *arguments, **options):
        """More than one switch in ten was withheld or failed: the files are written, and the exit status is 1."""
        result = run(*arguments, **options)
        self.assertEqual(result.returncode, 1, f"zlg {' '.join(map(str, arguments))}\nstderr: {result.stderr}")
        self.assertRegex(result.stderr, r"switch(es)? of modes .*(failed|withheld)")
        return result

    def process(self, rows, settings, columns=None, lines=(), name="log"):
        """`zlg process` on these rows; the angle log."""
        raw = self.write(f"{name}.csv", csv_text(rows, columns, lines, facts=False))
        out = self.folder / f"{name}-angles.csv"
        self.succeed("process", raw, "--out", out, "--force", *set_options(settings))
        return AngleLog(out)

    def refuse(self, codes, *arguments, says=(), **options):
        """The program says no with one line that holds every word of `says`."""
        result = run(*arguments, **options)
        codes = codes if isinstance(codes, tuple) else (codes,)
        called = f"zlg {' '.join(map(str, arguments))}\nexit {result.returncode}, stderr: {result.stderr!r}"
        self.assertIn(result.returncode, codes, f"wrong exit code: {called}")
        self.assertEqual(len(complaints(result)), 1, f"not exactly one line on stderr: {called}")
        for word in says:
            self.assertIn(word, result.stderr, f"the message does not name {word!r}: {called}")
        return result
