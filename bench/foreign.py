#!/usr/bin/env python3
"""What `zlg import` and `zlg analyze` take for a long log of another program: processor time and memory.

usage: bench/foreign.py [--zlg PROGRAM] [--zlg-allan PROGRAM] [--rows N]

Of N rows of times and rates as CSV, and as MATLAB 5 with and without compression. Analysis is compared with the same deviation of the
same numbers by the library alone (zlg_allan, from the target zlg_bench). Needs NumPy and SciPy. Exit 1 where a bound is not met.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BYTES_A_ROW = {"import": 0, "analyze": 8}  # one column
MOST_OVER_MB = {"import": 60.0, "analyze": 50.0}
MOST_TIMES_DEVIATIONS = 3.0
# In a process of its own: what this one held would count as memory of those that it starts.
MAKE = """
import sys, numpy, scipy.io
folder, n = sys.argv[1], int(sys.argv[2])
w = numpy.random.default_rng(3).normal(0.003, 0.05, n)
w.tofile(folder + "/w.raw")
numpy.savetxt(folder + "/w.csv", numpy.transpose([numpy.arange(n) * 0.005, w]), "%.3f,%.6f", header="t_s,rate_deg_s", comments="")
for name, packed in (("w.mat", False), ("packed.mat", True)):
    scipy.io.savemat(f"{folder}/{name}", {"t_s": numpy.arange(n) * 0.005, "rate_deg_s": w}, do_compression=packed)
"""


def cost(*arguments):
    """Processor seconds and the most memory, MB, of a program that must succeed."""
    child = subprocess.Popen([str(a) for a in arguments], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    error = child.stderr.read().decode()
    _, status, usage = os.wait4(child.pid, 0)
    if status != 0:
        raise SystemExit(f"bench/foreign.py: {' '.join(map(str, arguments))}: {error}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024e-6


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--zlg", default=ROOT / "build/release/bin/zlg")
    options.add_argument("--zlg-allan", default=ROOT / "build/release/bin/zlg_allan")
    options.add_argument("--rows", type=int, default=10_000_000)
    options = options.parse_args()
    good = True
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-c", MAKE, folder, str(options.rows)], check=True)
        out = ["--out", f"{folder}/a.h5", "--force"]
        for name, verb, rest in (("w.csv", "import", out), ("w.mat", "import", out), ("packed.mat", "import", out),
                                 ("w.mat", "analyze", []), ("packed.mat", "analyze", []), ("w.csv", "analyze", [])):
            seconds, megabytes = cost(options.zlg, verb, f"{folder}/{name}", *rest)
            met = megabytes <= BYTES_A_ROW[verb] * options.rows * 1e-6 + MOST_OVER_MB[verb]
            good = good and met
            print(f"{verb} {name}, {options.rows} rows: {seconds:.2f} s, {megabytes:.0f} MB{'' if met else '  <-- NOT MET'}")
        reading, _ = cost(options.zlg, "import", f"{folder}/w.csv", "--strict")
        alone = json.loads(subprocess.run([options.zlg_allan, f"{folder}/w.raw", "oadev", "0", "2"], capture_output=True, check=True).stdout)
        times = (seconds - reading) / alone["processor_s"]
        met = times <= MOST_TIMES_DEVIATIONS
        print(f"analysis without reading: {seconds - reading:.2f} s, {times:.1f} times the deviations alone{'' if met else '  <-- NOT MET'}")
    return 0 if good and met else 1


if __name__ == "__main__":
    sys.exit(main())
