"""Golden traces: the numbers of a few short runs, kept beside the tests, so that a change of results shows in the diff.

usage: python3 tests/cli/test_golden.py renew        write the traces anew; say in the commit why they changed

A trace is a table of quantity, value, tolerance. The tolerance, absolute, leaves room for the last digits of the elementary functions of
another C library; a tolerance that was edited by hand is kept when the trace is renewed.
"""

import csv
import json
import math
import sys
import tempfile
import unittest
from pathlib import Path

from support import CliTest, run

TRACES = Path(__file__).parent / "golden"
RELATIVE_TOLERANCE = 1e-4
SWITCHED = ["--set", "switching.interval_s=15"]


def numbers(value, name=""):
    """Every finite number of a JSON value with its path, `switches.0.error_arcsec`, but for the configuration and long lists."""
    if isinstance(value, bool) or value is None or isinstance(value, str):
        return
    if isinstance(value, (int, float)):
        if math.isfinite(value):
            yield name, value
        return
    if isinstance(value, list) and len(value) > 10:
        return
    for key, part in value.items() if isinstance(value, dict) else enumerate(value):
        if key not in ("config", "version", "file", "files", "seconds"):
            yield from numbers(part, f"{name}.{key}" if name else str(key))


def result(*arguments):
    done = run(*arguments, "--json")
    if done.returncode:
        raise RuntimeError(f"zlg {' '.join(map(str, arguments))}: {done.stderr}")
    return json.loads(done.stdout)


def run_averaged(folder):
    return result("run", "--duration", 120, "--seed", 5, *SWITCHED, "--format", "csv", "--out", folder / "run")


def run_laser(folder):
    return result("run", "--duration", 60, "--seed", 5, *SWITCHED, "--set", "gyro.fidelity=laser", "--out", folder / "run")


def calibrate(folder):
    rest = ["--set", "motion.kind=rest", "--set", "switching.interval_s=2", "--set", "drift.thermal_time_s=50"]
    run("simulate", "--duration", 200, "--seed", 5, *rest, "--out", folder / "raw.csv")
    return result("calibrate", folder / "raw.csv")


def analyze(folder):
    run("run", "--duration", 600, "--seed", 5, *SWITCHED, "--set", "motion.kind=rest", "--format", "csv", "--out", folder / "run")
    return result("analyze", folder / "run" / "angles.csv")


MADE_BY = {make.__name__: make for make in (run_averaged, run_laser, calibrate, analyze)}


def trace_of(name, folder):
    return dict(numbers(MADE_BY[name](Path(folder))))


def kept(name):
    """quantity -> (value, tolerance) of a kept trace; empty where there is none."""
    path = TRACES / f"{name}.csv"
    if not path.exists():
        return {}
    with path.open(newline="") as file:
        return {row["quantity"]: (float(row["value"]), float(row["tolerance"])) for row in csv.DictReader(file)}


def default_tolerance(value):
    return float(f"{RELATIVE_TOLERANCE * abs(value):.1g}") or 1e-9


def renew(name):
    before = kept(name)
    with tempfile.TemporaryDirectory() as folder:
        now = trace_of(name, folder)
    with (TRACES / f"{name}.csv").open("w", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(["quantity", "value", "tolerance"])
        for quantity, value in now.items():
            was, tolerance = before.get(quantity, (value, None))
            edited = tolerance is not None and tolerance != default_tolerance(was)
            rows.writerow([quantity, f"{value:.10g}", repr(tolerance if edited else default_tolerance(value))])


class Golden(CliTest):
    def expect(self, name):
        expected, now = kept(name), trace_of(name, self.folder)
        self.assertEqual(sorted(now), sorted(expected), f"{name}: other quantities than the trace has")
        off = [f"{q}: {now[q]!r}, the trace has {value!r} +- {tolerance!r}" for q, (value, tolerance) in expected.items()
               if abs(now[q] - value) > tolerance]
        self.assertEqual(off, [], f"{name}: {len(off)} of {len(expected)} quantities changed")

    def test_run_of_the_averaged_twin(self):
        self.expect("run_averaged")

    def test_run_of_the_laser_twin(self):
        self.expect("run_laser")

    def test_calibration(self):
        self.expect("calibrate")

    def test_analysis(self):
        self.expect("analyze")


if __name__ == "__main__":
    if sys.argv[1:] == ["renew"]:
        for trace in MADE_BY:
            renew(trace)
    else:
        unittest.main()
