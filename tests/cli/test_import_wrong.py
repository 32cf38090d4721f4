"""Files of which a number would be wrong without a word: each is refused, or what may be wrong is said."""

import datetime

import h5py
import numpy

from foreign import FIXED, Foreign, SCALE
from support import csv_text, quiet_log, run


class SilentlyWrong(Foreign):
    """Files that would give wrong numbers without a word."""

    def refused(self, name, data, *said, code=3, says=()):
        self.refuse(code, "import", self.write(name, data), "--out", self.folder / "o.csv", *said, says=(name, *says))

    def test_attributes_of_hdf5_that_scale(self):
        path = self.folder / "scaled.h5"
        said = ["--map", "rate_hz=100", "--map", "axis=w", "--map", "unit=deg/h"]
        for name, harmless, harmful in (("scale_factor", 1, 0.01), ("Gain", 1.0, 2), ("LSB", 1, 1e-3), ("conversion", 1.0, 1e-3), ("add_offset", 0.0, 5), ("_FillValue", 1e20, 3.0)):
            with self.subTest(name):
                for value in (harmless, harmful):
                    with h5py.File(path, "w") as file:
                        file["w"] = [*self.rates(50), 3.0]
                        file["w"].attrs[name] = value
                    if value == harmless:
                        self.angles(path, *said, rows=51)
                    else:
                        self.refuse(3, "import", path, "--out", self.folder / "o.csv", *said, says=("'w'", name, f"{value:g}"))

    def test_axes_of_two_units_and_names_that_contradict(self):
        body = "\n".join(f"{k/100:.2f},{a:.6f},{b:.6f}" for k, (a, b) in enumerate(zip(self.rates(50), self.rates(50)))) + "\n"
        two = self.write("two.csv", "time_s,x [deg/s],y [deg/h]\n" + body)
        self.refuse(2, "analyze", two, "--map", 'axis=["x", "y"]', says=("'y [deg/h]'", "deg/s"))
        open_one = self.write("open.csv", "time_s,x [deg/s],y\n" + body)
        self.refuse(2, "analyze", open_one, "--map", 'axis=["x", "y"]', says=("'y'", "deg/s"))
        self.refused("lines.csv", "time_s,x_dps,T\ns,deg/h,C\n" + body, "--map", "axis=x_dps", code=2, says=("deg/s", "deg/h"))
        out = self.folder / "angles.csv"
        result = run("import", two, "--out", out, "--map", "axis=x", "--map", "unit=deg/h", "--map", "holds=rate")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("against its name", result.stderr)

    def test_angles_that_wrap(self):
        turn = 3.7 * numpy.arange(300) + 0.2 * self.rates(300)
        for name, unit, per_deg, size in (("circle.csv", "deg", 1, 360), ("half.csv", "deg", 1, 180), ("rad.csv", "rad", numpy.pi / 180, 2 * numpy.pi),
                                          ("counts.csv", "counts", 100, 65536)):
            with self.subTest(name):
                angle = (turn * per_deg + size / 2) % size - size / 2
                row = next(k for k in range(1, 300) if abs(angle[k] - angle[k - 1]) > size / 2) + 1
                text = "t_s,a\n" + "\n".join(f"{k/100:.2f},{a:.7f}" for k, a in enumerate(angle)) + "\n"
                self.refused(name, text, "--map", "axis=a", "--map", "holds=angle", "--map", f"unit={unit}", *SCALE, says=(f"row {row}:", "anew"))

    def test_counts_that_add_up_or_have_lost_their_direction(self):
        said = [*FIXED, *SCALE, "--map", "tick_s=0.005"]
        counts = [150 + int(n) for n in self.rng.integers(-5, 6, 60)]
        for name, values, word in (("total.csv", numpy.cumsum(counts), "running total"), ("magnitude.csv", counts, "one sign")):
            self.refused(name, "counts,bias_sign\n" + "".join(f"{n},{1 - k % 2 * 2}\n" for k, n in enumerate(values)), *said, says=(word,))

    def test_an_empty_state_is_not_the_one_before(self):
        for key in ("mode", "loop_closed", "bias_sign"):
            rows = [dict(row) for row in quiet_log(20)]
            text = csv_text(rows, facts=False).splitlines()
            cells = text[10].split(",")
            cells[text[0].split(",").index(key)] = ""
            text[10] = ",".join(cells)
            self.refused(f"{key}.csv", "\n".join(text) + "\n", *SCALE, "--map", "tick_s=0.005", says=("row 10", key))

    def test_minutes_and_seconds_are_no_hours_and_minutes(self):
        text = "Uhrzeit;w_dph\n" + "\n".join(f"08:{k:02d};{r:.4f}" for k, r in enumerate(self.rates(50))) + "\n"
        self.refused("clock.csv", text, "--map", "axis=w_dph", code=2, says=("rate_hz",))

    def test_a_tick_is_none_of_an_angle_file(self):
        text = "t_s,w_dph\n" + "\n".join(f"{k/100:.2f},{r:.4f}" for k, r in enumerate(self.rates(50))) + "\n"
        self.refused("tick.csv", text, "--map", "tick_s=0.5", code=2, says=("tick_s = 0.5", "rate_hz"))

    def test_stamps_that_do_not_decide(self):
        def text(times, form):
            return "t_ms,w_dph\n" + "\n".join(f"{t:{form}},{r:.6f}" for t, r in zip(times, self.rates(len(times)))) + "\n"
        changes = numpy.cumsum([10.0] * 200 + [5.0] * 200)
        self.refused("faster.csv", text(changes, ".0f"), "--map", "axis=w_dph", says=("rate",))
        self.refused("slower.csv", text(numpy.cumsum([5.0] * 300 + [10.0] * 100), ".0f"), "--map", "axis=w_dph", says=("row 300", "10"))
        for step in (1.25, 2.5):
            whole = step * numpy.arange(400)
            log = self.angles(self.write("coarse.csv", text(numpy.floor(whole), ".0f")), rows=400)
            self.assertEqual([k for k in range(400) if log.has(k, "invalid")], [])
            self.assertIn(f"tick_s = {step / 1e3:g}", "\n".join((self.folder / "angles.csv").read_text().splitlines()[:9]))
            lost = text(numpy.floor(numpy.delete(whole, 211)), ".0f")
            if step < 2:  # a step of 3 may be two rows as well as one and a late one
                self.refused("lost.csv", lost, "--map", "axis=w_dph", says=("rounded", "rate_hz"))
            else:
                log = self.angles(self.write("lost.csv", lost), rows=400)
                self.assertEqual([k for k in range(400) if log.has(k, "invalid")], [211])


class Bench(Foreign):
    """Tables of 400 rows at 100 Hz."""

    DPH = ["--map", "axis=w_dph"]

    def table(self, name, head, *columns, separator=",", end="\n"):
        rows = [separator.join(str(cell) for cell in row) for row in zip(*columns)]
        return self.write(name, "\n".join([head, *rows]) + end)

    def setUp(self):
        super().setUp()
        self.w = [f"{rate:.6f}" for rate in self.rates(400)]
        self.t = [f"{k/100:.2f}" for k in range(400)]

    def refused(self, path, *said, code=3, says=()):
        self.refuse(code, "analyze", path, *said, says=says)

    def noted(self, path, *said, says=()):
        result = run("analyze", path, *said)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn(says, result.stderr)


class OfALaboratory(Bench):
    """Logs as they come from a bench, of which a number would be wrong without a word."""

    def test_two_units_in_the_name_of_the_times(self):
        path = self.table("units.csv", "t_ms [s],w_dph", self.t, self.w)
        self.refused(path, *self.DPH, code=2, says=("t_ms [s]", "time_unit"))
        _, axis = self.mean(path, *self.DPH, "--map", "time_unit=s")
        self.assertAlmostEqual(axis["rate_hz"], 100, delta=1e-9)

    def test_points_between_semicolons_may_part_thousands(self):
        values = [3000 + k * 211 % 500 for k in range(400)]
        for separator in ";\t":
            path = self.table("german.csv", separator.join(["t_s", "w_dph"]), range(400), [f"{v/1000:.3f}" for v in values], separator=separator)
            self.refused(path, *self.DPH, code=2, says=("1.234", "decimal"))
            mean, _ = self.mean(path, *self.DPH, "--map", "decimal=point")
            self.assertAlmostEqual(mean, sum(values) / 4e5, delta=1e-3)

    def test_a_register_of_rates_overflows(self):
        true = numpy.round(32500 + 300 * self.rng.standard_normal(400)).astype(int)
        path = self.table("lsb.csv", "t_s,w", self.t, (true + 32768) % 65536 - 32768)
        row = next(k for k in range(400) if true[k] > 32767) + 1
        for said in (["--map", "holds=rate", "--map", "unit=deg/h"], ["--map", "holds=increment", "--map", "unit=counts", *SCALE]):
            self.refused(path, "--map", "axis=w", *said, says=(f"row {row}:", "65536"))

    def test_a_number_that_marks_a_missing_value(self):
        self.w[50] = self.w[200] = "-9999"
        self.refused(self.table("mark.csv", "t_s,w_dph", self.t, self.w), *self.DPH, says=("row 51", "missing=-9999"))
        known = [float(w) for w in self.w if w != "-9999"]
        mean, axis = self.mean(self.folder / "mark.csv", *self.DPH, "--map", "missing=-9999")
        self.assertAlmostEqual(mean, sum(known) / len(known), places=9)
        self.assertEqual((axis["samples"], axis["known"]), (400, 398))

    def test_a_count_that_marks_a_missing_row(self):
        signs = [1 if k % 2 == 0 else -1 for k in range(200)]
        counts = [-9999 if k == 50 else 150 * sign for k, sign in enumerate(signs)]
        path = self.table("marked.csv", "dir,n", signs, counts)
        raw = self.folder / "raw.csv"
        said = ["import", path, "--out", raw, "--map", "counts=n", "--map", "bias_sign=dir", "--map", "tick_s=0.005", *FIXED, *SCALE]
        self.refuse(3, *said, says=("row 51", "missing=-9999"))
        self.succeed(*said, "--map", "missing=-9999")
        rows = raw.read_text().splitlines()[-200:]
        self.assertEqual([k for k, row in enumerate(rows) if row.split(",")[5] == "0"], [50])

    def test_rows_of_two_sensors(self):
        for one, two in (("1", "2"), ("A", "B")):
            path = self.table("two.csv", "t_s,sensor,w_dph", self.t, [one, two] * 200, self.w)
            self.refused(path, *self.DPH, code=2, says=("'sensor'", one, two))
        self.mean(self.table("one.csv", "t_s,sensor,w_dph", self.t, ["1"] * 400, self.w), *self.DPH)

    def test_times_that_do_not_rise_are_not_passed_over(self):
        said = [*self.DPH, "--map", "rate_hz=100"]
        path = self.table("back.csv", "t_s,w_dph", self.t[::-1], self.w)
        self.refused(path, *said, code=2, says=("t_s", "time=none"))
        self.mean(path, *said, "--map", "time=none")
        self.refused(path, *said, "--map", "time=1", says=("do not go back", "--map time=none"))

    def test_numbers_of_rows_show_what_is_missing(self):
        keep = [k for k in range(400) if not 100 <= k < 150]
        path = self.table("skips.csv", "sample,w_dph", keep, [self.w[k] for k in keep])
        _, axis = self.mean(path, *self.DPH, "--map", "rate_hz=100")
        self.assertEqual((axis["samples"], axis["known"]), (400, 350))

    def test_daylight_saving_time_is_no_hole(self):
        start = datetime.datetime(2026, 3, 29, 1, 59, 58)
        moved = [start + datetime.timedelta(milliseconds=10 * k, hours=1 if k >= 200 else 0) for k in range(400)]
        for zone in ("", "Z"):
            path = self.table("dst.csv", "time,w_dph", [stamp.isoformat(timespec="milliseconds") + zone for stamp in moved], self.w)
            if zone:
                self.assertEqual(self.mean(path, *self.DPH)[1]["samples"], 360400)
            else:
                self.refused(path, *self.DPH, says=("row 200", "hour", "time=none"))

    def test_what_may_be_wrong_is_noted(self):
        self.noted(self.table("cut.csv", "t_s,w_dph", self.t, self.w, end=""), *self.DPH, says="its last line has no end")
        stopped = self.w[:300] + ["0"] * 100
        self.noted(self.table("stopped.csv", "t_s,w_dph", self.t, stopped), *self.DPH, says="last 100 rows are all 0")


class WhatNamesSay(Bench):
    """Factors beside units, columns that contradict each other or count the rows, words among numbers, keys that nothing reads."""

    RATE = ["--map", "holds=rate"]

    def refused(self, path, *said, code=3, says=()):
        self.refuse(code, "import", path, *said, "--out", self.folder / "o.csv", says=says)

    def mean(self, path, *said):
        return super().mean(path, *(said or self.RATE))


    def test_a_factor_beside_the_unit_of_times_is_asked_for(self):
        times = [1000 * k for k in range(400)]
        for name in ("time [10us]", "time [1e-3 s]", "time [10^-3 s]", "time [0.1 ms]", "time [100ns]", "time [s/1000]", "time [us*10]", "t_100us",
                     "t5us", "time_us_x100", "time [Ms]"):
            with self.subTest(name):
                self.refused(self.table("factor.csv", f"{name},w_dph", times, self.w), code=2, says=("time_unit", name))
        self.refused(self.table("line.csv", "time,w\n[10us],[deg/h]", times, self.w), code=2, says=("time_unit", "10us"))
        for name in ("time [us]", "t1_us", "TIME_US"):
            self.assertAlmostEqual(self.mean(self.table("plain.csv", f"{name},w_dph", times, self.w))[1]["rate_hz"], 1000, delta=1e-6)

    def test_a_factor_in_an_attribute_of_hdf5_is_asked_for(self):
        path = self.folder / "factor.h5"
        for units in ("10us", "us"):
            with h5py.File(path, "w") as file:
                file["w_dph"] = self.rates(400)
                file["time"] = numpy.arange(400) * 1000
                file["time"].attrs["units"] = units
            if units == "us":
                self.mean(path, "--map", "axis=w_dph")
            else:
                self.refused(path, *self.DPH, code=2, says=("time_unit", "10us"))

    def test_a_factor_beside_the_unit_of_a_rate_is_asked_for(self):
        for name in ("gyro_z*100 [deg/s]", "gyro_z [deg/s] x100", "gyro_z_x1000_dps", "gyro_z [Mrad/s]", "gyro_z [10 deg/s]"):
            with self.subTest(name):
                self.refused(self.table("factor.csv", f"t_s,{name}", self.t, self.w), *self.RATE, code=2, says=("unit=", name))
                # Nor is another column taken in its place.
                self.refused(self.table("other.csv", f"t_s,{name},ref_dps", self.t, self.w, self.w), code=2, says=("axis=", name, "ref_dps"))
        for name in ("gyro1_z_dps", "gyro_1_dps", "w2 [deg/s]", "gyro_x1 [mrad/s]", "GYRO_DPS"):
            self.mean(self.table("axis.csv", f"t_s,{name}", self.t, self.w))

    def test_a_counter_is_no_time(self):
        said = ["--map", "axis=3", "--map", "unit=deg/h", "--map", "holds=rate", "--map", "time_unit=ms"]
        path = self.table("counter.csv", "0;0;15.01", range(1, 400), [k // 2 * 5 for k in range(1, 400)], self.w[1:], separator=";")
        self.refused(path, *said, code=2, says=("time=1", "number the rows", "rate_hz"))
        self.assertAlmostEqual(self.mean(path, *said, "--map", "time=1")[1]["rate_hz"], 1000, delta=1e-6)
        self.assertAlmostEqual(self.mean(path, *said[:-2], "--map", "rate_hz=400")[1]["rate_hz"], 400, delta=1e-6)

    def test_times_that_contradict_each_other(self):
        twice = [f"{k / 50:.2f}" for k in range(400)]
        dates = [f"2026-01-01T00:00:{k / 100:05.2f}Z" for k in range(400)]
        for names, first in (("time_s,time_s", self.t), ("time_s,t_s", self.t), ("utc,time_s", dates)):
            path = self.table("two.csv", f"{names},w_dph", first, twice, self.w)
            self.refused(path, code=2, says=("time=1|2", "100 Hz", "50 Hz"))
            self.assertAlmostEqual(self.mean(path, "--map", "time=2")[1]["rate_hz"], 50, delta=1e-6)
        ms = [10 * k for k in range(400)]
        agreeing = self.table("agree.csv", "utc,time_s,t_ms,timestamp,w_dph", dates, self.t, ms, [10_000_000 * k for k in range(400)], self.w)
        self.assertAlmostEqual(self.mean(agreeing)[1]["rate_hz"], 100, delta=1e-6)
        self.refused(self.table("open.csv", "time,timestamp,w_dph", self.t, ms, self.w), "--map", "time_unit=ms", code=2, says=("time=1|2",))

    def test_times_too_small_for_a_number(self):
        path = self.table("small.csv", "t [s],w_dph", ["0.0", *(f"{k}e-310" for k in range(1, 400))], self.w)
        self.refused(path, code=2, says=("gyro.tick_s", "1e-6..10"))

    def test_a_word_among_the_numbers_of_an_axis(self):
        self.w[49] = "OVF"
        ref = [f"{-5 + k % 5 * 0.1:.1f}" for k in range(400)]
        path = self.table("word.csv", "t_s,gyro_dps,ref_dps", self.t, self.w, ref)
        for said in ([], ["--map", "axis=2"]):
            self.refused(path, *said, says=("word.csv:51, column 2: 'OVF'", "a finite number, or nan"))
        self.mean(path, "--map", "axis=ref_dps")
        self.refused(self.table("open.csv", "t_s,gyro,ref", self.t, self.w, ref), code=2, says=("axis=", "'gyro'", "'ref'"))
        self.refused(self.table("only.csv", "t_s,gyro", self.t, self.w), says=("only.csv:51", "'OVF'"))

    def test_a_saw_of_any_height_begins_anew(self):
        said = ["--map", "axis=a", "--map", "holds=angle", "--map", "unit=counts", *SCALE]
        for step, height in ((15, 360), (50, 4096), (-50, 4096), (80, 360)):
            angle = [step * k % height for k in range(400)]
            row = next(k for k in range(1, 400) if (angle[k] - angle[k - 1]) * step < 0) + 1
            self.refused(self.table("saw.csv", "t_s,a", self.t, angle), *said, says=(f"row {row}:", "anew", f"{height}"))
        k = numpy.arange(400)
        for honest in (100 * numpy.sin(0.3 * k), 100 * numpy.sin(2.0 * k), abs(k % 40 - 20), k % 10 // 5 * 90, 15 * k - 400 * numpy.sin(0.1 * k),
                       k // 40 * 90, numpy.cumsum(self.rng.standard_normal(400))):
            self.mean(self.table("honest.csv", "t_s,a", self.t, honest), *said)

    def test_a_counter_of_a_raw_log_shows_missing_rows(self):
        said = ["--map", "counts=N", "--map", "bias_sign=dir", *FIXED, *SCALE, "--map", "tick_s=0.005"]
        signs = {k: 1 - k % 2 * 2 for k in range(400) if not 100 <= k < 140}
        path = self.table("raw.csv", "n,dir,N", signs, signs.values(), [150 * sign + (k % 4 == 0) for k, sign in signs.items()])
        out = self.folder / "raw_log.csv"
        result = run("import", path, "--out", out, "--force", *said)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("40 rows are missing", result.stderr)
        self.assertEqual(len([line for line in out.read_text().splitlines() if line[0].isdigit()]), 400)

    def test_no_log_is_written_that_readers_refuse(self):
        path = self.table("slow.csv", "w_dph", self.w)
        for rate in ("0.05", "1e-300", "1e300", "1e-310"):
            self.refused(path, "--map", f"rate_hz={rate}", code=2, says=("rate_hz", "tick_s", "1e-6..10"))
        self.assertFalse((self.folder / "o.csv").exists())

    def test_keys_that_nothing_reads(self):
        path = self.table("plain.csv", "t_s,w_dph", self.t, self.w)
        for key in ("timer_hz=1e300", "mode_plus=7", "bias_sign_plus=1", "mode=always:1"):
            self.refused(path, "--map", key, code=2, says=(key.split("=")[0], "raw logs"))
        raw = self.table("raw.csv", "counts,bias_sign", range(4), [1, -1, 1, -1])
        self.refused(raw, *FIXED, *SCALE, "--map", "tick_s=0.005", *self.RATE, code=2, says=("holds = rate", "counts"))
