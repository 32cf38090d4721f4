"""Evidence of rows that are missing, rows of two sensors, and values that are no measurements: never passed over."""

import json
import unittest

import h5py
import numpy

from foreign import Foreign
from support import run


class ForeignCase(Foreign):
    N = 6000
    LOST = ((700, 5), (2000, 17), (4000, 3))

    def keep(self):
        there = numpy.ones(self.N, bool)
        for at, n in self.LOST:
            there[at:at + n] = False
        return numpy.flatnonzero(there)

    def table(self, name, head, *columns):
        rows = "\n".join(",".join(str(field) for field in row) for row in zip(*columns))
        return self.write(name, head + "\n" + rows + "\n")

    def counted(self, path, *said):
        _, axis = self.mean(path, *said)
        return axis["samples"], axis["known"], axis["gaps"]

    def all_found(self, path, *said):
        self.assertEqual(self.counted(path, *said), (self.N, self.N - 25, 3))

    def w(self, n=None):
        return [f"{x:.6f}" for x in self.rates(n or self.N)]


class Holes(ForeignCase):
    def test_counters_of_any_width_and_name(self):
        keep = self.keep()
        for bits in (7, 8, 10, 16, 24, 32):
            for name in ("counter", "PacketCounter", "field.header.seq", "cnt8", "xyzzy"):
                path = self.table("c.csv", f"{name},w_dph", (keep + 2**bits - 50) % 2**bits, self.w(len(keep)))
                self.all_found(path, "--map", "rate_hz=100")
        for step in (4, 8):
            self.all_found(self.table("c.csv", "loopIteration,w_dph", step * keep, self.w(len(keep))), "--map", "rate_hz=100")

    def test_times_that_begin_anew(self):
        keep = self.keep()
        for name, times in (("time_us", (2**32 - 10_000_000 + keep * 10_000) % 2**32),
                            ("tow_s", numpy.round((604790 + keep * 0.01) % 604800, 3)),
                            ("tow_ms", (604790_000 + keep * 10) % 604800_000),
                            ("time", [f"{h // 3600 % 24:02d}:{h // 60 % 60:02d}:{h % 60:02d}.{k % 100 * 10:03d}"
                                      for k in keep for h in [86390 + k // 100]])):
            self.all_found(self.table("t.csv", f"{name},w_dph", times, self.w(len(keep))))

    def test_seconds_and_their_fraction_in_two_columns(self):
        keep = self.keep()
        t = 1_700_000_000_123_456_789 + keep * 10_000_000
        w = self.w(len(keep))
        for parts, name in ((10**9, "nanosec"), (10**6, "usec")):
            head = f"header.stamp.sec,header.stamp.{name},w_dph"
            now = t // (10**9 // parts)
            self.all_found(self.table("s.csv", head, now // parts, now % parts, w))
            bare = self.table("s.csv", "# no names", now // parts, now % parts, w)
            self.all_found(bare, "--map", "axis=3", "--map", "unit=deg/h", "--map", "holds=rate")

    def test_dates_of_three_countries(self):
        keep = self.keep()
        w = self.w(len(keep))
        def stamp(k, form):
            ms = 24 * 3600_000 - 5000 + k * 10  # midnight within
            day, ms = 21 + ms // 86400_000, ms % 86400_000
            h, m, s = ms // 3600_000, ms // 60_000 % 60, ms % 60_000 / 1000
            return form.format(day=day, h=h, h12=(h + 11) % 12 + 1, m=m, s=s, half="AM" if h < 12 else "PM")
        for form in ("9/{day}/2023 {h12}:{m:02d}:{s:06.3f} {half}", "{day}/09/2023 {h:02d}:{m:02d}:{s:06.3f}",
                     "2023/09/{day} {h:02d}:{m:02d}:{s:06.3f}", "{day}.09.2023 {h:02d}:{m:02d}:{s:06.3f}"):
            path = self.table("d.csv", "Time,w_dph", [stamp(int(k), form) for k in keep], w)
            self.all_found(path, "--map", "rate_hz=100")
            self.all_found(path)

    def test_days(self):
        keep = self.keep()
        days = [f"{59215 + k / 1440:.9f}" for k in keep]
        self.all_found(self.table("mjd.csv", "MJD,w_dph", days, self.w(len(keep))))
        self.all_found(self.table("t.csv", "t,w_dph", days, self.w(len(keep))), "--map", "time_unit=d")

    def test_files_of_one_record(self):
        n, w = 3000, self.rates(3000)
        parts = [range(0, 1000), range(1000, 1950), range(2000, 3000)]
        stamp = lambda k: f"2026-03-01 23:59:{40 + k / 100:06.3f}" if k < 2000 else f"2026-03-02 00:00:{(k - 2000) / 100:06.3f}"
        for head, form, said in (("t_s,w_dph", lambda k: f"{k / 100:.2f}", []), ("when,w_dph", stamp, []),
                                 ("seq,w_dph", lambda k: k % 256, ["--map", "rate_hz=100"])):
            paths = [self.table(f"part{i}.csv", head, [form(k) for k in part], [f"{w[k]:.6f}" for k in part]) for i, part in enumerate(parts)]
            out = self.folder / "a.csv"
            self.succeed("import", *paths, *said, "--out", out, "--force")
            _, axis = self.mean(out)
            self.assertEqual((axis["samples"], axis["known"], axis["gaps"]), (n, n - 50, 1))
            if head != "seq,w_dph":
                self.refuse((2, 3), "import", paths[1], paths[0], "--out", out, "--force", *said)
        # Seconds and nanoseconds apart, from whose first second on times count: of files that begin an hour apart.
        paths = [self.table(f"ros{i}.csv", "stamp.sec,stamp.nanosec,w_dph", [at + k // 100 for k in range(1000)],
                            [k % 100 * 10_000_000 for k in range(1000)], self.w(1000)) for i, at in enumerate((1000, 4600))]
        self.succeed("import", *paths, "--out", out, "--force")
        _, axis = self.mean(out)
        self.assertEqual((axis["samples"], axis["known"], axis["gaps"]), (361_000, 2000, 1))
        self.refuse((2, 3), "import", *reversed(paths), "--out", out, "--force", says=("ros0.csv", "order of their times"))
        other = self.table("other.csv", "t_s,v_dph", [1, 2, 3], [1, 2, 4])
        self.refuse(2, "import", paths[0], other, says=("other.csv", "columns"))

    def test_stamps_on_a_grid_that_is_no_decimal(self):
        # Of 2000 rows none is missing: a clock that ticks 64 times a second, numbers of 32 bits, whole seconds.
        k = numpy.arange(2000)
        for rate, stamps in ((50, numpy.floor(k * 0.02 * 64) / 64), (100, numpy.float32(1e5 + k / 100).astype(float))):
            path = self.table("g.csv", "t_s,w_dph", [f"{t:.7f}" for t in stamps], self.w(2000))
            _, axis = self.mean(path)
            self.assertEqual((axis["samples"], axis["gaps"]), (2000, 0))
            self.assertAlmostEqual(axis["rate_hz"], rate, delta=0.001 * rate)
        path = self.table("g.csv", "t_s,w_dph", numpy.floor(k / 0.95).astype(int), self.w(2000))
        self.refuse(3, "analyze", path, says=("1.05", "105 are missing", "rate_hz"))
        self.assertEqual(self.counted(path, "--map", "rate_hz=0.95"), (2000, 2000, 0))
        self.assertEqual(self.counted(path, "--map", "rate_hz=1"), (2105, 2000, 105))
        # By chance they are missing.
        there = numpy.sort(numpy.random.default_rng(5).permutation(2105)[:2000])
        path = self.table("g.csv", "t_s,w_dph", there, self.w(2000))
        self.assertEqual(self.counted(path)[1], 2000)

    def test_clocks_that_are_none(self):
        k = numpy.arange(2000)
        s = 36120 + k
        self.refuse(3, "analyze", self.table("h.csv", "utc_s,w_dph", s // 3600 * 10000 + s // 60 % 60 * 100 + s % 60, self.w(2000)),
                    says=("100259", "in one number"))
        back = 13800 + k - 3600 * (k >= 600)
        for form in (lambda t: f"2024-03-05T{t // 3600:02d}:{t // 60 % 60:02d}:{t % 60:02d}Z", lambda t: str(1_700_000_000 + t)):
            self.refuse((2, 3), "analyze", self.table("b.csv", "time_s,w_dph", [form(int(t)) for t in back], self.w(2000)))
        t = numpy.cumsum(numpy.where(k < 1000, 0.01, 0.01 / 1.05))
        self.refuse(3, "analyze", self.table("r.csv", "t_s,w_dph", [f"{x:.6f}" for x in t], self.w(2000)), says=("one rate",))
        t = numpy.cumsum(numpy.where((k > 700) & (k < 1300), 0.01 / 0.9, 0.01))
        self.refuse(3, "analyze", self.table("r.csv", "t_s,w_dph", [f"{x:.6f}" for x in t], self.w(2000)), says=("one rate",))
        t = numpy.cumsum(0.01 * (1 + numpy.clip(self.rng.normal(0, 0.1, 1000), -0.4, 0.4)))
        run("analyze", self.table("j.csv", "t_s,w_dph", [f"{x:.6f}" for x in t], self.w(1000)), check=True)
        noted = run("analyze", self.table("u.csv", "time_s,w_dph", k / 100, self.w(2000)), "--map", "time_unit=ms")
        self.assertIn("in ms as said, against its name", noted.stderr)
        date = self.table("d.csv", "date,time,w_dph", numpy.where(k < 600, "2024-12-30", "2024-12-31"),
                          [f"{x // 3600:02d}:{x // 60 % 60:02d}:{x % 60:02d}" for x in 36000 + k], self.w(2000))
        self.assertIn("'date'", run("analyze", date).stderr)
        paths = [self.table(f"z{i}.csv", "t_s,w_dph", k, self.w(2000)) for i in range(2)]
        self.refuse(2, "import", *paths, "--out", self.folder / "z_out.csv", says=("z1.csv", "first file"))

    def test_what_is_not_used_is_named(self):
        n = 400
        t = numpy.arange(n) * 0.01
        noted = run("analyze", self.table("w.csv", "Time,w_dph", ["T" + str(k) for k in range(n)], self.w(n)), "--map", "rate_hz=100")
        self.assertIn("'Time'", noted.stderr)
        noted = run("analyze", self.table("r.csv", "heading,w_dph", numpy.round((300 + 7.3 * numpy.arange(n)) % 360, 3), self.w(n)),
                    "--map", "rate_hz=100")
        self.assertIn("'heading'", noted.stderr)
        both = self.table("two.csv", "time_s,unix_s,w_dph", t, t * 2, self.w(n))
        self.refuse(2, "analyze", both, "--map", "time=1", "--map", "rate_hz=50", says=("'time_s'", "0.01"))


class Sensors(ForeignCase):
    def by_turns(self, names):
        n, k = 2000, numpy.arange(2000)
        kinds = [names[i] for i in k % len(names)]
        w = [f"{x:.5f}" for x in self.rng.normal(0.03, 0.001, n) + 9.81 * (k % len(names) == 1)]
        return kinds, w

    def test_by_turns_whatever_the_column_is_called(self):
        said = ["--map", "axis=w", "--map", "unit=rad/s", "--map", "holds=rate", "--map", "rate_hz=200"]
        for column in ("type", "name", "topic", "msg"):
            for names in (("GYRO", "ACC"), ("GYRO", "ACC", "MAG"), (3, 7)):
                path = self.table("m.csv", f"{column},w", *self.by_turns(names))
                self.refuse(2, "analyze", path, *said, says=(f"'{column}'", str(names[0]), str(names[1]), "--map sensor="))
        path = self.table("m.csv", "type,w", *self.by_turns(("GYRO", "ACC")))
        mean, axis = self.mean(path, *said[:6], "--map", "rate_hz=100", "--map", "sensor=GYRO")
        self.assertEqual(axis["samples"], 1000)
        self.assertAlmostEqual(mean, 0.03 * 206264.806, delta=30)
        self.mean(path, *said, "--map", "sensor=none")
        # All questions come at once, as of the rows of one.
        self.refuse(2, "analyze", path, says=("--map sensor=GYRO or ACC", "'type'", "unit=... (of column 2, 'w'", "holds=", "rate_hz="))

    def test_a_word_whose_rows_make_no_table_leaves_the_question(self):
        kinds, w = self.by_turns(("GYRO", "ACC"))
        path = self.table("i.csv", "type,w", ["INIT", *kinds], ["0.1", *w])
        self.refuse(2, "analyze", path, says=("--map sensor=INIT or GYRO", "'type'"))

    def test_sentences(self):
        rows = []
        for k in range(1000):
            rows.append(f"$GYRO,{k / 100:.3f},{self.rng.normal(0.03, 0.001):.6f}*4A")
            rows.append(f"$ACCL,{k / 100 + .005:.3f},{self.rng.normal(9.81, 0.01):.4f},7*1B")
        path = self.write("n.txt", "\n".join(rows) + "\n")
        said = ["--map", "unit=rad/s", "--map", "holds=rate", "--map", "time_unit=s"]
        self.refuse((2, 3), "analyze", path, *said)
        self.assertAlmostEqual(self.mean(path, *said, "--map", "sensor=$GYRO")[0], 0.03 * 206264.806, delta=30)

    def test_words_that_are_no_sensor(self):
        n = 1000
        for words in (["ok"] * n, ["OK" if k % 97 else "WARN" for k in range(n)], ["L" if k // 100 % 2 else "R" for k in range(n)],
                      list(self.rng.choice(["a", "b", "c"], n)), list(self.rng.integers(0, 3, n)), [k % 2 for k in range(n)]):
            self.mean(self.table("w.csv", "t_s,state,w_dph", numpy.arange(n) / 100, words, self.w(n)), "--map", "axis=w_dph")


    def test_a_key_that_the_file_cannot_use_is_refused(self):
        both = numpy.zeros((4000, 2))
        both[1::2] = (1, 9.81)
        numpy.save(self.folder / "both.npy", both)
        said = ["--map", "axis=2", "--map", "holds=rate", "--map", "unit=deg/s", "--map", "rate_hz=200"]
        self.refuse(2, "analyze", self.folder / "both.npy", *said, says=("column 1",))
        self.refuse(2, "analyze", self.folder / "both.npy", *said, "--map", "sensor=0", says=("sensor = 0", "text"))
        for key in ("skip_lines=500", "topic=/imu", "encoding=utf-8", "decimal=comma", "separator=tab", "comment=%", "table=x"):
            self.refuse(2, "analyze", self.folder / "both.npy", *said, "--map", "sensor=none", "--map", key, says=(key.split("=")[0],))
        path = self.table("w.csv", "t_s,w_dps", numpy.arange(400) / 100, self.w(400))
        for key in ("topic=/imu", "table=x", "table_unit=deg/s", "mode_plus=1"):
            self.refuse(2, "analyze", path, "--map", key, says=(key.split("=")[0],))


class NoMeasurements(ForeignCase):
    def warnings(self, w, *said, name="w_dps"):
        path = self.table("w.csv", f"t_s,{name}", [f"{k / 100:.2f}" for k in range(len(w))], w)
        result = run("analyze", path, "--map", "axis=2", "--map", "holds=rate", *said, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)["axes"][0]["warnings"], path

    def test_rows_that_repeat(self):
        for times in (2, 3, 5, 10):
            (line,), path = self.warnings(numpy.round(numpy.repeat(self.rng.normal(0, 1, 6000 // times), times), 4))
            self.assertIn(f"each value stands {times} times", line)
        page = self.folder / "p.html"
        text = run("analyze", path, "--map", "holds=rate", "--strict", "--out", page)
        self.assertEqual(text.returncode, 1)
        for shown in (text.stdout, page.read_text()):
            self.assertIn("each value stands 10 times", shown)
        out = self.folder / "a.csv"
        self.assertEqual(run("import", path, "--map", "holds=rate", "--strict", "--out", out).returncode, 1)
        self.assertEqual(run("import", path, "--map", "holds=rate", "--strict").returncode, 1)
        self.refuse(2, "import", self.table("open.csv", "t_s,w", [0, 1, 2, 3], [1, 2, 4, 5]), "--strict", says=("--map unit=", "holds="))

    def test_a_value_that_stands(self):
        w = numpy.round(self.rng.normal(0, 1, 6000), 4)
        w[2000:3000] = w[2000]
        (line,), _ = self.warnings(w)
        self.assertIn("rows 2001 to 3000", line)

    def test_samples_that_were_lost_and_written_as_0(self):
        for share, mean in ((0.05, 1.0), (0.5, 0.0), (0.01, 0.0)):
            w = numpy.round(self.rng.normal(mean, 1, 6000), 4)
            w[self.rng.random(6000) < share] = 0
            self.assertTrue(any("exactly 0" in line for line in self.warnings(w)[0]), share)
        # A counter that hardly counts is at 0 by right, also as differences of angles, or where it moves later.
        rest = numpy.round(self.rng.normal(0, 0.6, 6000))
        moves = numpy.where(numpy.arange(6000) < 3000, rest, numpy.round(self.rng.normal(300, 40, 6000)))
        for w in (numpy.round(self.rng.normal(0, 3, 6000)), numpy.round(self.rng.normal(0, 1, 6000), 2), moves,
                  numpy.diff(numpy.cumsum(numpy.concatenate([[0], rest])) * 3.263)):
            self.assertFalse(any("exactly 0" in line for line in self.warnings(w)[0]))

    def test_rails(self):
        t = numpy.arange(6000) / 100
        for low, high in ((-250, 250), (-1e9, 250), (-250, 1e9)):
            (line,), _ = self.warnings(numpy.round(numpy.clip(100 + 400 * numpy.sin(t) + self.rng.normal(0, 1, 6000), low, high), 4))
            self.assertEqual(("at 250" in line, "at -250" in line), (high == 250, low == -250))

    def test_what_measures_has_no_warnings(self):
        t = numpy.arange(6000) / 100
        noise = self.rng.normal(0, 1, 6000)
        for w in (noise, numpy.round(noise), numpy.round(3 * noise), numpy.round(0.5 * noise), numpy.round(100 * numpy.sin(t)),
                  numpy.round(noise * 30, 2), numpy.round(100 * numpy.sin(t) + 0.3 * noise), numpy.round(noise, 1),
                  numpy.where(t < 30, 0, numpy.round(50 * noise))):
            warnings, path = self.warnings(numpy.round(w, 6))
            self.assertEqual(warnings, [])
            self.succeed("analyze", path, "--map", "axis=2", "--map", "holds=rate", "--strict")

    def test_messages_that_stand_twice(self):
        rows = []
        for k in range(3000):
            rows += [(k * 0.01, self.rng.normal())] * (2 if k % 3 == 1 else 1)
        t = [f"{row[0] + (2e-5 if k and rows[k - 1] == row else 0):.6f}" for k, row in enumerate(rows)]
        path = self.table("t.csv", "t_s,w_dps", t, [f"{row[1]:.6f}" for row in rows])
        _, axis = self.mean(path)
        self.assertEqual((axis["samples"], axis["rate_hz"]), (3000, 100))
        self.assertIn("1000 rows come 2e-05 behind", axis["warnings"][0])
        other = self.table("t.csv", "t_s,w_dps", t, self.w(len(t)))
        self.refuse(3, "analyze", other, says=("row 3", "other values", "time=none"))

    def test_rows_that_jump_away_and_back(self):
        for marks in ([1e10], [65535], [-9998], [50.0, -60.0, 70.0]):
            w = numpy.round(self.rng.normal(0, 0.02, 6000), 5)
            w[numpy.arange(len(marks)) * 700 + 1000] = marks
            w[4000:4020] = marks[0]
            warnings, path = self.warnings(w)
            self.assertIn(f"{20 + len(marks)} rows jump away", warnings[0])
            self.assertIn("row 1001", warnings[0])
        # Of a log of our own too, and not where it is turned from rate to rate.
        out = self.folder / "own.csv"
        self.succeed("import", path, "--map", "holds=rate", "--out", out)
        self.assertEqual(run("analyze", out, "--strict").returncode, 1)
        steps = numpy.round(numpy.repeat([0, 50, 0, -50, 0], 1200) + self.rng.normal(0, 0.02, 6000), 5)
        self.assertEqual(self.warnings(steps)[0], [])

    def test_a_stage_that_is_far_off_the_others(self):
        table = numpy.repeat(numpy.arange(-8, 9) * 10.0, 100)
        w = table + self.rng.normal(0, 0.01, len(table))
        said = ["--map", "axis=w_dps", "--map", "table_rate=table_dps", "--map", "rate_hz=100"]
        self.assertEqual(run("analyze", self.table("r.csv", "table_dps,w_dps", table, w), *said, "--strict").returncode, 0)
        w[400:500] += 1.0
        told = run("analyze", self.table("r.csv", "table_dps,w_dps", table, w), *said, "--strict")
        self.assertEqual(told.returncode, 1)
        self.assertIn("stage 5 of 17, at -144000 arcsec/s", told.stderr)

    def test_what_follows_the_temperature_is_no_ramp_and_no_walk(self):
        n = 20000
        t = 25 + 10 * (1 - numpy.exp(-numpy.arange(n) / 4000))
        w = 9.0 + 2.0 * (t - 25) + self.rng.normal(0, 0.5, n)
        path = self.table("t.csv", "w_dph,temp_c", [f"{x:.5f}" for x in w], [f"{x:.4f}" for x in t])
        said = ["--map", "rate_hz=1", "--map", "axis=w_dph"]
        _, plain = self.mean(path, *said)
        _, axis = self.mean(path, *said, "--map", "temperature_c=temp_c")
        found = lambda one: {term["term"] for term in one["fit"]["terms"] if term["found"]}
        self.assertTrue(found(plain) & {"ramp", "rate random walk", "bias instability"})
        # What the error of the law leaves may be a ramp: of 20 deg/h over the record less than a hundredth.
        self.assertEqual(found(axis) - {"ramp"}, {"angle random walk"})
        ramp, = (term for term in axis["fit"]["terms"] if term["term"] == "ramp")
        self.assertLess(abs(ramp["value"] or 0.0) * n, 0.2)
        bias = axis["temperature"]["bias"]
        self.assertLess(abs(bias[1]["value"] - 2.0), 4 * bias[1]["sigma"])
        self.assertLess(bias[1]["sigma"], 0.01)
        self.refuse(2, "import", path, *said, "--map", "temperature_c=temp_c", "--out", self.folder / "a.csv", says=("temperature_c",))

    def test_a_temperature_in_another_unit_is_taken_in_degrees_celsius(self):
        n = 4000
        t = 25 + 10 * numpy.sin(numpy.arange(n) / 300)
        w = 9.0 + 2.0 * (t - 25) + self.rng.normal(0, 0.5, n)
        laws = []
        for name, values in (("temp_c", t), ("temp_F", 32 + 1.8 * t), ("temp [\u00b0F]", 32 + 1.8 * t), ("T_K", 273.15 + t), ("T (m\u00b0C)", 1e3 * t),
                             ("temp [deg F]", 32 + 1.8 * t), ("temp/K", 273.15 + t), ("temp [ K ]", 273.15 + t), ("temp_mK", 1e3 * (273.15 + t)),
                             ("temp.degC", t), ("T_1 [\u00b0 C]", t), ("TempF", 32 + 1.8 * t), ("tempf", 32 + 1.8 * t), ("temp_f_avg", 32 + 1.8 * t),
                             ("boardTempK", 273.15 + t), ("T_c [K]", 273.15 + t), ("T_fahr", 32 + 1.8 * t)):
            path = self.table("t.csv", f"w_dph,{name}", w, [f"{x:.9f}" for x in values])
            said = run("analyze", path, "--map", "rate_hz=1", "--map", "axis=w_dph", "--map", f"temperature_c={name}", "--json")
            laws.append(json.loads(said.stdout)["axes"][0]["temperature"]["bias"][1]["value"])
            self.assertEqual("is taken in C" in said.stderr, values is not t, name)
        numpy.testing.assert_allclose(laws, laws[0], rtol=1e-6)

    def test_what_is_no_temperature_by_its_name_is_refused(self):
        n = 400
        for name in ("temp [1/10 C]", "temp (0.1 C)", "temp_degC_x10", "temp_cC", "temp_dK", "temp [milli\u00b0C]", "T [10 mK]", "temp_mV", "temp_adc", "NTC (kohm)"):
            path = self.table("t.csv", f"w_dph,{name}", self.w(n), numpy.arange(n))
            self.refuse(2, "analyze", path, "--map", "rate_hz=1", "--map", "axis=w_dph", "--map", f"temperature_c={name}", says=("mK and F",))
        for name in ("board", "Temp (axis 1)", "uC_temp", "NTC [k\u03a9]"):
            path = self.table("t.csv", f"w_dph,{name}", self.w(n), 20 + numpy.arange(n) / n)
            noted = run("analyze", path, "--map", "rate_hz=1", "--map", "axis=w_dph", "--map", f"temperature_c={name}")
            self.assertIn(f"'{name}' is taken in C, which its name does not say", noted.stderr)


class Heads(ForeignCase):
    def test_units_behind_a_stroke_or_a_point(self):
        for name, times in (("Time/s", 1), ("t/s", 1), ("time.s", 1), ("Zeit / ms", 1000), ("data.t [s]", 1), ("meas.t/ms", 1000)):
            _, axis = self.mean(self.table("n.csv", f"{name},w_dph", numpy.arange(400) / 100 * times, self.w(400)))
            self.assertEqual((axis["rate_hz"], axis["samples"]), (100, 400), name)

    def test_a_scale_is_asked_for(self):
        counts = self.rng.integers(-300, 300, 400)
        for head in ("gscale,0.00122", "# sensitivity 131 LSB/dps", "# Scale factor: 0.01", "# Skalierung = 0,5"):
            path = self.table("h.csv", f"{head}\nt_s,w_dps", numpy.arange(400) / 100, counts)
            self.refuse(2, "analyze", path, says=("--map scale=", head.strip("# ")[:6]))
            mean, _ = self.mean(path, "--map", "scale=0.5")
            self.assertAlmostEqual(mean, counts.mean() * 0.5 * 3600, delta=1e-6 * 3600)
        self.mean(self.table("h.csv", "# Full scale: 250 dps\nt_s,w_dps", numpy.arange(400) / 100, counts))

    def test_encodings(self):
        rows = "".join(f"{k / 100:.2f};{x}\n" for k, x in enumerate(self.w(400)))
        text = "Время, с;Угловая скорость, град/ч\n" + rows
        for encoding, said in (("utf-8", []), ("cp1251", ["--map", "encoding=windows-1251"])):
            path = self.folder / "r.csv"
            path.write_bytes(text.encode(encoding))
            if said:
                self.refuse(2, "analyze", path, says=("encoding=windows-1251", "latin-1"))
            _, axis = self.mean(path, *said)
            self.assertEqual((axis["rate_hz"], axis["holds"]), (100, "rates, deg/h"))

    def test_the_mode_of_a_plain_rate(self):
        n = 6000
        mode = numpy.where(numpy.arange(n) // 600 % 2 == 0, 1, -1)
        w = [f"{x:.6f}" for x in 10 + 2 * mode + self.rng.normal(0, 0.01, n)]
        for plus, column in (([], mode), (["--map", "mode_plus=0"], (1 - mode) // 2)):
            path = self.table("m.csv", "t_s,w_dph,state", numpy.arange(n) / 100, w, column)
            _, axis = self.mean(path, "--map", "mode=state", *plus)
            self.assertAlmostEqual(axis["modes"]["magnetic_arcsec_s"]["value"], 2, delta=0.01)
            out = self.folder / "a.csv"
            self.succeed("import", path, "--map", "mode=state", *plus, "--out", out, "--force")
            _, again = self.mean(out)
            self.assertAlmostEqual(again["modes"]["magnetic_arcsec_s"]["value"], 2, delta=0.01)

    def test_missing_as_microsoft_writes_it(self):
        w = self.w(400)
        for k, word in ((10, "-1.#IND"), (11, "1.#QNAN"), (12, "-1.#IND00"), (13, "#DIV/0!")):
            w[k] = word
        self.assertEqual(self.counted(self.table("m.csv", "t_s,w_dph", numpy.arange(400) / 100, w)), (400, 396, 1))


class Contradictions(ForeignCase):
    def test_what_the_head_of_a_log_of_ours_says_stands(self):
        log = self.folder / "raw.csv"
        self.succeed("simulate", "--duration", "2", "--out", log)
        self.refuse(2, "process", log, "--map", "scale_arcsec=7", "--out", self.folder / "a.csv", says=("scale_arcsec", "the head of"))

    def test_two_units_of_a_data_set(self):
        path = self.folder / "u.h5"
        with h5py.File(path, "w") as file:
            file["w"] = self.rates(600)
            file["w"].attrs["unit"], file["w"].attrs["units"] = "deg/s", "rad/s"
        self.refuse(2, "analyze", path, "--map", "rate_hz=100", says=("deg/s or rad/s", "unit="))

    def test_the_day_and_the_month_in_files_of_one_record(self):
        stamps = lambda day: [f"02/{day:02d}/2026 {s // 3600:02d}:{s // 60 % 60:02d}:{s % 60:02d}" for s in range(0, 86400, 10)]
        for days in ((1, 2), (12, 13)):
            paths = [self.table(f"d{day}.csv", "Time,w_dph", stamps(day), self.w(8640)) for day in days]
            out = self.folder / "a.csv"
            self.succeed("import", *paths, "--out", out, "--force")
            self.assertEqual(self.mean(out)[1]["samples"], 17280)

    def test_ticks_of_a_clock_printed_to_milliseconds(self):
        k = numpy.arange(6000)
        for row in (0.01, 0.02, 0.025):
            stamps = numpy.floor(k * row * 64) / 64
            _, axis = self.mean(self.table("g.csv", "t_s,w_dph", [f"{t:.3f}" for t in stamps], self.w()))
            self.assertEqual((axis["samples"], axis["gaps"]), (6000, 0))
            self.assertAlmostEqual(axis["rate_hz"], 1 / row, delta=0.002 / row)

    def test_sentences_of_novatel(self):
        rows = [f"%RAWIMUSA,2386,{99960 + k / 200:.3f};2386,{99960 + k / 200:.9f},00000077,-280,-241,-260,-125,{k % 7},-{k % 5}*54155249"
                for k in range(800)]
        path = self.write("r.asc", "\n".join(rows) + "\n")
        mean, axis = self.mean(path, *(x for said in ("axis=12", "time=5", "time_unit=s", "holds=increment", "unit=counts", "scale_arcsec=0.1")
                                       for x in ("--map", said)))
        self.assertEqual((axis["samples"], axis["rate_hz"]), (800, 200))
        self.assertAlmostEqual(mean, -2.0 * 0.1 * 200, places=6)

    def test_strict_and_suffixes_of_process(self):
        log = self.folder / "raw.csv"
        self.succeed("simulate", "--duration", "2", "--out", log)
        self.succeed("process", log, "--strict", "--out", self.folder / "A.MCAP")
        self.assertTrue((self.folder / "A.MCAP").read_bytes().startswith(b"\x89MCAP"))


if __name__ == "__main__":
    unittest.main()
