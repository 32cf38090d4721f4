"""Rows that are not those of the axis: of other sensors, above the table, hidden by a clock that is written in digits."""

import unittest

import numpy

from foreign import Foreign
from support import run


class Rows(Foreign):
    N = 1000
    SAID = ("--map", "unit=rad/s", "--map", "holds=rate", "--map", "time_unit=s")
    ARCSEC = 180 / numpy.pi * 3600

    def setUp(self):
        super().setUp()
        self.w = self.rng.normal(0.03, 0.001, self.N)

    def test_others_in_a_table_that_was_merged_by_times(self):
        there = [k for k in range(self.N) if not 300 <= k < 320]
        events = [(0.01 * k, f"{self.w[k]:.17g},,") for k in there]
        events += [(0.04 * k + 0.003, f",{k},") for k in range(self.N // 4)] + [(0.2 * k + 0.007, ",,nan") for k in range(9)]
        events += [(0.2 * k + 0.008, ",,4") for k in range(self.N // 20)]
        path = self.write("merged.csv", "__time,/imu/z,/baro,/gps\n" + "".join(f"{t:.4f},{rest}\n" for t, rest in sorted(events)))
        log = self.angles(path, *self.SAID, "--map", "axis=/imu/z", rows=self.N)
        self.assertEqual([k for k in range(self.N) if log.has(k, "invalid")], list(range(300, 320)))
        self.assert_turns_of(log, there)
        result = run("import", path, *self.SAID, "--map", "axis=/imu/z", "--out", self.folder / "again.csv")
        self.assertIn(f"{len(events) - len(there)} rows without a value of the axis", result.stderr)

    def assert_turns_of(self, log, there):
        numpy.testing.assert_allclose(numpy.array(log.dtheta)[there], self.w[there] * self.ARCSEC / 100, rtol=1e-12)

    def test_rows_of_a_mode_are_not_those_of_others(self):
        modes = numpy.where(numpy.arange(self.N) % 200 < 100, 1, -1)
        rows = "".join(("" if k % 50 else f"{k / 100 - 0.001:.3f},,{modes[k]}\n") + f"{k / 100:.3f},{w:.17g},\n" for k, w in enumerate(self.w))
        path = self.write("m.csv", "time_s,gyro [rad/s],mode\n" + rows)
        result = run("import", path, *self.SAID, "--map", "axis=2", "--map", "mode=3", "--out", self.folder / "o.csv")
        self.assertNotIn("are left out", result.stderr)

    def test_a_status_beside_samples_that_are_missing_takes_none_out(self):
        lost = {100, 101, 102, 700}
        rows = "".join(f"{k / 100:.2f},{'' if k in lost else format(self.w[k], '.17g')},{17 if k in lost else ''}\n" for k in range(self.N))
        log = self.angles(self.write("s.csv", "time_s,gyro [rad/s],error\n" + rows), "--map", "axis=gyro", rows=self.N)
        self.assertEqual({k for k in range(self.N) if log.has(k, "invalid")}, lost)

    def test_one_full_minute_of_a_clock_in_digits(self):
        clock = [f"{120000 + k / 10 if k < 600 else 120100 + (k - 600) / 10:.1f}" for k in range(self.N)]
        path = self.write("c.csv", "utc,gz\n" + "".join(f"{t},{w:.9f}\n" for t, w in zip(clock, self.w)))
        self.refuse(3, "import", path, *self.SAID, "--out", self.folder / "o.csv", says=("120059.9", "120100", "--map time=none", "rate_hz"))
        epoch = [f"{1700000000 + k / 10 + (40.1 if k >= 600 else 0):.1f}" for k in range(self.N)]
        path = self.write("e.csv", "utc,gz\n" + "".join(f"{t},{w:.9f}\n" for t, w in zip(epoch, self.w)))
        self.angles(path, *self.SAID, rows=self.N + 401)
        seconds = [k / 10 if k < 600 else 100 + (k - 600) / 10 for k in range(self.N)]
        path = self.write("s.csv", "utc,gz\n" + "".join(f"{t:.1f},{w:.9f}\n" for t, w in zip(seconds, self.w)))
        self.angles(path, *self.SAID, rows=self.N + 400)

    def test_stamps_that_are_rounded_to_milliseconds(self):
        k = numpy.arange(self.N)
        there = numpy.delete(k, 445)
        path = self.stamped(there, numpy.floor(there / 0.128))
        log = self.angles(path, "--map", "rate_hz=128", rows=self.N)
        self.assertEqual([row for row in k if log.has(row, "invalid")], [445])
        there = numpy.delete(k, [100, 300, 333, 700, 888])
        for rows, stamps in ((there, numpy.floor(there / 0.952)), (k, numpy.floor(k / 0.99))):
            path = self.stamped(rows, stamps)
            self.refuse(3, "import", path, "--out", self.folder / "o.csv", says=("are missing; allowed is one of both: --map rate_hz=",))
        self.angles(path, "--map", "rate_hz=990", rows=self.N)
        there = numpy.sort(self.rng.permutation(self.N + 40)[:self.N])  # by chance they are missing
        self.assertEqual(self.mean(self.stamped(k, there))[1]["known"], self.N)

    def test_rows_that_are_missing_are_seen_at_any_rate_by_stamps_of_milliseconds(self):
        for rate in (300, 300.3, 333, 350, 400, 480):
            lost = numpy.sort(self.rng.choice(numpy.arange(5, self.N - 5), 7, replace=False))
            there = numpy.delete(numpy.arange(self.N), lost)
            log = self.angles(self.stamped(there, numpy.floor(1000 * there / rate)), rows=self.N)
            self.assertEqual([k for k in range(self.N) if log.has(k, "invalid")], lost.tolist(), rate)
            numpy.testing.assert_allclose(numpy.array(log.dtheta)[there], self.w[there] * self.ARCSEC / rate, rtol=0.1 / self.N)  # of a row over the record

    def test_rows_that_are_missing_by_chance_do_not_hide_another_rate(self):
        self.w = self.rng.normal(0.03, 0.001, 10_000)
        there = numpy.delete(numpy.arange(10_000), self.rng.choice(numpy.arange(1, 9_999), 12, replace=False))
        for rate, is_open in ((997, True), (1000, False)):
            path = self.stamped(there, numpy.floor(1000 * there / rate))
            if is_open:
                self.refuse(3, "import", path, "--out", self.folder / "o.csv", says=("are missing; allowed is one of both: --map rate_hz=",))
            else:
                self.angles(path, rows=10_000)

    def test_of_many_missing_rows_the_rate_must_be_said_where_a_clock_may_round_so(self):
        there = numpy.flatnonzero(self.rng.random(self.N) > 0.15)
        path = self.stamped(there, 10 * there)
        self.refuse(3, "import", path, "--out", self.folder / "o.csv", says=("rate_hz=... with time_unit=... if", "are"))
        log = self.angles(path, "--map", "rate_hz=100")
        self.assertEqual([k - there[0] for k in there], [k for k in range(len(log.dtheta)) if not log.has(k, "invalid")])
        # 85 Hz, with stamps that scatter, in whole hundredths of a second.
        late = numpy.round(numpy.arange(self.N) / 0.85 + self.rng.uniform(-0.05, 0.05, self.N))
        self.refuse(3, "import", self.stamped(range(self.N), 10 * late), "--out", self.folder / "o.csv", says=("not even",))
        # By a clock of 1024 ticks 800 Hz of which three rows are missing; and 1024 Hz that lacks a fifth by chance.
        for there, ticks in ((numpy.delete(numpy.arange(self.N), [200, 500, 700]), 1.28), (numpy.flatnonzero(self.rng.random(self.N) > 0.2), 1.0)):
            rows = "".join(f"{numpy.floor(ticks * k) / 1024:.6f},{self.w[k]:.9f}\n" for k in there)
            path = self.write("c.csv", "time_s,gyro [rad/s]\n" + rows)
            if ticks > 1.0:
                self.refuse(3, "import", path, "--out", self.folder / "o.csv", says=("not even",))
            else:
                self.angles(path, rows=there[-1] - there[0] + 1)

    def test_a_clock_that_is_set_within_a_file_is_soon_refused(self):
        stamps = numpy.floor(numpy.arange(20_000) / 0.997) + numpy.where(numpy.arange(20_000) < 10_000, 0.0, 1.7e12)
        path = self.write("set.csv", "t_ms,gyro [rad/s]\n" + "".join(f"{t:.0f},{k % 7}.5\n" for k, t in enumerate(stamps)))
        self.refuse(3, "import", path, "--out", self.folder / "o.csv", timeout=20)

    def test_a_second_that_all_rows_share_tells_no_rate(self):
        path = self.stamped(range(20), [1000 * int(1000.85 + k / 100) for k in range(20)])
        self.refuse(3, "import", path, "--out", self.folder / "o.csv", says=("tells no rate", "rate_hz"))

    def test_seconds_since_1970_that_are_rounded_to_milliseconds(self):
        for rate in (700, 800, 909):
            rows = "".join(f"{1764384000 + k / rate:.3f},{w:.17g}\n" for k, w in enumerate(self.w))
            log = self.angles(self.write("u.csv", "time_s,gyro [rad/s]\n" + rows), *self.SAID, rows=self.N)
            numpy.testing.assert_allclose(log.dtheta, self.w * self.ARCSEC / rate, rtol=2e-3 * rate / self.N)  # a millisecond at each end

    def test_stamps_that_scatter_beside_holes_keep_the_length_of_a_row(self):
        for seed in range(4):
            rng = numpy.random.default_rng(seed)
            there = numpy.ones(self.N, bool)
            for first in rng.integers(20, self.N - 40, 3):
                there[first:first + 8] = False
            stamps = numpy.arange(self.N) / 25 + rng.uniform(-0.008, 0.008, self.N)
            rows = "".join(f"{stamps[k]:.4f},{self.w[k]:.17g}\n" for k in numpy.flatnonzero(there))
            log = self.angles(self.write("j.csv", "time_s,gyro [rad/s]\n" + rows), *self.SAID, rows=self.N)
            numpy.testing.assert_allclose(numpy.array(log.dtheta)[there], self.w[there] * self.ARCSEC / 25, rtol=0.4 / self.N)

    def stamped(self, rows, stamps):
        return self.write("t.csv", "t_ms,gyro [rad/s]\n" + "".join(f"{t:.0f},{self.w[k]:.9f}\n" for k, t in zip(rows, stamps)))

    def test_a_counter_beside_times_that_are_left_out_is_named(self):
        rows = "".join(f"{20 + k % 3},{k % 256},{w:.9f}\n" for k, w in enumerate(self.w) if k != 500)
        result = run("import", self.write("c.csv", "time,cnt,gyro [rad/s]\n" + rows), "--map", "time=none", "--map", "rate_hz=100", "--map", "axis=3",
                     "--out", self.folder / "o.csv")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("'cnt': rises as times and counters do, and is not used; --map time=2", result.stderr)

    def test_labview_names_a_column_that_rows_leave_out(self):
        rows = "".join(f"{k / 100:.2f}\t{w:.17g}\t2.5\n" for k, w in enumerate(self.w))
        path = self.write("a.lvm", "LabVIEW Measurement\t\n***End_of_Header***\t\nX_Value\tRate\tMonitor\tComment\n" + rows)
        log = self.angles(path, *self.SAID, "--map", "axis=Rate", "--map", "time=X_Value", rows=self.N)
        self.assert_turns_of(log, range(self.N))

    def test_sentences_that_begin_as_comments_do(self):
        rows = "".join(f"#INSATTA,COM1,0,{309000 + k / 100:.2f};7,{w:.17g},0*0badcafe\n" for k, w in enumerate(self.w))
        log = self.angles(self.write("a.asc", rows), *self.SAID, "--map", "axis=6", "--map", "time=4", rows=self.N)
        self.assert_turns_of(log, range(self.N))

    def test_separators_alone_above_a_table(self):
        rows = "".join(f"{k / 100:.2f},{w:.17g}\n" for k, w in enumerate(self.w))
        log = self.angles(self.write("t.csv", "Model,M1\n\nInterval,1e-2\n,\n,\nLabel,\nTIME,CH1\n" + rows), *self.SAID, rows=self.N)
        self.assert_turns_of(log, range(self.N))

    def test_a_number_above_the_rows_is_noted(self):
        said = ("--map", "unit=rad/s", "--map", "holds=rate", "--map", "rate_hz=100")
        for first, noted in (("100\n", True), ("", False)):
            path = self.write("n.txt", first + "".join(f"{w:.9f}\n" for w in self.w))
            result = run("import", path, *said, "--out", self.folder / "o.csv", "--force")
            self.assertEqual((result.returncode, "the first row, 100, is" in result.stderr), (0, noted))

    def test_whole_numbers_and_words_by_turns_are_noted(self):
        rows = "".join(f"{k / 100:.2f},{'AB'[k % 2]},{n}\n" for k, n in enumerate(self.rng.integers(-50, 50, self.N)))
        result = run("import", self.write("w.csv", "time_s,unit,gyro_dps\n" + rows), "--out", self.folder / "o.csv")
        self.assertEqual(result.returncode, 0, result.stderr)
        for word in ("--map scale=", "--map sensor=A"):
            self.assertIn(word, result.stderr)

    def test_a_unit_in_the_second_brackets_and_the_number_of_a_device(self):
        for name in ("Gyroscope (z) [rad/s]", "Shimmer_4F2B_Gyro_Z [rad/s]"):
            path = self.write("b.csv", f"time_s,{name}\n" + "".join(f"{k / 100:.2f},{w:.17g}\n" for k, w in enumerate(self.w)))
            self.assert_turns_of(self.angles(path, rows=self.N), range(self.N))

    def test_open_questions_come_at_once(self):
        rows = "".join(f"{k * 10} {k * 10 + 3} {w:.9f}\n" for k, w in enumerate(self.w))
        self.refuse(2, "import", self.write("q.txt", rows), "--out", self.folder / "o.csv",
                    says=("time=1|2 or none", "time_unit=", "unit=", "scale_arcsec=", "holds="))
        ragged = self.write("r.txt", "".join(f"GYR {k} {w:.9f}\n" + ("ATT 1 2 3 4\n" if k % 5 == 0 else "") for k, w in enumerate(self.w)))
        self.refuse(3, "import", ragged, says=("--map sensor=WORD", "--map skip_lines="))
        self.mean(ragged, "--map", "sensor=GYR", "--map", "unit=rad/s", "--map", "holds=rate", "--map", "rate_hz=100", "--map", "axis=3")


if __name__ == "__main__":
    unittest.main()
