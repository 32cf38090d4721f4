"""What a laboratory brings along: tables in the dialects of spreadsheets, columns with names, times of rows, logs without facts."""

import csv
import io
import json
import math
import random
import struct

import h5py
import numpy

from support import SAID, CliTest, complaints, csv_text, quiet_log, run, warnings

RATE = ["--set", "analysis.column_holds=rate", "--set", "analysis.rate_hz=100"]


def german(value, decimals=6):
    return f"{value:.{decimals}f}".replace(".", ",")


class OwnTables(CliTest):
    def mean_of(self, path, *arguments):
        result = run("analyze", path, *arguments, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)["axes"][0]["mean_rate_arcsec_s"], result

    def rates(self, n=400, mean=15.04):
        return [self.random.gauss(mean, 1.0) for _ in range(n)]

    def test_decimal_commas_between_semicolons_are_read(self):
        rates = self.rates()
        rows = [f"{german(k / 100, 4)};{german(rate / 3600)};{german(24.5, 1)}" for k, rate in enumerate(rates)]
        path = self.write("lab.csv", "time;gyro_z;temp\n" + "\n".join(rows) + "\n")
        mean, _ = self.mean_of(path, *RATE, "--set", "analysis.column=gyro_z", "--set", "analysis.scale_arcsec=3600")
        self.assertAlmostEqual(mean, sum(rates) / len(rates), delta=4e-3)

    def test_a_table_of_any_spreadsheet_is_read_right_or_refused(self):
        read = 0
        for trial in range(60):
            rng = random.Random(trial)
            n_columns, decimals = rng.randint(1, 4), rng.choice([0, 1, 3, 4, 6])
            table = [[round(rng.gauss(0, 1) * 10 ** rng.randint(0, 5), decimals) for _ in range(n_columns)] for _ in range(12)]
            separator, mark = rng.choice([(";", ","), ("\t", ","), (" ", ","), (",", "."), (";", "."), ("\t", "."), (" ", "."), (",", ",")])
            text = io.StringIO()
            writer = csv.writer(text, delimiter=separator, lineterminator=rng.choice(["\n", "\r\n"]),
                                quoting=rng.choice([csv.QUOTE_MINIMAL, csv.QUOTE_ALL, csv.QUOTE_NONNUMERIC]))
            if rng.random() < 0.5:
                writer.writerow([f"Kanal_{c}" for c in range(n_columns)])
            style = rng.choice(["{:.{d}f}", "{:.{d}f}", "{:.{d}e}"])
            known = []
            for row in table:
                fields = [style.format(value, d=decimals) for value in row]
                known.append([float(field) for field in fields])
                writer.writerow([field.replace(".", mark) for field in fields])
            data = (b"\xef\xbb\xbf" if rng.random() < 0.3 else b"") + text.getvalue().encode()
            wanted = rng.randrange(n_columns)
            result = run("analyze", self.write("table.csv", data), *RATE, "--set", f"analysis.column={wanted + 1}", "--json")
            if result.returncode == 0:
                read += 1
                mean = json.loads(result.stdout)["axes"][0]["mean_rate_arcsec_s"]
                expected = sum(row[wanted] for row in known) / len(known)
                self.assertAlmostEqual(mean, expected, delta=1e-9 * max(1.0, max(abs(row[wanted]) for row in known)), msg=data)
            else:
                self.assertEqual((result.returncode, len(complaints(result))), (3, 1), result.stderr + repr(data))
        self.assertGreater(read, 35)

    def test_an_ambiguous_table_names_both_readings_and_what_decides(self):
        path = self.write("one.csv", "".join(f"0,{int(4000 + k * 37 % 100):06d}\n" for k in range(50)))
        self.refuse(3, "analyze", path, *RATE, says=("separator comma", "decimal comma", "analysis.separator", "analysis.decimal"))
        mean, _ = self.mean_of(path, *RATE, "--set", "analysis.decimal=comma")
        self.assertAlmostEqual(mean, sum(4000 + k * 37 % 100 for k in range(50)) / 50e6, delta=1e-12)

    def test_rows_of_different_length_are_refused_with_the_row(self):
        path = self.write("ragged.csv", "1,234,5\n1,234,6\n999,5\n")
        self.refuse(3, "analyze", path, *RATE, "--set", "analysis.column=1", says=("ragged.csv:3",))

    def test_a_column_of_times_is_no_rate_by_default(self):
        rows = [f"{k / 100:.2f},{rate:.6f},{20 + k % 3}" for k, rate in enumerate(self.rates())]
        path = self.write("lab.csv", "time,gyro_z_dps,temp\n" + "\n".join(rows) + "\n")
        self.refuse(2, "analyze", path, *RATE, says=("analysis.column", "'time'", "'gyro_z_dps'", "'temp'"))
        bare = self.write("bare.csv", "\n".join(rows) + "\n")
        self.refuse(2, "analyze", bare, *RATE, says=("analysis.column", "column 1", "2..3"))
        for holds in ("increment", "phase"):
            self.refuse(2, "analyze", bare, "--set", f"analysis.column_holds={holds}", "--set", "analysis.rate_hz=100",
                        says=("analysis.column",))
        self.mean_of(bare, *RATE, "--set", "analysis.column=1")
        angle = self.write("angle.txt", "".join(f"{0.15 * k!r}\n" for k in range(200)))
        mean, _ = self.mean_of(angle, "--set", "analysis.column_holds=phase", "--set", "analysis.rate_hz=100")
        self.assertAlmostEqual(mean, 15.0, delta=1e-9)

    def test_columns_have_names(self):
        rows = [f"{k / 100:.2f},{rate:.6f}" for k, rate in enumerate(self.rates())]
        path = self.write("lab.csv", "time_s,gyro_z_dps\n" + "\n".join(rows) + "\n")
        named, _ = self.mean_of(path, *RATE, "--set", "analysis.column=gyro_z_dps")
        numbered, _ = self.mean_of(path, *RATE, "--set", "analysis.column=2")
        self.assertEqual(named, numbered)
        self.refuse(3, "analyze", path, *RATE, "--set", "analysis.column=gyro_z_dsp", says=("did you mean 'gyro_z_dps'?",))

    def test_times_of_rows_are_held_against_the_rate(self):
        rates = self.rates()
        rows = [f"{k / 100:.2f},{rate:.6f}" for k, rate in enumerate(rates)]
        path = self.write("lab.csv", "time,w\n" + "\n".join(rows) + "\n")
        said = ["--set", "analysis.column=w", "--set", "analysis.column_holds=rate"]
        self.refuse(2, "analyze", path, *said, "--set", "analysis.rate_hz=200", says=("analysis.rate_hz = 200", "100 Hz"))
        self.refuse(2, "analyze", path, *said, says=("analysis.rate_hz", "100 Hz"))
        self.mean_of(path, *said, "--set", "analysis.rate_hz=200", "--set", "analysis.time_column=0")
        holes = self.write("holes.csv", "time,w\n" + "\n".join(rows[:100] + rows[120:]) + "\n")
        result = run("analyze", holes, *said, "--set", "analysis.rate_hz=100", "--json")
        axis = json.loads(result.stdout)["axes"][0]
        self.assertEqual((axis["samples"], axis["known"], axis["gaps"]), (400, 380, 1))
        self.assertIn("20 rows are missing", warnings(result)[0])

    def test_what_is_no_text_is_called_what_it_is(self):
        array = io.BytesIO()
        numpy.save(array, numpy.arange(100.0))
        doubles = b"".join(struct.pack("<7d", 0.01 * k, *(math.sin(k + c) for c in range(6))) for k in range(50))
        for name, data, nature in (("a.npy", array.getvalue(), "NumPy array"),
                                   ("a.mat", b"MATLAB 5.0 MAT-file, Platform".ljust(128, b"\0"), "MATLAB 5 file"),
                                   ("a.imu", doubles, "7 to a row"), ("a.xlsx", b"PK\3\4" + bytes(50), "ZIP"),
                                   ("a.txt", "1,5\n2,5\n".encode("utf-16"), "UTF-16")):
            path = self.write(name, data)
            self.refuse(3, "analyze", path, says=(nature,))
            self.refuse(3, "inspect", path, says=(nature,))
            self.refuse(3, "process", path, "--out", self.folder / "out.csv", says=(nature,))


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

    def test_two_decimal_marks_in_a_log_are_refused(self):
        text = csv_text(self.rows, facts=False).replace(",", ";").replace("20.5", "20,5", 1)
        self.refuse(3, "process", self.write("raw.csv", text), "--out", self.folder / "a.csv", *SAID, says=("decimal",))

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
        self.refuse(2, "process", h5, "--follow", "--out", self.folder / "f.csv", says=both)

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
