"""Re-lock transients with a known true angle: what each method leaves of the false angle.

The gyro stands still. Its counter is so fine (and its bias so fast) that rounding does not matter.
"""

import math
import unittest

from oracle import Settings
from support import CliTest

SCALE_ARCSEC = 1e-6
BIAS_HZ = 60e3 * 3.263 / SCALE_ARCSEC
CHI = 3.6
TICK_S = 0.005
GAP = range(30, 33)
N_TICKS = 120
FINE = 400  # integration steps per half


def exponential(miss, tau_s):
    return lambda t: miss * math.exp(-t / tau_s)


def slewing(miss):
    """d(dl)/dt = -min(s, dl/tau): constant slew, then an exponential tail."""
    slew, tail = 0.28 * abs(miss) / TICK_S, 1.1 * TICK_S
    bend = slew * tail
    t_bend = (abs(miss) - bend) / slew
    def detuning(t):
        size = abs(miss) - slew * t if t < t_bend else bend * math.exp(-(t - t_bend) / tail)
        return math.copysign(size, miss)
    return detuning


def means(detuning, t0):
    """Mean and mean square of the detuning over the half that starts at t0, by the midpoint rule."""
    step = TICK_S / 2.0 / FINE
    samples = [detuning(t0 + (m + 0.5) * step) for m in range(FINE)]
    return math.fsum(samples) / FINE, math.fsum(s * s for s in samples) / FINE


def relock_log(detuning, first_sign, mode):
    """Rows of a gyro at rest that loses its loop in GAP and finds it again; the helicity flips there."""
    rows = []
    for half in range(2 * N_TICKS):
        k, sign = half // 2, first_sign if half % 2 == 0 else -first_sign
        helicity = mode if k < GAP.start else -mode
        mean, square = (0.0, 0.0) if k < GAP.stop else means(detuning, (half - 2 * GAP.stop) * TICK_S / 2.0)
        counts = round(sign * helicity * BIAS_HZ * (1.0 - CHI * square) * TICK_S / 2.0)
        rows.append({"half": half, "bias_sign": sign, "mode": helicity, "counts": counts,
                     "loop_closed": 0 if k in GAP else 1, "detuning_lambda": mean, "detuning_sq_lambda2": square})
    return rows


class Relock(CliTest):
    def left(self, rows, relock):
        """Sum of dtheta_final and of dtheta from the gap on: the truth is zero."""
        settings = Settings(scale_arcsec=SCALE_ARCSEC, tick_s=TICK_S, bias_hz=BIAS_HZ, bias_chi=CHI, relock=relock,
                            relock_ticks=60, bridge="constant")
        log = self.process(rows, settings)
        return math.fsum(log.final[GAP.start :]), math.fsum(log.dtheta[GAP.start :])

    def assert_removed(self, detuning, methods, part, what):
        for first_sign in (1, -1):
            for mode in (1, -1):
                rows = relock_log(detuning, first_sign, mode)
                whole, _ = self.left(rows, "none")
                self.assertGreater(abs(whole), 20.0, f"{what}: the false angle is too small to test with")
                self.assertEqual(whole > 0.0, first_sign * mode > 0, f"{what}: sign of the false angle")
                for relock in methods:
                    with self.subTest(relock=relock, first=first_sign, mode=mode):
                        for rest in self.left(rows, relock):
                            self.assertLess(abs(rest), part * abs(whole), f"{what} by {relock}: {rest} of {whole} arcsec are left")

    def test_exponential_loop_by_every_method(self):
        methods = ("frequency", "detuning", "mean_square")
        self.assert_removed(exponential(0.22, 3.5 * TICK_S), methods, 0.01, "exponential loop")

    def test_detuning_of_the_other_sign_gives_the_same_angle(self):
        methods = ("frequency", "detuning", "mean_square")
        self.assert_removed(exponential(-0.22, 3.5 * TICK_S), methods, 0.01, "exponential loop, negative miss")

    def test_slewing_loop_by_mean_square(self):
        self.assert_removed(slewing(0.22), ("mean_square",), 0.01, "slewing loop")

    def test_slewing_loop_shows_the_known_error_of_the_frequency_method(self):
        # The second tick of a slewing loop is left with about 525 arcsec/s: eq (11) presumes an exponential.
        settings = Settings(scale_arcsec=SCALE_ARCSEC, tick_s=TICK_S, bias_hz=BIAS_HZ, bias_chi=CHI, relock="frequency")
        log = self.process(relock_log(slewing(0.22), 1, 1), settings)
        self.assertAlmostEqual(abs(log.final[GAP.stop + 1]) / TICK_S, 525.0, delta=10.0)

    def test_correction_needs_usable_detuning(self):
        rows = relock_log(exponential(0.22, 3.5 * TICK_S), 1, 1)
        spoiled = 2 * GAP.stop
        rows[spoiled]["detuning_lambda"] = 0.0
        rows[spoiled + 3]["detuning_lambda"] = 2.0 * rows[spoiled + 2]["detuning_lambda"]
        settings = Settings(scale_arcsec=SCALE_ARCSEC, tick_s=TICK_S, bias_hz=BIAS_HZ, bias_chi=CHI, relock="detuning")
        log = self.process(rows, settings)
        for k in (GAP.stop, GAP.stop + 1):
            raw = SCALE_ARCSEC * (rows[2 * k]["counts"] + rows[2 * k + 1]["counts"])
            self.assertTrue(log.has(k, "relock_uncorrected"), f"tick {k} has no usable detuning and is not flagged")
            self.assertAlmostEqual(log.final[k], raw, delta=1e-9, msg=f"tick {k} was corrected without usable detuning")
        self.assertTrue(log.has(GAP.stop + 2, "relock_corrected"))


if __name__ == "__main__":
    unittest.main()
