"""What the best linear estimate of the magnetic angle leaves of it, in fields whose law it knows but for chance.

usage: python3 tests/reference/field_bound.py

Printed are ratios of rms, over the second half of 900 s, to the angle without an estimate: of the covariance of the drift Om given the mean rates
of the segments that have ended (Gaussian processes: Rasmussen and Williams, 2006, ch. 2). 1: nothing can be known.
"""

import numpy as np

RUN_S, STEP_S = 900.0, 2.0
WALK = 0.14  # arcsec/sqrt(s), of the gyro; the rms drift is about 1 arcsec/s
UNKNOWN_RATE = 100.0  # of the base, common to all segments


def sines(low_hz=1e-4, high_hz=1e-2):
    """Covariance of a sine whose frequency is drawn evenly and whose phase is."""
    turn = lambda lag: 2 * np.pi * np.abs(lag) + 1e-12
    return lambda lag: 0.5 * (np.sin(high_hz * turn(lag)) - np.sin(low_hz * turn(lag))) / ((high_hz - low_hz) * turn(lag))


def sine(period_s):
    return lambda lag: 0.5 * np.cos(2 * np.pi * lag / period_s)


def steps(each_s=RUN_S / 6):
    return lambda lag: np.maximum(0, 1 - np.abs(lag) / each_s) / 3


def left_over(covariance, interval_s, scatter):
    """scatter: of the mean rate of the base from segment to segment, arcsec/s rms."""
    t = np.arange(0, RUN_S, STEP_S) + STEP_S / 2
    segment = np.floor(t / interval_s + 0.5).astype(int)  # the first is half as long
    mode = np.where(segment % 2 == 0, 1.0, -1.0)
    drift = covariance(t[:, None] - t)
    in_segment = segment == np.arange(segment[-1] + 1)[:, None]
    ticks = in_segment.sum(axis=1)
    means = in_segment * mode / ticks[:, None]
    read = means @ drift @ means.T + np.diag(WALK**2 / (ticks * STEP_S) + scatter**2) + UNKNOWN_RATE**2
    angle = np.tril(np.ones_like(drift)) * mode * STEP_S
    with_read, before = angle @ drift @ means.T, np.einsum("ij,jk,ik->i", angle, drift, angle)
    after = before.copy()
    for i, ended in enumerate(segment):
        after[i] -= with_read[i, :ended] @ np.linalg.solve(read[:ended, :ended], with_read[i, :ended])
    late = t > RUN_S / 2
    return np.sqrt(after[late].mean() / before[late].mean())


def main():
    periods = (100, 120, 180, 300, 1000, 3000)
    print("interval, s | scatter, arcsec/s | sine of unknown frequency | steps |", " | ".join(f"sine of {p} s" for p in periods))
    for interval in (20, 40, 60, 90):
        for scatter in (0.0, 0.3, 3.0):
            laws = [sines(), steps(), *map(sine, periods)]
            print(interval, scatter, *(f"{left_over(law, interval, scatter):.2f}" for law in laws), sep=" | ")


if __name__ == "__main__":
    main()
