"""Files of other programs: each becomes angles or a curve by one `zlg import`, or is refused with what must be said."""

import datetime
import io
import json
import struct
import zlib

import h5py
import numpy

from foreign import FIXED, Foreign, SCALE, matlab5
from support import SAID, csv_text, quiet_log, run, warnings


class Angles(Foreign):
    def test_names_and_units_of_german_excel_in_latin_1(self):
        file = self.folder / "excel.csv"
        rates = numpy.array([self.rates(300, mean) for mean in (10.0, -7.0, 13.0)])
        rows = [f"{5 * k};" + ";".join(f"{r:.4f}".replace(".", ",") for r in rates[:, k]) for k in range(300)]
        for unit in ("[°/h]", "(°/h)"):
            file.write_bytes("\r\n".join([f"Zeit_ms;wx {unit};wy {unit};wz {unit}", *rows, ""]).encode("latin-1"))
            asked = run("import", file, "--out", self.folder / "angles.csv")
            self.assertEqual(asked.returncode, 2)
            self.assertIn("axis=COLUMN, of 'wx", asked.stderr)
            self.assertNotIn("unit=", asked.stderr)
            mean, axis = self.mean(file, "--map", "axis=wy")
            self.assertAlmostEqual(mean, numpy.round(rates[1], 4).mean(), places=9)
            self.assertAlmostEqual(axis["rate_hz"], 200.0, places=9)

    def test_german_csv_of_excel(self):
        rates = self.rates() / 3600  # deg/s
        lines = [f"{k/100:.4f};{r:.9f};{24.5 + k % 7/10:.1f}".replace(".", ",") for k, r in enumerate(rates)]
        text = "Messung;Kreisel 4;\r\nZeit [s];gyro_z [°/s];Temp\r\n" + "\r\n".join(lines) + "\r\n"
        path = self.write("lab.csv", b"\xef\xbb\xbf" + text.encode())
        self.assert_turns(self.angles(path, rows=600), numpy.round(rates, 9) * 36.0)
        looked = self.succeed("import", path).stdout
        for word in ("semicolons", "decimal comma", "the times of the rows", "a rate, deg/s", "nothing is missing"):
            self.assertIn(word, looked)

    def test_names_and_units_in_two_lines_of_a_table_of_blanks(self):
        rates = self.rates()
        body = "\n".join(f"  {k/200:10.4f}  {r:12.6f}" for k, r in enumerate(rates))
        path = self.write("w.txt", "time  omega\n  s  deg/h\n" + body + "\n")
        self.assert_turns(self.angles(path, rows=600), numpy.round(rates, 6) * 0.005)

    def test_pandas_with_index_and_iso_dates(self):
        rates = self.rates()
        start = datetime.datetime(2026, 3, 29, 0, 59, 58)
        stamps = [(start + datetime.timedelta(milliseconds=10 * k)).isoformat(sep=" ", timespec="microseconds") for k in range(600)]
        rows = "\n".join(f"{k},{stamp},{r!r},0.5" for k, (stamp, r) in enumerate(zip(stamps, map(float, rates))))
        path = self.write("frame.csv", ",timestamp,wz_dph,t_board\n" + rows + "\n")
        self.assert_turns(self.angles(path, rows=600), rates * 0.01, rel=1e-9)

    def test_a_logger_with_gaps_and_jitter(self):
        rates = self.rates()
        times = 7.5 * numpy.arange(600) + self.rng.uniform(-1, 1, 600)  # ms
        keep = [k for k in range(600) if k not in range(100, 117) and k != 300]
        path = self.write("gaps.csv", "t_ms,rate_arcsec_s\n" + "\n".join(f"{times[k]:.0f},{rates[k]:.9g}" for k in keep) + "\n")
        log = self.angles(path, rows=600)
        missing = [k for k in range(600) if k not in keep]
        self.assertEqual([k for k in range(600) if log.has(k, "invalid")], missing)
        mean, axis = self.mean(path, "--map", "time=t_ms")
        self.assertEqual((axis["samples"], axis["known"], axis["gaps"]), (600, 582, 2))
        self.assertAlmostEqual(mean, rates[keep].mean(), delta=1e-6)
        back, again = self.mean(self.folder / "angles.csv")
        self.assertEqual((again["samples"], again["known"]), (600, 582))
        self.assertAlmostEqual(back, mean, delta=1e-6)

    def test_late_stamps_are_no_hole(self):
        times = 0.01 * numpy.arange(200)
        times[100:140] = 1.39 + 1e-5 * numpy.arange(40)  # a buffer that was written late
        path = self.write("late.csv", "time_s,w_dph\n" + "\n".join(f"{t:.6f},{r:.6f}" for t, r in zip(times, self.rates(200))) + "\n")
        self.refuse(3, "import", path, "--out", self.folder / "o.csv", says=("row 100", "time=none", "rate_hz"))
        self.angles(path, "--map", "time=none", "--map", "rate_hz=100", rows=200)

    def test_a_row_twice_is_refused(self):
        rows = [f"{0.01*k:.2f},{r:.6f}" for k, r in enumerate(self.rates(50))]
        path = self.write("twice.csv", "time_s,w_dph\n" + "\n".join(rows[:20] + rows[19:]) + "\n")
        self.refuse(3, "import", path, "--out", self.folder / "o.csv", says=("row 21", "0.19"))

    def test_three_axes_of_an_imu(self):
        rates = self.rng.standard_normal((500, 3)) * 1e-4 + [1e-4, 2e-4, 3e-4]
        rows = "\n".join(f"{k/100:.2f},{a!r},{b!r},{c!r},9.81" for k, (a, b, c) in enumerate(rates.tolist()))
        path = self.write("imu.csv", "time_s,wx [rad/s],wy [rad/s],wz [rad/s],az\n" + rows + "\n")
        self.refuse(2, "import", path, "--out", self.folder / "o.csv", says=("--map axis=COLUMN", "'wy [rad/s]'"))
        in_arcsec = rates * 180 / numpy.pi * 3600
        self.assert_turns(self.angles(path, "--map", "axis=wy"), in_arcsec[:, 1] / 100)
        self.assert_turns(self.angles(path, "--map", "axis=4"), in_arcsec[:, 2] / 100)
        axes = json.loads(self.succeed("analyze", path, "--map", 'axis=["wx", "wy", "wz"]', "--json").stdout)["axes"]
        for axis, expected in zip(axes, in_arcsec.mean(axis=0)):
            self.assertAlmostEqual(axis["mean_rate_arcsec_s"], expected, delta=6 * axis["mean_rate_sigma_arcsec_s"])
        self.refuse(2, "import", path, "--out", self.folder / "o.csv", "--map", 'axis=["wx", "wy"]', says=("axes",))

    def test_matlab_5_and_7_3_and_numpy_say_the_same(self):
        rates = self.rates()
        time = numpy.arange(600) / 100
        said = ["--map", "time=t", "--map", "time_unit=s", "--map", "axis=w", "--map", "unit=deg/h"]
        old = self.write("lab5.mat", matlab5({"t": time, "w": rates, "note": [[1.0]]}))
        self.assert_turns(self.angles(old, *said, rows=600), rates / 100)
        new = self.folder / "lab73.mat"
        with h5py.File(new, "w", userblock_size=512) as file:
            file["t"], file["w"], file["fs"] = time[None, :], rates[None, :], [[100.0]]
        with open(new, "r+b") as file:
            file.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64")
        self.assert_turns(self.angles(new, *said, rows=600), rates / 100)
        array = io.BytesIO()
        numpy.save(array, numpy.column_stack([time, rates]))
        path = self.write("a.npy", array.getvalue())
        self.assert_turns(self.angles(path, "--map", "time_unit=s", "--map", "axis=2", "--map", "unit=deg/h"), rates / 100)

    def test_imu_of_psins(self):
        n = 400
        turns = self.rng.standard_normal((n, 3)) * 1e-7 + 1e-6  # rad
        rows = numpy.column_stack([turns, self.rng.standard_normal((n, 3)), 0.01 * numpy.arange(1, n + 1)])
        path = self.write("unit.imu", rows.astype("<f8").tobytes())
        self.assertIn("PSINS", self.succeed("import", path).stdout)
        log = self.angles(path, "--map", "axis=3", "--map", "holds=increment", "--map", "unit=rad", "--map", "time_unit=s")
        self.assert_turns(log, turns[:, 2] * 180 / numpy.pi * 3600)

    def test_counts_per_tick_are_increments(self):
        counts = self.rng.integers(-3, 9, 300)
        path = self.write("ticks.csv", "t_s,n\n" + "\n".join(f"{k*0.005:.3f},{n}" for k, n in enumerate(counts)) + "\n")
        log = self.angles(path, "--map", "axis=n", "--map", "holds=increment", "--map", "unit=counts", *SCALE)
        self.assert_turns(log, counts * 3.263)
        self.refuse(3, "import", path, "--out", self.folder / "raw.csv", "--map", "counts=n", "--map", "bias_sign=alternating:1", *FIXED, *SCALE,
                    "--map", "tick_s=0.005", says=("halves",))

    def test_an_angle_over_a_hole_keeps_its_turn(self):
        angle = numpy.cumsum(self.rates(100)) / 100
        keep = [k for k in range(100) if k not in (40, 41)]
        path = self.write("a.csv", "time_s,angle_arcsec\n" + "\n".join(f"{k/100:.2f},{angle[k]!r}" for k in keep).replace("np.float64(", "").replace(")", "") + "\n")
        log = self.angles(path, "--map", "axis=angle_arcsec", "--map", "holds=angle", rows=99)
        self.assertAlmostEqual(sum(log.dtheta), angle[-1] - angle[0], delta=1e-9)
        self.assertEqual([k for k in range(99) if log.has(k, "interpolated")], [39, 40, 41])

    def test_what_is_open_is_asked_for(self):
        rates = [f"{k/100:.2f},{r:.6f}" for k, r in enumerate(self.rates(100))]
        out = self.folder / "o.csv"
        path = self.write("open.csv", "time,w\n" + "\n".join(rates) + "\n")
        self.refuse(2, "import", path, "--out", out, says=("--map unit=", "--map holds=", "--map time_unit=s (then 100 Hz), ms (100000 Hz)"))
        said = ["--map", "unit=deg/h", "--map", "holds=rate"]
        self.refuse(2, "import", path, "--out", out, *said, says=("time_unit",))
        self.refuse(2, "import", path, "--out", out, *said, "--map", "rate_hz=200", says=("100 Hz", "0.005"))
        self.refuse(2, "import", path, "--out", out, *said, "--map", "unit=furlong", says=("furlong", "deg/s"))
        self.refuse(2, "import", path, "--out", out, "--map", "unti=deg/h", says=("unti", "did you mean 'unit'"))
        self.refuse(2, "import", path, "--out", out, *said, "--map", "axis=time", says=("time",))
        self.refuse(2, "import", path, "--out", out, "--map", "holds=increment", "--map", "unit=deg/s", "--map", "rate_hz=100",
                    says=("holds = increment", "deg/s"))
        self.assertFalse(out.exists())

    def test_a_mapping_that_was_written_says_it_again(self):
        rates = self.rates()
        path = self.write("m.csv", "time,w\n" + "\n".join(f"{k*10},{r!r}" for k, r in enumerate(map(float, rates))) + "\n")
        said = ["--map", "unit=deg/h", "--map", "holds=rate", "--map", "time_unit=ms"]
        toml = self.folder / "m.toml"
        self.succeed("import", path, *said, "--write-mapping", toml)
        self.assert_turns(self.angles(path, "--mapping", toml), rates / 100)
        mean, _ = self.mean(path, "--mapping", toml)
        self.assertAlmostEqual(mean, rates.mean(), delta=1e-9)
        self.refuse(2, "analyze", path, "--mapping", self.write("bad.toml", "unti = 1\n"), says=("unti",))
        self.refuse(2, "analyze", path, "--mapping", self.write("bad.toml", "unit = [\n"), says=("bad.toml:",))
        self.refuse(3, "analyze", path, "--mapping", self.folder / "none.toml", says=("none.toml",))

    def test_what_cannot_be_read_is_refused_in_one_line(self):
        out = self.folder / "o.csv"
        for name, data, codes in (("nul.csv", b"t_s,w_dph\n0.0,1.5\n\0\0\0\n0.2,1.5\n", 3),
                                  ("empty.csv", b"", 3), ("blank.csv", b"\n\n", 3), ("words.csv", b"to be or not to be\n", 3),
                                  ("long.csv", b"1" * (3 << 20), 3),
                                  ("thousands.csv", ("t;w\n" + "\n".join(f"{k};1.{234 + k}" if k % 2 else f"{k};{k}" for k in range(1, 40)) + "\n").encode(), (2, 3)),
                                  ("two_columns_or_one.csv", "".join(f"{k},{k + 100}\n" for k in range(1, 50)).encode(), (2, 3)),
                                  ("a.xlsx", b"PK\3\4" + bytes(50), 3), ("cut.npy", b"\x93NUMPY\1\0\x76\0{'descr'", 3),
                                  ("cut.mat", b"MATLAB 5.0 MAT-file, Platform".ljust(124) + b"\0\1IM" + b"\x0e\0\0\0\xff\xff\xff\x7f", 3)):
            with self.subTest(name):
                self.refuse(codes, "import", self.write(name, data), "--out", out, "--map", "axis=2", "--map", "unit=deg/h", "--map", "rate_hz=10",
                            says=(name,))
                self.assertFalse(out.exists())


class Cut(Foreign):
    """MATLAB 5 files that do not hold what they say."""

    def test_matlab_5_that_is_cut_or_claims_more_than_it_holds(self):
        said = ["--map", "rate_hz=100", "--map", "axis=w", "--map", "unit=deg/h"]
        whole = matlab5({"w": self.rates(200)})
        out = self.folder / "o.csv"
        body = whole[128:]
        packed = zlib.compress(body)
        as_packed = whole[:128] + struct.pack("<II", 15, len(packed)) + packed
        self.angles(self.write("packed.mat", as_packed), *said, rows=200)
        steps = numpy.floor(numpy.arange(300_000) / 1000)
        long = zlib.compress(matlab5({"w": steps})[128:], 9)  # packed to a part of a block, unpacked to many
        self.assert_turns(self.angles(self.write("long.mat", whole[:128] + struct.pack("<II", 15, len(long)) + long), *said, "--map", "holds=angle",
                                      "--map", "unit=arcsec"), numpy.diff(steps))
        half = zlib.compress(body[:800])
        claims = whole.replace(struct.pack("<ii", 1, 200), struct.pack("<ii", 1, 20000))
        self.assertNotEqual(claims, whole)
        for name, data in (("cut.mat", whole[:900]), ("cut_at_the_tag.mat", whole + b"\x0e\0\0"), ("claims.mat", claims),
                           ("packed_cut.mat", as_packed[:-40]), ("half.mat", whole[:128] + struct.pack("<II", 15, len(half)) + half),
                           ("huge.mat", whole.replace(struct.pack("<ii", 1, 200), struct.pack("<ii", 200, 0x7FFFFFFF)))):
            with self.subTest(name):
                self.refuse(3, "import", self.write(name, data), "--out", out, *said, says=(name, "byte 128" if "tag" not in name else "byte"))


class Raw(Foreign):
    """Counts of halves."""

    def setUp(self):
        super().setUp()
        self.rows = [dict(row, counts=row["counts"] + self.random.randint(-2, 2)) for row in quiet_log(60, gap=range(20, 23))]
        self.expected = self.process_text(csv_text(self.rows, facts=False), *SAID)

    def process_text(self, text, *said, name="raw.csv"):
        return self.process_path(self.write(name, text), *said)

    def process_path(self, path, *said):
        out = self.folder / "angles.csv"
        self.succeed("process", path, "--out", out, "--force", *said)
        return [line for line in out.read_text().splitlines() if not line.startswith("#")]

    def imported(self, path, *said):
        raw = self.folder / "imported.h5"
        self.succeed("import", path, "--out", raw, "--force", *said)
        return self.process_path(raw)

    def test_other_names_and_signs(self):
        text = "N;richtung;offen;pol\n" + "".join(f"{r['counts']};{(r['bias_sign']+1)//2};{1-r['loop_closed']};A\n" for r in self.rows)
        path = self.write("own.csv", text)
        said = ["--map", "counts=N", "--map", "bias_sign=richtung", "--map", "loop_open=offen", "--map", "mode=always:1", *SCALE,
                "--map", "tick_s=0.005"]
        self.refuse(2, "import", path, "--out", self.folder / "o.h5", *said, says=("bias_sign_plus",))
        said += ["--map", "bias_sign_plus=1"]
        self.assertEqual(self.imported(path, *said), self.expected)
        toml = self.folder / "m.toml"
        self.succeed("import", path, *said, "--write-mapping", toml)
        self.assertEqual(self.process_path(path, "--mapping", toml), self.expected)
        self.refuse(2, "import", path, "--out", self.folder / "o.h5", "--map", "counts=N",
                    says=("bias_sign=", "mode=", "loop_closed=", "scale_arcsec=", "tick_s="))

    def test_hdf5_of_doubles_in_the_root(self):
        path = self.folder / "doubles.h5"
        with h5py.File(path, "w") as file:
            for name in ("half", "bias_sign", "mode", "counts", "loop_closed"):
                file[name] = numpy.array([row[name] for row in self.rows], float)
        self.assertEqual(self.imported(path, *SCALE, "--map", "tick_s=0.005"), self.expected)
        with h5py.File(path, "r+") as file:
            file["counts"][7] = 3.5
        self.refuse(3, "import", path, "--out", self.folder / "o.h5", *SCALE, "--map", "tick_s=0.005", says=("row 8", "3.5"))

    def test_missing_rows_become_halves_that_are_not_valid(self):
        lost = set(range(70, 77)) | {90}
        expected = [dict(row, valid=0, counts=0) if row["half"] in lost else dict(row, valid=1) for row in self.rows]
        expected = self.process_text(csv_text(expected, facts=False), *SAID)
        kept = [row for row in self.rows if row["half"] not in lost]
        by_time = "zeit_us;counts;bias_sign;mode;loop_closed\n" + "".join(
            f"{1000 + 2500 * r['half'] + self.random.randint(-200, 200)};{r['counts']};{r['bias_sign']};{r['mode']};{r['loop_closed']}\n" for r in kept)
        self.assertEqual(self.imported(self.write("t.csv", by_time), *SCALE, "--map", "tick_s=0.005"), expected)
        by_number = csv_text(kept, facts=False)
        self.assertEqual(self.imported(self.write("n.csv", by_number), "--map", "half=half", *SCALE, "--map", "tick_s=0.005"), expected)
        broken = by_time.splitlines()
        cells = broken[100].split(";")
        broken[100] = ";".join([cells[0], "0.5", *cells[2:]])
        self.refuse(3, "import", self.write("h.csv", "\n".join(broken) + "\n"), "--out", self.folder / "o.h5", *SCALE, says=("row 100", "counts = 0.5"))
        blind = "".join(f"{r['counts']};{r['bias_sign']}\n" for r in kept)
        self.refuse(3, "import", self.write("b.csv", "counts;bias_sign\n" + blind), "--out", self.folder / "o.h5", *FIXED, *SCALE, "--map",
                    "tick_s=0.005", says=("row 71", "bias_sign"))

    def test_counts_per_millisecond_are_refused_as_no_rows_of_a_half(self):
        lines = []
        for row in self.rows:
            parts = self.rng.multinomial(abs(row["counts"]), [0.2] * 5) * numpy.sign(row["counts"])
            lines += [f"{len(lines) + p};{n};{row['bias_sign']};{row['mode']};{row['loop_closed']}" for p, n in enumerate(parts)]
        path = self.write("ms.csv", "t_ms;counts;bias_sign;mode;loop_closed\n" + "\n".join(lines) + "\n")
        self.refuse((2, 3), "import", path, "--out", self.folder / "o.h5", *SCALE, says=("row 2", "bias_sign", "a row a half"))

    def test_calibrate_takes_a_mapping(self):
        raw = self.folder / "simulated.csv"
        self.succeed("simulate", "--out", raw, "--duration", "60", "--set", "switching.interval_s=5", "--set", "motion.kind=rest")
        body = [line for line in raw.read_text().splitlines() if not line.startswith("#")]
        path = self.write("own.csv", "\n".join([body[0].replace("counts", "fringes"), *body[1:]]) + "\n")
        said = ["--map", "counts=fringes", *SCALE, "--map", "tick_s=0.005"]
        plain = self.write("plain.csv", "\n".join(body) + "\n")
        of_log = json.loads(run("calibrate", plain, *SAID, "--json").stdout)
        of_map = json.loads(run("calibrate", path, *said, "--json").stdout)
        of_log.pop("files"), of_map.pop("files")
        self.assertEqual(of_map, of_log)

    def test_a_log_needs_no_import(self):
        self.refuse(2, "import", self.write("raw.csv", csv_text(self.rows)), says=("needs no import",))
        self.assertEqual(warnings(run("import", "--keys")), [])
