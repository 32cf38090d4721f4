"""What a laboratory brings along: tables in the dialects of spreadsheets, columns with names, times of rows, logs without facts."""

import csv
import io
import json

import h5py

from support import SAID, CliTest, csv_text, quiet_log, run, warnings

RATE = ["--map", "holds=rate", "--map", "unit=arcsec/s", "--map", "rate_hz=100"]


class OwnTables(CliTest):
    def mean_of(self, path, *arguments):
        result = run("analyze", path, *arguments, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)["axes"][0]["mean_rate_arcsec_s"], result

    def rates(self, n=400, mean=15.04):
        return [self.random.gauss(mean, 1.0) for _ in range(n)]

    def test_an_ambiguous_table_names_both_readings_and_what_decides(self):
        path = self.write("one.csv", "".join(f"0,{int(4000 + k * 37 % 100):06d}\n" for k in range(50)))
        self.refuse(2, "analyze", path, *RATE, says=("separator comma", "decimal comma", "--map separator", "--map decimal"))
        mean, _ = self.mean_of(path, *RATE, "--map", "decimal=comma")
        self.assertAlmostEqual(mean, sum(4000 + k * 37 % 100 for k in range(50)) / 50e6, delta=1e-12)

    def test_a_column_of_times_is_no_rate_by_default(self):
        rows = [f"{k / 100:.2f},{rate:.6f},{20 + k % 3 / 10}" for k, rate in enumerate(self.rates())]
        path = self.write("lab.csv", "time,gyro_z,temp\n" + "\n".join(rows) + "\n")
        self.refuse(2, "analyze", path, *RATE, says=("--map axis=COLUMN, of 'gyro_z', 'temp'",))
        bare = self.write("bare.csv", "\n".join(rows) + "\n")
        self.refuse(2, "analyze", bare, *RATE, says=("--map axis=COLUMN, of 2, 3",))
        self.refuse(2, "analyze", bare, *RATE, "--map", "axis=1", says=("axis = 1", "times of the rows"))
        angle = self.write("angle.txt", "".join(f"{0.15 * k!r}\n" for k in range(200)))
        mean, _ = self.mean_of(angle, "--map", "axis=1", "--map", "time=none", "--map", "holds=angle", "--map", "unit=arcsec", "--map",
                               "rate_hz=100")
        self.assertAlmostEqual(mean, 15.0, delta=1e-9)

    def test_times_of_rows_are_held_against_the_rate(self):
        rates = self.rates()
        rows = [f"{k / 100:.2f},{rate:.6f}" for k, rate in enumerate(rates)]
        path = self.write("lab.csv", "time,w\n" + "\n".join(rows) + "\n")
        said = ["--map", "axis=w", "--map", "holds=rate", "--map", "unit=arcsec/s"]
        self.refuse(2, "analyze", path, *said, "--map", "rate_hz=200", says=("100 Hz", "0.005 s", "time=none"))
        self.refuse(2, "analyze", path, *said, says=("time_unit=s", "100 Hz"))
        self.mean_of(path, *said, "--map", "rate_hz=200", "--map", "time=none")
        holes = self.write("holes.csv", "time,w\n" + "\n".join(rows[:100] + rows[120:]) + "\n")
        result = run("analyze", holes, *said, "--map", "rate_hz=100", "--json")
        axis = json.loads(result.stdout)["axes"][0]
        self.assertEqual((axis["samples"], axis["known"], axis["gaps"]), (400, 380, 1))
        self.assertIn("20 rows are missing", result.stderr)


class OwnLogs(CliTest):
    """Raw logs as spreadsheets and MATLAB write them."""

    def setUp(self):
        super().setUp()
        self.rows = [dict(row, counts=row["counts"] + self.random.randint(-2, 2), detuning_lambda=0.01 * (row["half"] % 7), temperature_c=20.5 + row["half"] / 64)
                     for row in quiet_log(60, gap=range(20, 23))]

    def angles(self, text, name="raw.csv"):
        out = self.folder / "angles.csv"
        self.succeed("process", self.write(name, text), "--out", out, "--force", *SAID)
        return [line for line in out.read_text().splitlines() if not line.startswith("#")]

    def test_a_log_in_any_dialect_is_the_same_log(self):
        plain = csv_text(self.rows, facts=False)
        expected = self.angles(plain)
        table = list(csv.reader(plain.splitlines()))
        for separator, mark, quoting in ((";", ",", csv.QUOTE_MINIMAL), (";", ".", csv.QUOTE_ALL), ("\t", ",", csv.QUOTE_MINIMAL),
                                         (" ", ",", csv.QUOTE_MINIMAL), ("|", ".", csv.QUOTE_MINIMAL), (",", ",", csv.QUOTE_ALL),
                                         (",", ".", csv.QUOTE_ALL)):
            text = io.StringIO()
            writer = csv.writer(text, delimiter=separator, quoting=quoting)
            for row in table:
                writer.writerow([field.replace(".", mark) for field in row])
            with self.subTest(separator=separator, mark=mark):
                self.assertEqual(self.angles(text.getvalue()), expected)
                self.assertEqual(self.angles("\ufeff" + text.getvalue()), expected)

    def test_temperatures_in_kelvin_become_degrees_celsius(self):
        for row in self.rows:
            row["temp_K"] = row.pop("temperature_c") + 273.15
        out = self.folder / "raw.csv"
        said = self.succeed("import", self.write("kelvin.csv", csv_text(self.rows, list(self.rows[0]), facts=False)), "--map", "tick_s=0.005", "--map", "scale_arcsec=3.263", "--map", "temperature_c=temp_K", "--out", out)
        self.assertIn("'temp_K' is in K by its name, and is taken in C", said.stderr)
        found = csv.DictReader(line for line in out.read_text().splitlines() if not line.startswith("#"))
        for row, expected in zip(found, self.rows, strict=True):
            self.assertAlmostEqual(float(row["temperature_c"]), expected["temp_K"] - 273.15, places=9)

    def test_hdf5_behind_a_user_block_is_read(self):
        plain = self.folder / "plain.h5"
        self.succeed("convert", self.write("raw.csv", csv_text(self.rows)), "--out", plain)
        expected = self.folder / "expected.csv"
        self.succeed("process", plain, "--out", expected)
        for block in (512, 2048):
            path = self.folder / f"block{block}.mat"
            with h5py.File(plain) as source, h5py.File(path, "w", userblock_size=block) as copy:
                for name, value in source.attrs.items():
                    copy.attrs[name] = value
                for name in source:
                    source.copy(name, copy)
            with open(path, "r+b") as file:
                file.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64")
            out = self.folder / "angles.csv"
            self.succeed("process", path, "--out", out, "--force")
            self.assertEqual(out.read_bytes(), expected.read_bytes())

    def test_a_log_says_its_tick_and_scale_or_the_user_does(self):
        bare = csv_text(self.rows, facts=False)
        raw, out = self.write("raw.csv", bare), self.folder / "out.csv"
        both = ("tick_s and scale_arcsec", "--set gyro.tick_s=", "--set gyro.scale_arcsec=")
        h5 = self.folder / "raw.h5"
        self.assertEqual(len(warnings(self.succeed("convert", raw, "--out", h5))), 2)
        with h5py.File(h5) as file:
            self.assertNotIn("tick_s", file.attrs)
            self.assertNotIn("scale_arcsec", file.attrs)
        for log in (raw, h5):
            self.refuse(2, "process", log, "--out", out, says=both)
            self.refuse(2, "analyze", log, says=both)
            self.refuse(2, "calibrate", log, says=both)
            self.refuse(2, "process", log, "--out", out, *SAID[:2], says=("does not say scale_arcsec, ",))
            self.refuse(2, "process", log, "--out", out, *SAID[2:], says=("does not say tick_s, ",))
            self.succeed("process", log, "--out", out, "--force", *SAID)
            found = json.loads(run("inspect", log, "--json").stdout)
            self.assertEqual((found["tick_s"], found["scale_arcsec"], found["duration_s"]), (None, None, None))
            self.assertRegex(run("inspect", log).stdout, r"tick_s +not given")
        config = self.write("gyro.toml", "[gyro]\ntick_s = 0.005\nscale_arcsec = 3.263\n")
        self.succeed("process", raw, "--out", out, "--force", "--config", config)

    def test_an_angle_log_says_its_tick_or_the_user_does(self):
        out = self.folder / "angles.csv"
        self.succeed("process", self.write("raw.csv", csv_text(self.rows)), "--out", out)
        bare = self.write("bare.csv", "".join(line for line in out.read_text().splitlines(True)
                                              if not line.startswith(("# gyro.tick_s", "# tick_s"))))
        self.refuse(2, "analyze", bare, says=("does not say tick_s, ", "--set gyro.tick_s="))
        said = json.loads(self.succeed("analyze", bare, "--set", "gyro.tick_s=0.005", "--json").stdout)
        self.refuse(3, "analyze", bare, "--set", "gyro.tick_s=0.01", says=("tick_s = 0.01", "t_s", "0.005"))
        whole = json.loads(self.succeed("analyze", out, "--json").stdout)
        self.assertEqual(said["axes"][0]["mean_rate_arcsec_s"], whole["axes"][0]["mean_rate_arcsec_s"])
        for suffix in ("csv", "h5"):
            copy = self.folder / f"copy.{suffix}"
            self.assertEqual(len(warnings(self.succeed("convert", bare, "--out", copy))), 1)
            self.refuse(2, "analyze", copy, says=("does not say tick_s, ",))

    def test_our_own_logs_say_both(self):
        for suffix in ("csv", "h5"):
            raw = self.folder / f"raw.{suffix}"
            self.succeed("simulate", "--out", raw, "--duration", "2", "--set", "gyro.tick_s=0.004", "--set", "gyro.scale_arcsec=2")
            copy = self.folder / f"copy.{'h5' if suffix == 'csv' else 'csv'}"
            self.succeed("convert", raw, "--out", copy)
            for log in (raw, copy):
                found = json.loads(run("inspect", log, "--json").stdout)
                self.assertEqual((found["tick_s"], found["scale_arcsec"]), (0.004, 2.0))
