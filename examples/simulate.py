"""Ten minutes of the paper's gyro: what its processor records around one switch of the mode.

usage: simulate.py [PICTURE]
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import zlg

config = zlg.Config.of("run.duration_s=600", "motion.kind=rest")
run = zlg.simulate(config)
raw = run.raw

opened = int(np.flatnonzero(~raw.loop_closed)[0])
shown = slice(opened - 10, opened + 40)
half_ms = 1e3 * config.gyro.tick_s / 2
end_ms = half_ms * (np.arange(len(raw))[shown] - opened + 1)

figure, (top, middle, bottom) = plt.subplots(3, 1, sharex=True, figsize=(8, 8), constrained_layout=True)
top.step(end_ms, raw.piezo_v[shown], where="pre")
top.set_ylabel("piezo, V")
middle.plot(end_ms - half_ms / 2, raw.detuning_lambda[shown], ".-", label="measured, mean of the half")
middle.plot(end_ms, run.truth_detuning_end_lambda[shown], label="true, at its end")
middle.set_ylabel("detuning, wavelengths")
middle.legend()
bottom.step(end_ms, np.abs(raw.counts[shown]), where="pre")
bottom.set_ylabel("counts of a half, magnitude")
bottom.set_xlabel("time since the loop was opened, ms")
for axes in (top, middle, bottom):
    axes.axvspan(0, 1e3 * config.gyro.tick_s * config.switching.gap_ticks, color="0.9")
    axes.grid(alpha=0.3)
figure.suptitle("A switch of the mode: the perimeter moves by half a wavelength")
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "simulate.png", dpi=100)
