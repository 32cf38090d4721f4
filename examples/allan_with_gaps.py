"""Allan deviation of a log with gaps: counted as missing, beside what one gets by closing them up or filling them.

usage: allan_with_gaps.py [PICTURE]
"""

import pathlib
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from zlg import analysis, core, logs

# A gyro with white rate noise and a random walk of the rate, 10 samples a second, that loses data now and then.
rate_hz = 10.0
truth = analysis.terms_of_data_sheet(angle_random_walk_deg_sqrt_h=0.003, rate_random_walk_deg_h_sqrt_h=1.0)
noise = analysis.discrete_noise(truth, rate_hz)
random = np.random.default_rng(8)
n = 200_000
rates = random.normal(0.0, noise.white_rate_arcsec_s, n) + np.cumsum(random.normal(0.0, noise.walk_step_arcsec_s, n))
flags = np.zeros(n, dtype=np.uint32)
for start in random.integers(0, n - 3000, 50):
    flags[start : start + random.integers(1, 3000)] = core.angle_flags["invalid"]

# Its angle log, as it would come from the laboratory: a tick that is flagged is a missing sample.
with tempfile.TemporaryDirectory() as folder:
    path = pathlib.Path(folder) / "angles.h5"
    turned = np.where(flags == 0, rates / rate_hz, 0.0)
    sigma = np.full(n, noise.white_increment_arcsec)
    logs.write_angles(path, logs.AngleLog(turned, turned, sigma, np.ones(n), flags, tick_s=1 / rate_hz))
    log = logs.read_angles(path)

gaps = analysis.deviations_of_log(log, "oadev", confidence=0.95)
valid, measured = log.measured, log.dtheta_final_arcsec[log.measured]
said = {"rate_hz": 1 / log.tick_s, "data_type": "increments", "unit": "arcsec"}
closed = analysis.deviation("oadev", measured, **said)
filled = analysis.deviation("oadev", np.interp(np.arange(n), np.flatnonzero(valid), measured), **said)
fit = analysis.fit_noise(log.dtheta_final_arcsec, valid=valid, **said)
for term in fit.fitted:
    if term.found:
        print(f"{term.name}: {term.value:.4g} +- {term.sigma:.2g} {term.unit}")

figure, axes = plt.subplots(figsize=(8, 6), constrained_layout=True)
bars = [gaps.deviation - gaps.low, gaps.high - gaps.deviation]
axes.errorbar(gaps.tau_s, gaps.deviation, bars, fmt="o", capsize=3, label="missing samples not counted, 95 %")
axes.loglog(closed.tau_s, closed.deviation, "v", mfc="none", label="gaps closed up")
axes.loglog(filled.tau_s, filled.deviation, "^", mfc="none", label="gaps interpolated")
axes.loglog(gaps.tau_s, np.sqrt(truth.allan_variance(gaps.tau_s)), "k", lw=1, label="the gyro's own")
axes.loglog(gaps.tau_s, np.sqrt(fit.terms.allan_variance(gaps.tau_s)), "k--", lw=1, label="fitted")
axes.set_yticks([0.05, 0.1, 0.2, 0.5], ["0.05", "0.1", "0.2", "0.5"])
axes.set_xlabel("tau, s")
axes.set_ylabel("overlapping Allan deviation, deg/h")
axes.set_title(f"{100 * (1 - valid.mean()):.0f} % of the samples missing")
axes.grid(alpha=0.3, which="both")
axes.legend()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "allan_with_gaps.png", dpi=100)
