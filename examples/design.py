"""How long between two switches? The drift budget for three lengths of run, and where it is least.

usage: design.py [PICTURE]
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import zlg

config = zlg.Config.of("design.switch_error_arcsec=2")
figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.5), constrained_layout=True)
for run_s in (600.0, 3600.0, 36000.0):
    interval_s = np.geomspace(3.0, run_s, 300)
    (line,) = left.loglog(interval_s, zlg.design.drift_arcsec_s(interval_s, run_s, config), label=f"run of {run_s:.0f} s")
    best = zlg.design.optimum(run_s, config)
    left.plot(best.interval_s, best.drift_arcsec_s, "o", color=line.get_color())
    print(f"{run_s:6.0f} s: switch every {best.interval_s:.1f} s, drift {best.drift_arcsec_s:.4f} deg/h")
left.set_xlabel("interval between switches, s")
left.set_ylabel("drift, deg/h")
left.legend()

frequency_hz = np.linspace(0.1, 60.0, 400)
for order, name in enumerate(("constant", "linear", "quadratic")):
    if order != 1:  # with points symmetric about the gap linear is constant
        worst = 12000.0 * zlg.design.substitution_response(frequency_hz, order)
        right.semilogy(frequency_hz, worst, label=name)
right.set_xlabel("frequency of the motion, Hz")
right.set_ylabel("worst error of one gap, arcsec")
right.set_ylim(1e-3, 1e3)
right.set_title("12 000 arcsec/s, gap of 3 ticks")
right.legend()
for axes in (left, right):
    axes.grid(alpha=0.3, which="both")
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "design.png", dpi=100)
