"""Files of other programs: each becomes angles or a curve by one `zlg import`, or is refused with what must be said."""

import datetime
import io
import json
import struct
import zlib

import h5py
import numpy

from support import AngleLog, CliTest, SAID, csv_text, quiet_log, run, warnings

SCALE = ["--map", "scale_arcsec=3.263"]
FIXED = ["--map", "mode=always:1", "--map", "loop_closed=always:1"]


def matlab5(variables):
    """A MATLAB 5 file of matrices of doubles, by hand from MathWorks' description of the format."""
    def element(kind, data):
        return struct.pack("<II", kind, len(data)) + data + bytes(-len(data) % 8)
    out = b"MATLAB 5.0 MAT-file, made by a test".ljust(116, b" ") + bytes(8) + struct.pack("<HH", 0x0100, 0x4D49)
    for name, matrix in variables.items():
        matrix = numpy.atleast_2d(numpy.asarray(matrix, float))
        body = element(6, struct.pack("<II", 6, 0)) + element(5, struct.pack("<ii", *matrix.shape))
        body += element(1, name.encode()) + element(9, matrix.tobytes(order="F"))
        out += element(14, body)
    return out


class Foreign(CliTest):
    def setUp(self):
        super().setUp()
        self.rng = numpy.random.default_rng(20)

    def rates(self, n=600, mean=15.04, sigma=3.0):
        """deg/h"""
        return mean + sigma * self.rng.standard_normal(n)

    def angles(self, path, *said, rows=None):
        out = self.folder / "angles.csv"
        self.succeed("import", path, "--out", out, "--force", *said)
        log = AngleLog(out)
        if rows is not None:
            self.assertEqual(len(log.rows), rows)
        return log

    def assert_turns(self, log, expected, rel=1e-12):
        numpy.testing.assert_allclose(log.dtheta, expected, rtol=rel, atol=1e-12)
        self.assertEqual(log.final, log.dtheta)
        self.assertTrue(all(sigma == float("inf") for sigma in log.sigma))

    def mean(self, path, *said):
        axis = json.loads(self.succeed("analyze", path, *said, "--json").stdout)["axes"][0]
        return axis["mean_rate_arcsec_s"], axis


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
    """MATLAB 5 files that do not hold what they say; libmatio would give memory that nobody wrote."""

    def test_matlab_5_that_is_cut_or_claims_more_than_it_holds(self):
        said = ["--map", "rate_hz=100", "--map", "axis=w", "--map", "unit=deg/h"]
        whole = matlab5({"w": self.rates(200)})
        out = self.folder / "o.csv"
        body = whole[128:]
        packed = zlib.compress(body)
        as_packed = whole[:128] + struct.pack("<II", 15, len(packed)) + packed
        self.angles(self.write("packed.mat", as_packed), *said, rows=200)
        half = zlib.compress(body[:800])
        claims = whole.replace(struct.pack("<ii", 1, 200), struct.pack("<ii", 1, 20000))
        self.assertNotEqual(claims, whole)
        for name, data in (("cut.mat", whole[:900]), ("cut_at_the_tag.mat", whole + b"\x0e\0\0"), ("claims.mat", claims),
                           ("packed_cut.mat", as_packed[:-40]), ("half.mat", whole[:128] + struct.pack("<II", 15, len(half)) + half),
                           ("huge.mat", whole.replace(struct.pack("<ii", 1, 200), struct.pack("<ii", 200, 0x7FFFFFFF)))):
            with self.subTest(name):
                self.refuse(3, "import", self.write(name, data), "--out", out, *said, says=(name, "byte 128" if "tag" not in name else "byte"))


class SilentlyWrong(Foreign):
    """Files that would give wrong numbers without a word."""

    def refused(self, name, data, *said, code=3, says=()):
        self.refuse(code, "import", self.write(name, data), "--out", self.folder / "o.csv", *said, says=(name, *says))

    def test_attributes_of_hdf5_that_scale(self):
        path = self.folder / "scaled.h5"
        said = ["--map", "rate_hz=100", "--map", "axis=w", "--map", "unit=deg/h"]
        for name, harmless, harmful in (("scale_factor", 1, 0.01), ("Gain", 1.0, 2), ("LSB", 1, 1e-3), ("add_offset", 0.0, 5), ("_FillValue", 1e20, 3.0)):
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
            self.refused("lost.csv", text(numpy.floor(numpy.delete(whole, 211)), ".0f"), "--map", "axis=w_dph", says=("rounded", "rate_hz"))


class OfALaboratory(Foreign):
    """Logs as they come from a bench, of which a number would be wrong without a word."""

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
        wrapped = [(2**32 - 2_000_000 + 10_000 * k) % 2**32 for k in range(400)]
        said = [*self.DPH, "--map", "rate_hz=100"]
        for name, times in (("t_us", wrapped), ("t_s", self.t[::-1])):
            path = self.table("back.csv", f"{name},w_dph", times, self.w)
            self.refused(path, *said, code=2, says=(name, "time=none"))
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

    def test_counts_per_millisecond_become_halves_where_that_is_exact(self):
        lines = []
        for row in self.rows:
            parts = self.rng.multinomial(abs(row["counts"]), [0.2] * 5) * numpy.sign(row["counts"])
            lines += [f"{len(lines) + p};{n};{row['bias_sign']};{row['mode']};{row['loop_closed']}" for p, n in enumerate(parts)]
        head = "t_ms;counts;bias_sign;mode;loop_closed\n"
        expected = self.process_text(csv_text(self.rows, facts=False), "--set", "gyro.tick_s=0.01", "--set", "gyro.scale_arcsec=3.263")
        path = self.write("ms.csv", head + "\n".join(lines) + "\n")
        self.assertEqual(self.imported(path, *SCALE), expected)
        self.assertEqual(self.imported(path, *SCALE, "--map", "tick_s=0.01"), expected)
        self.refuse((2, 3), "import", path, "--out", self.folder / "o.h5", *SCALE, "--map", "tick_s=0.005", says=("0.005", "0.01"))
        # A file that begins within a half loses that piece and says so.
        later = self.write("later.csv", head + "\n".join(lines[8:]) + "\n")
        result = run("import", later, "--out", self.folder / "later.h5", *SCALE)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("the first 2 rows", result.stderr)

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
