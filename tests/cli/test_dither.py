"""Shifted bias edges: the same bits live and processed, in both formats, and the area as the log's own columns give it."""

import csv
from fractions import Fraction

from support import AngleLog, CliTest, body_of, csv_text, quiet_log

RUN = ["--duration", 20, "--set", "switching.interval_s=4", "--set", "gyro.fidelity=laser"]
BIAS_HZ, EDGE_S, TICK_S, TIMER_HZ, SCALE = 60e3, 50e-6, 0.005, 1e7, 3.263


def shifts_of(path):
    rows = csv.DictReader(body_of(path).decode().splitlines())
    return [int(row["edge_offset_ticks"]) for row in rows]


class LiveAndProcessed(CliTest):
    def test_simulate_records_the_shifts(self):
        raw = self.folder / "raw.csv"
        self.succeed("simulate", *RUN, "--set", "gyro.dither=random", "--out", raw)
        self.assertIn("# timer_hz = 10000000\n", raw.read_text())
        shifts = shifts_of(raw)
        self.assertEqual(shifts[0], 0)
        cycle = TIMER_HZ * (1 - EDGE_S / TICK_S) / BIAS_HZ
        self.assertLess(max(map(abs, shifts)), 1.01 * cycle)
        self.assertGreater(max(shifts) - min(shifts), cycle)


class KnownArea(CliTest):
    """Against exact rationals. At rest but for the area, so that the time between even and shifted ends does not matter."""

    def angles(self, rows, columns, *options, timer="1e7", codes=None):
        raw = self.write("raw.csv", csv_text(rows, columns, [f"timer_hz = {timer}"] if timer else []))
        out = self.folder / "angles.csv"
        if codes is not None:
            return self.refuse(codes, "process", raw, "--out", out, *options)
        self.succeed("process", raw, "--out", out, "--force", *options)
        return AngleLog(out)

    def rows(self, shifts, mode=1, first=1):
        rows = quiet_log(len(shifts) // 2, counts=0)
        for row, shift in zip(rows, shifts):
            row.update(mode=mode, bias_sign=row["bias_sign"] * first, edge_offset_ticks=shift)
            row["counts"] *= mode * first
        return rows

    def test_is_that_of_the_plateau_between_the_shifted_edges(self):
        columns = ["half", "bias_sign", "mode", "counts", "loop_closed", "edge_offset_ticks"]
        plateau = Fraction(BIAS_HZ) / (1 - Fraction("50e-6") / Fraction("0.005"))
        for mode in (1, -1):
            for first in (1, -1):
                shifts = [self.random.randint(-160, 160) for _ in range(80)]
                shifts[1::2] = [0] * 40  # every tick is even, whatever its middle edge does
                log = self.angles(self.rows(shifts, mode, first), columns)
                for tick, got in enumerate(log.dtheta):
                    area = mode * first * 2 * shifts[2 * tick] * plateau / Fraction(TIMER_HZ)
                    self.assertAlmostEqual(got, -float(Fraction(str(SCALE)) * area), delta=1e-9)

    def test_needs_the_timer(self):
        columns = ["half", "bias_sign", "mode", "counts", "loop_closed", "edge_offset_ticks"]
        rows = self.rows([0, 0] * 10)
        self.angles(rows, columns, timer=None, codes=3)
        self.angles(rows, columns, timer="0", codes=3)
        self.angles(rows, columns, "--set", "gyro.bias_edge_s=0.0025", codes=2)
