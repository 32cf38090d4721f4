#!/usr/bin/env python3
"""Time `zlg process` beside what any tool must do: read the log's columns and write some.

usage: bench/process.py [--zlg PROGRAM] [--csv-duration SECONDS] [--hdf5-duration SECONDS] [--pairs N]

CSV to CSV against pandas read_csv and to_csv, HDF5 to HDF5 against h5py reading and writing. The reference first reads all
columns of the raw log and writes the columns of the angle log, which is the work of `process` without its arithmetic. Times are processor
time, of zlg as a whole process, of the reference without the start of Python.
Needs pandas and h5py. Exit 1 where a speed is below what is allowed.
"""

import argparse
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import pandas as pd

ROOT = Path(__file__).resolve().parent.parent
LEAST_CSV = 2.5  # times as fast as pandas
LEAST_HDF5 = 0.25  # of the speed of h5py


def processor_seconds():
    """Of this process and of those that it has called."""
    return sum(usage.ru_utime + usage.ru_stime
               for usage in map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)))


def seconds(work):
    start = processor_seconds()
    work()
    return processor_seconds() - start


def zlg(program, *arguments):
    run = subprocess.run([str(program), *map(str, arguments)], capture_output=True, text=True, check=False)
    if run.returncode != 0:
        raise SystemExit(f"process.py: zlg {' '.join(map(str, arguments))}: exit {run.returncode}\n{run.stderr}")


def columns_of(path, group):
    """All columns of a group as arrays, with what is needed to write them the same way again."""
    with h5py.File(path, "r") as file:
        return {name: (d[:], d.chunks, d.compression, d.compression_opts, d.shuffle) for name, d in file[group].items()
                if isinstance(d, h5py.Dataset) and d.ndim == 1}


def write_columns(path, group, columns):
    with h5py.File(path, "w") as file:
        for name, (values, chunks, compression, level, shuffle) in columns.items():
            file.create_dataset(f"{group}/{name}", data=values, chunks=chunks, compression=compression,
                                compression_opts=level, shuffle=shuffle)


def read_csv(path):
    return pd.read_csv(path, comment="#")


def compare(what, pairs, process, reference, least):
    """Print how many times as fast as the reference `process` is; the median of pairs, after one to warm up."""
    ratios, own, other = [], [], []
    for k in range(pairs + 1):
        other_s, own_s = seconds(reference), seconds(process)
        if k > 0:
            ratios.append(other_s / own_s)
            own.append(own_s)
            other.append(other_s)
    ratio = statistics.median(ratios)
    print(f"{what}: {ratio:.2f} times the reference's speed ({min(ratios):.2f}..{max(ratios):.2f}); allowed {least:g}; "
          f"zlg {min(own):.2f} s, reference {min(other):.2f} s")
    return ratio >= least


def run_csv(program, folder, pairs):
    raw, angles, copy = folder / "raw.csv", folder / "angles.csv", folder / "copy.csv"
    process = lambda: zlg(program, "process", raw, "--out", angles, "--force")
    process()
    table = read_csv(angles)

    def same_work():
        read_csv(raw)
        table.to_csv(copy, index=False)

    return compare("CSV to CSV, pandas reads raw and writes angles", pairs, process, same_work, LEAST_CSV)


def run_hdf5(program, folder, pairs):
    raw, angles, copy = folder / "raw.h5", folder / "angles.h5", folder / "copy.h5"
    process = lambda: zlg(program, "process", raw, "--out", angles, "--force")
    process()
    table = columns_of(angles, "angles")

    def same_work():
        columns_of(raw, "raw")
        write_columns(copy, "angles", table)

    return compare("HDF5 to HDF5, h5py reads raw and writes angles", pairs, process, same_work, LEAST_HDF5)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--zlg", type=Path, default=ROOT / "build" / "release" / "bin" / "zlg")
    parser.add_argument("--csv-duration", type=float, default=1800.0, help="length of the log, seconds")
    parser.add_argument("--hdf5-duration", type=float, default=7200.0, help="so long that the program's start is short")
    parser.add_argument("--pairs", type=int, default=3)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for suffix, duration in (("csv", options.csv_duration), ("h5", options.hdf5_duration)):
            zlg(options.zlg, "simulate", "--duration", duration, "--out", folder / f"raw.{suffix}")
            print(f"raw.{suffix}: {duration:g} s, {(folder / f'raw.{suffix}').stat().st_size / 1e6:.0f} MB")
        good = run_csv(options.zlg, folder, options.pairs)
        good = run_hdf5(options.zlg, folder, options.pairs) and good
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
