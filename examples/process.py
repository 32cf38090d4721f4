"""A raw log through the compensation: written, read again, compensated in two ways, beside the true angle.

usage: process.py [PICTURE]
"""

import pathlib
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import zlg

config = zlg.Config.of("run.duration_s=600", "switching.interval_s=60")
run = zlg.simulate(config)

with tempfile.TemporaryDirectory() as folder:
    path = pathlib.Path(folder) / "raw.h5"
    zlg.logs.write_raw(path, run.raw)
    raw = zlg.logs.read_raw(path)

figure, (top, bottom) = plt.subplots(2, 1, figsize=(8, 7), constrained_layout=True)
for label, settings in {
    "nothing subtracted after a switch": {"relock": "none"},
    "mean_square": {"relock": "mean_square"},
}.items():
    angles = zlg.compensate(raw, raw.config.with_(compensation=settings))
    angles.truth_dtheta_arcsec = run.true_tick_arcsec
    top.plot(angles.t_s, angles.error_arcsec, label=label)
    print(f"{label}: {angles.error_arcsec[-1]:.2f} arcsec after {angles.t_s[-1]:.0f} s")
top.set_xlabel("time, s")
top.set_ylabel("angle error, arcsec")
top.legend()

first = int(np.flatnonzero(~angles.measured)[0])
shown = slice(first - 15, first + 20)
t_ms = 1e3 * (angles.t_s[shown] - angles.t_s[first])
bottom.plot(t_ms, angles.truth_dtheta_arcsec[shown], color="0.6", label="true")
bottom.plot(t_ms, angles.dtheta_arcsec[shown], "x", label="delivered in real time")
bottom.plot(t_ms, angles.dtheta_final_arcsec[shown], ".", label="final")
bottom.set_xlabel("time since the gap began, ms")
bottom.set_ylabel("increment of a tick, arcsec")
bottom.legend()
for axes in (top, bottom):
    axes.grid(alpha=0.3)
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "process.png", dpi=100)
