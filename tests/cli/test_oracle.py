"""The oracle itself: exact weights of the paper's equations and cases small enough to do by hand."""

from fractions import Fraction as F
import random
import unittest

from oracle import Settings, compensate, correction_tick, drift_hz, find_gaps, weights
from random_logs import random_gaps, random_log, random_settings
from support import quiet_log

UNIT = Settings(scale_arcsec=1.0, bridge="quadratic", relock="none")
BEFORE = (-3, -2, -1, 0)
AROUND = (-1, 0, 4, 5)


def total(positions, order, n=3):
    columns = [weights(positions, j, order) for j in range(1, n + 1)]
    return tuple(sum(column) for column in zip(*columns))


def log_of(values, gap):
    """Tick k turns by values[k] counts, all of it in its first half; loop open in `gap`."""
    rows = quiet_log(len(values), counts=0, bias=0, gap=gap)
    for k, value in enumerate(values):
        rows[2 * k]["counts"] = value
    return rows


def values_of(ticks, name, span):
    return [getattr(ticks[k], name) for k in span]


class ExactWeights(unittest.TestCase):
    def test_linear_extrapolation_of_three_ticks(self):
        self.assertEqual(weights(BEFORE, 1, 1), (F(-1, 2), 0, F(1, 2), 1))
        self.assertEqual(total(BEFORE, 1), (F(-12, 5), F(-3, 10), F(9, 5), F(39, 10)))

    def test_quadratic_extrapolation_of_three_ticks(self):
        self.assertEqual(weights(BEFORE, 1, 2), (F(3, 4), F(-5, 4), F(-3, 4), F(9, 4)))
        self.assertEqual(weights(BEFORE, 3, 2), (F(73, 20), F(-99, 20), F(-81, 20), F(127, 20)))
        self.assertEqual(total(BEFORE, 2), (F(127, 20), F(-181, 20), F(-139, 20), F(253, 20)))

    def test_interpolation_of_three_ticks(self):
        self.assertEqual(weights(AROUND, 2, 0), (F(1, 4),) * 4)
        self.assertEqual(weights(AROUND, 1, 1), tuple(F(w, 52) for w in (19, 17, 9, 7)))
        self.assertEqual(weights(AROUND, 1, 2), tuple(F(w, 65) for w in (-12, 57, 47, -27)))
        self.assertEqual(total(AROUND, 2), (-1, F(5, 2), F(5, 2), -1))

    def test_quadratic_interpolation_follows_the_general_law(self):
        for n in range(1, 11):
            outer = F(-n * (n + 1), 12)
            inner = F(n, 2) - outer
            self.assertEqual(total((-1, 0, n + 1, n + 2), 2, n), (outer, inner, inner, outer), f"n = {n}")

    def test_order_is_at_most_points_less_one(self):
        self.assertEqual(weights((0,), 5, 2), (1,))
        self.assertEqual(weights((0, 1), 3, 2), (-2, 3))


class HandMadeGaps(unittest.TestCase):
    def test_parabola_is_bridged_exactly_and_nothing_is_owed(self):
        values = [k * k for k in range(20)]
        spoiled = [0 if 8 <= k <= 10 else v for k, v in enumerate(values)]
        ticks = compensate(log_of(spoiled, range(8, 11)), UNIT)
        self.assertEqual(values_of(ticks, "final", range(20)), values)
        self.assertEqual(values_of(ticks, "dtheta", range(20)), values)
        self.assertEqual([k for k in range(20) if ticks[k].correction], [13])

    def test_step_in_the_gap_is_delivered_in_one_lump(self):
        values = [0] * 8 + [99] * 3 + [4] * 9
        ticks = compensate(log_of(values, range(8, 11)), Settings(scale_arcsec=1.0, bridge="constant"))
        self.assertEqual(values_of(ticks, "dtheta", range(6, 15)), [0, 0, 0, 0, 0, 4, 4, 10, 4])
        self.assertEqual(values_of(ticks, "final", range(6, 15)), [0, 0, 2, 2, 2, 4, 4, 4, 4])
        self.assertEqual([k for k in range(20) if not ticks[k].settled], [8, 9, 10, 11, 12])

    def test_gap_at_the_start_is_zero_then_extrapolated_backwards(self):
        ticks = compensate(log_of([0, 0] + [10 + k for k in range(2, 12)], range(2)), UNIT)
        self.assertEqual(values_of(ticks, "dtheta", range(2)), [0, 0])
        self.assertEqual(values_of(ticks, "final", range(2)), [10, 11])
        self.assertEqual(ticks[6].dtheta, 16 + 21)
        self.assertTrue(ticks[6].correction)

    def test_gap_at_the_end_keeps_its_extrapolation(self):
        ticks = compensate(log_of([3 * k for k in range(8)] + [0, 0], range(8, 10)), UNIT)
        self.assertEqual(values_of(ticks, "final", range(8, 10)), [24, 27])
        self.assertEqual(values_of(ticks, "dtheta", range(8, 10)), [24, 27])

    def test_log_of_one_gap_is_zero_and_unrepaired(self):
        ticks = compensate(log_of([5, 6, 7], range(3)), UNIT)
        self.assertEqual(values_of(ticks, "final", range(3)), [0, 0, 0])
        self.assertTrue(all(tick.unrepaired for tick in ticks))

    def test_seventeen_ticks_are_not_bridged(self):
        values = list(range(10)) + [0] * 17 + [5] * 10
        ticks = compensate(log_of(values, range(10, 27)), UNIT)
        self.assertEqual(values_of(ticks, "final", range(10, 27)), [F(15, 2)] * 17)
        self.assertEqual(values_of(ticks, "dtheta", range(10, 26)), list(range(10, 26)))
        self.assertEqual(ticks[26].dtheta, F(15, 2))
        self.assertEqual(ticks[29].lump, F(15, 2) * 16 - sum(range(10, 26)))

    def test_lump_waits_for_the_end_of_the_next_gap(self):
        gaps = {5, 6, 8, 9, 10}
        ticks = compensate(log_of([k % 7 for k in range(20)], gaps), UNIT)
        self.assertEqual(find_gaps(ticks), [(5, 6), (8, 10)])
        self.assertEqual([correction_tick(ticks, gap, UNIT) for gap in find_gaps(ticks)], [11, 13])

    def test_pass_as_read(self):
        values = [3, 1, 4, 1, 5, 9, 2, 6]
        ticks = compensate(log_of(values, range(3, 5)), Settings(scale_arcsec=1.0, bridge="none"))
        self.assertEqual(values_of(ticks, "dtheta", range(8)), values)
        self.assertEqual(values_of(ticks, "final", range(8)), values)

    def test_odd_last_half_is_dropped(self):
        self.assertEqual(len(compensate(log_of([1, 2, 3], [])[:-1], UNIT)), 2)


class RelockByHand(unittest.TestCase):
    def test_methods_agree_on_an_exponential_loop(self):
        # rho = 1/2 a half: q = 1/4; f_1 - f0 = -1000 Hz gives a drift of -1000 (3/4)/(5/4) = -600 Hz.
        period, chi, f0 = 0.005, 4.0, 60e3
        rows = quiet_log(6, gap=range(1, 3))
        for i in range(1, 4):
            deficit = -1000.0 / 16.0 ** (i - 1)
            for part, sign in ((0, 1), (1, -1)):
                rows[2 * (2 + i) + part]["counts"] = sign * (f0 + deficit) * period / 2.0
        ticks = compensate(rows, Settings(tick_s=period, bias_chi=chi, bias_hz=f0))
        frequency = Settings(tick_s=period, bias_chi=chi, bias_hz=f0, relock="frequency")
        for i, expected in ((1, -600.0), (2, -37.5), (3, -600.0 / 256.0)):
            self.assertAlmostEqual(drift_hz(rows, ticks, 3, i, frequency), expected, places=6)

    def test_detuning_and_mean_square_of_a_pure_exponential(self):
        # dl = exp(-t), half = ln 2: mean (1/2)/ln 2 and (1/4)/ln 2, mean square (3/8)/ln 2 and a quarter of it.
        log2 = 0.6931471805599453
        rows = quiet_log(2, gap=range(1))
        rows[2].update(detuning_lambda=0.5 / log2, detuning_sq_lambda2=0.375 / log2)
        rows[3].update(detuning_lambda=0.25 / log2, detuning_sq_lambda2=0.09375 / log2)
        ticks = compensate(rows, UNIT)
        expected = 2.0 * 100.0 / 2.0 * (0.09375 - 0.375) / log2
        for method in ("detuning", "mean_square"):
            settings = Settings(bias_chi=2.0, bias_hz=100.0, relock=method)
            self.assertAlmostEqual(drift_hz(rows, ticks, 1, 1, settings), expected, places=9, msg=method)


class RandomCases(unittest.TestCase):
    def test_both_sums_agree_wherever_nothing_is_outstanding(self):
        rng, settled = random.Random(7), 0
        for case in range(60):
            settings = random_settings(rng, rng.choice(["none", "frequency", "detuning", "mean_square"]),
                                       rng.choice(["none", "constant", "linear", "quadratic"]))
            gaps = random_gaps(rng, 60)
            ticks = compensate(random_log(rng, settings, gaps, 60), settings)
            difference = F(0)
            for tick in ticks:
                difference += tick.final - tick.dtheta
                if tick.correction and tick.settled:
                    settled += 1
                    self.assertEqual(difference, 0, f"case {case}")
        self.assertGreater(settled, 50, "the random logs hardly ever settle: nothing was tested")


if __name__ == "__main__":
    unittest.main()
