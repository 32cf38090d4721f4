"""A sweep: how the error of a switch depends on the frequency of the motion, for two bridges.

usage: sweep.py [PICTURE]
"""

import sys
from concurrent.futures import ThreadPoolExecutor

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import zlg

config = zlg.Config.of("run.duration_s=400", "switching.interval_s=10", "compensation.relock=mean_square")
frequencies_hz = np.round(np.geomspace(1.0, 60.0, 13) + 0.137, 3)
bridges = ("quadratic", "auto")


def switch_rms_arcsec(case):
    bridge, frequency_hz = case
    changed = config.with_(compensation={"bridge": bridge}, motion={"frequency_hz": [frequency_hz]})
    return zlg.run(changed, angles=False)["configured"].switch_rms_arcsec


# The interpreter is released in a run, so that two threads keep two processors busy.
with ThreadPoolExecutor(2) as pool:
    cases = [(bridge, frequency) for bridge in bridges for frequency in frequencies_hz]
    rms_arcsec = np.reshape(list(pool.map(switch_rms_arcsec, cases)), (len(bridges), -1))

figure, axes = plt.subplots(figsize=(8, 5), constrained_layout=True)
for bridge, values in zip(bridges, rms_arcsec):
    axes.loglog(frequencies_hz, values, ".-", label=bridge)
theory = 12000.0 / np.sqrt(2) * zlg.design.substitution_response(frequencies_hz, order=2)
axes.loglog(frequencies_hz, theory, "k--", lw=1, label="quadratic, theory without noise")
axes.set_ylim(0.3, None)
axes.set_xlabel("frequency of the motion, Hz")
axes.set_ylabel("error per switch, arcsec rms")
axes.set_title("12 000 arcsec/s, gap of 3 ticks")
axes.grid(alpha=0.3, which="both")
axes.legend()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "sweep.png", dpi=100)
