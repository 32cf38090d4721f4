"""What fills the gap of a switch: three bridges on the records of one and the same run.

usage: compare_bridges.py [PICTURE]
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import zlg

config = zlg.Config.of("run.duration_s=1200", "switching.interval_s=20", "compensation.relock=mean_square")
bridges = ("constant", "quadratic", "auto")
results = {bridge: zlg.run(config.with_(compensation={"bridge": bridge}))["configured"] for bridge in bridges}

figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.5), constrained_layout=True)
for bridge, result in results.items():
    left.plot(result.t_s, result.error_arcsec, label=bridge)
    print(f"{bridge:>10}: {result.switch_rms_arcsec:6.2f} arcsec rms per switch")
left.set_xlabel("time, s")
left.set_ylabel("angle error, arcsec")
left.legend()
right.boxplot([result.switch_error_arcsec for result in results.values()])
right.set_xticklabels(list(results))
right.set_ylabel("error of a switch, arcsec")
for axes in (left, right):
    axes.grid(alpha=0.3)
figure.suptitle("12 000 arcsec/s at 7.03 Hz, a switch every 20 s")
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "compare_bridges.png", dpi=100)
