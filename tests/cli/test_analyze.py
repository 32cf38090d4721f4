"""zlg analyze: logs and text files in, deviations, terms and drift by mode out."""

import html.parser
import json
import math
import random
import unittest

from support import ROOT, CliTest, complaints, run

TEXT = ["--map", "axis=1", "--map", "holds=rate", "--map", "unit=arcsec/s", "--map", "rate_hz=10"]
IMU = ROOT.parent / "shared" / "data" / "lasergyro.imu"


def white(n, deviation, mean=0.0, seed=1):
    generator = random.Random(seed)
    return [generator.gauss(mean, deviation) for _ in range(n)]


def lines(values):
    return "".join(f"{value!r}\n" for value in values)


class Words(html.parser.HTMLParser):
    """The text of a page, and the numbers in its drawings."""

    def __init__(self):
        super().__init__()
        self.text = []
        self.drawn = []

    def handle_starttag(self, tag, attributes):
        self.drawn += [value for name, value in attributes if name in ("d", "x", "y", "cx", "cy", "points") and value]

    def handle_data(self, data):
        self.text.append(data)


class Analyze(CliTest):
    def json_of(self, *arguments):
        result = run("analyze", *arguments, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def refusal(self, code, *arguments):
        result = run("analyze", *arguments)
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertEqual(len(complaints(result)), 1, result.stderr)
        return result.stderr

    def test_angle_random_walk_is_found_with_its_error(self):
        # 3 arcsec/s a sample at 10 Hz: N = 3/sqrt(10) arcsec/sqrt(s) = 0.0158 deg/sqrt(h)
        path = self.write("rates.txt", lines(white(20000, 3.0, mean=2.0)))
        axis = self.json_of(path, *TEXT)["axes"][0]
        terms = {term["term"]: term for term in axis["fit"]["terms"]}
        walk = terms["angle random walk"]
        self.assertTrue(walk["found"])
        self.assertAlmostEqual(walk["value"], 3.0 / math.sqrt(10.0), delta=4.0 * walk["sigma"])
        self.assertAlmostEqual(walk["shown"]["value"], walk["value"] / 60.0, places=12)
        self.assertEqual(walk["shown"]["unit"], "deg/sqrt(h)")
        absent = terms["rate random walk"]
        self.assertAlmostEqual(absent["shown"]["limit_95"], 60.0 * absent["limit_95"], places=12)
        self.assertAlmostEqual(axis["fit"]["data_sheet"]["angle_random_walk_deg_sqrt_h"], walk["shown"]["value"], places=12)
        self.assertEqual({readout["unit"] for readout in axis["readouts"]}, {"arcsec/s"})
        self.assertEqual([name for name, term in terms.items() if term["found"]], ["angle random walk"])
        self.assertAlmostEqual(axis["mean_rate_arcsec_s"], 2.0, delta=4.0 * axis["mean_rate_sigma_arcsec_s"])
        self.assertAlmostEqual(axis["fit"]["discrete"]["white_rate_arcsec_s"], 3.0, delta=0.1)

    def test_several_columns_and_files(self):
        rows = "".join(f"{a},{b},{c}\n" for a, b, c in zip(white(500, 1.0, 3.0, 1), white(500, 1.0, 4.0, 2), white(500, 1.0, 14.0, 3)))
        path = self.write("unit.csv", "# three axes\n" + rows)
        other = self.write("other.txt", lines(white(500, 1.0)))
        result = self.json_of(path, *TEXT, "--map", "axis=[1, 2, 3]")
        self.assertEqual(len(result["axes"]), 3)
        self.assertAlmostEqual(result["earth"][0]["norm_arcsec_s"], math.sqrt(9 + 16 + 196), delta=0.3)
        self.assertEqual(len(self.json_of(other, path, *TEXT)["axes"]), 2)

    def test_deviations_taus_and_units_are_chosen(self):
        path = self.write("rates.txt", lines(white(1000, 3.0)))
        result = run("analyze", path, *TEXT, "--set", "analysis.deviations=[\"mdev\", \"tdev\"]", "--set",
                     "analysis.taus_s=[0.1, 1, 10]", "--set", "analysis.unit=rad/s")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("mdev, rad/s; intervals of 95 %", result.stdout)
        self.assertIn("tdev, arcsec; intervals of 95 %", result.stdout)
        axis = self.json_of(path, *TEXT, "--set", "analysis.taus_s=[0.1, 1, 10]")["axes"][0]
        self.assertEqual([point["tau_s"] for point in axis["deviations"][0]["points"]], [0.1, 1.0, 10.0])
        said = ["--set", "analysis.deviations=totdev", "--set", "analysis.taus_s=[1]"]
        (curve,) = self.json_of(path, *TEXT, *said)["axes"][0]["deviations"]
        self.assertIn("as_computed", curve["points"][0])

    def test_a_run_gives_its_drifts_back(self):
        out = self.folder / "run"
        made = run("run", "--out", out, "--duration", 600, "--set", "switching.interval_s=20", "--set", "motion.kind=rest",
                   "--set", "drift.magnetic_thermal_arcsec_s=0", "--set", "motion.rate_arcsec_s=0", "--set",
                   "drift.nonmagnetic_arcsec_s=0.5")
        self.assertEqual(made.returncode, 0, made.stderr)
        result = self.json_of(out / "angles.h5")
        self.assertEqual([axis["name"] for axis in result["axes"]], ["angles.h5", "angles.h5, error"])
        for axis in result["axes"]:
            modes = axis["modes"]
            self.assertEqual(len(modes["segments"]), 30)
            self.assertEqual(modes["switch_statistics"]["n"], 29)
            self.assertAlmostEqual(modes["nonmagnetic_arcsec_s"]["value"], 0.5, delta=4 * modes["nonmagnetic_arcsec_s"]["sigma"])
            self.assertAlmostEqual(modes["magnetic_arcsec_s"]["value"], 0.7, delta=4 * modes["magnetic_arcsec_s"]["sigma"])
            self.assertLess(modes["magnetic_arcsec_s"]["sigma"], 0.05)
        raw = self.json_of(out / "raw.h5")["axes"][0]
        self.assertEqual(raw["mean_rate_arcsec_s"], result["axes"][0]["mean_rate_arcsec_s"])
        self.assertEqual(raw["gaps"], 29)

    def test_the_page_is_whole_and_has_no_number_that_is_none(self):
        rates = white(3000, 3.0)
        text = "".join("nan\n" if 1000 <= k < 1200 else f"{rate!r}\n" for k, rate in enumerate(rates))
        page = self.folder / "report.html"
        result = run("analyze", self.write("rates.txt", text), *TEXT, "--out", page)
        self.assertEqual(result.returncode, 0, result.stderr)
        words = Words()
        words.feed(page.read_text())
        for text in words.text + words.drawn:
            self.assertNotRegex(text.lower(), r"\bnan\b|\binf\b")
        for name in ("sigma-1", "course-1", "spectrum-1"):
            self.assertIn(f'id="{name}"', page.read_text())
        again = run("analyze", self.folder / "rates.txt", *TEXT, "--out", page)
        self.assertEqual(again.returncode, 3, again.stderr)
        self.assertEqual(run("analyze", self.folder / "rates.txt", *TEXT, "--out", page, "--force").returncode, 0)

    def test_noise_for_kalibr(self):
        path = self.write("rates.txt", lines(white(5000, 3.0)))
        yaml = self.folder / "imu.yaml"
        result = run("analyze", path, *TEXT, "--imu-yaml", yaml)
        self.assertEqual(result.returncode, 0, result.stderr)
        values = dict(line.split("#")[0].split(": ") for line in yaml.read_text().splitlines() if not line.startswith("#"))
        self.assertAlmostEqual(float(values["gyroscope_noise_density"]) * 648000.0 / math.pi, 3.0 / math.sqrt(10.0), delta=0.05)
        self.assertEqual(float(values["update_rate"]), 10.0)

    def test_both_files_are_written_or_neither(self):
        path, page, yaml = self.write("rates.txt", lines(white(2000, 3.0))), self.folder / "new.html", self.folder / "there.yaml"
        yaml.write_text("mine\n")
        before = sorted(self.folder.iterdir())
        self.assertIn("there.yaml exists", self.refusal(3, path, *TEXT, "--out", page, "--imu-yaml", yaml))
        self.assertEqual(sorted(self.folder.iterdir()), before)
        self.assertEqual(yaml.read_text(), "mine\n")

    def test_no_output_goes_over_another_file_of_the_same_call(self):
        path, page, yaml = self.write("rates.txt", lines(white(2000, 3.0))), self.folder / "a.html", self.folder / "x.yaml"
        for other in (page, self.folder / "." / "a.html"):
            self.assertIn("--imu-yaml", self.refusal(2, path, *TEXT, "--out", page, "--imu-yaml", other, "--force"))
        self.assertEqual(run("analyze", path, *TEXT, "--imu-yaml", yaml).returncode, 0)
        text = yaml.read_text()
        self.assertIn(f"--imu-yaml {path}: is the input", self.refusal(2, path, *TEXT, "--imu-yaml", path, "--force"))
        self.assertEqual(yaml.read_text(), text)

    def test_logs_with_their_truth_are_the_axes_of_one_unit(self):
        logs = []
        for k, rate in enumerate((-12.0, 3.0, 8.5)):
            out = self.folder / f"run{k}"
            made = run("run", "--out", out, "--duration", 60, "--seed", k + 1, "--set", "motion.kind=rest", "--set", f"motion.rate_arcsec_s={rate}")
            self.assertEqual(made.returncode, 0, made.stderr)
            logs.append(out / "angles.h5")
        result = self.json_of(*logs)
        self.assertEqual([axis["is_error"] for axis in result["axes"]], [False, True] * 3)
        self.assertEqual([line["axes"] for line in result["earth"]], [3])
        means = [axis["mean_rate_arcsec_s"] for axis in result["axes"] if not axis["is_error"]]
        self.assertAlmostEqual(result["earth"][0]["norm_arcsec_s"], math.hypot(*means), places=9)
        self.assertEqual(self.json_of(*logs[:2])["earth"], [])

    def test_a_rate_table(self):
        generator = random.Random(5)
        rows = []
        for rate in (-10.0, -5.0, -1.0, 0.0, 1.0, 5.0, 10.0):
            for _ in range(100):
                rows.append(f"{rate!r} {(rate * 3600.0 * (1 + 50e-6) + 7.0 + generator.gauss(0.0, 1.0)) / 10.0!r}\n")
        path = self.write("table.txt", "".join(rows))
        said = ["--map", "axis=2", "--map", "holds=increment", "--map", "unit=arcsec", "--map", "rate_hz=10",
                "--map", "table_rate=1", "--map", "table_unit=deg/s"]
        result = self.json_of(path, *said)
        table = result["rate_tables"][0]
        self.assertEqual(len(table["stages"]), 7)
        self.assertAlmostEqual(table["scale_factor_units_arcsec"]["value"], 1 + 50e-6, delta=4 * table["scale_factor_units_arcsec"]["sigma"])
        self.assertLess(table["scale_factor_units_arcsec"]["sigma"], 1e-5)
        self.assertAlmostEqual(table["bias_arcsec_s"]["value"], 7.0, delta=4 * table["bias_arcsec_s"]["sigma"])
        with_earth = self.json_of(path, *said, "--set", "analysis.table_earth_arcsec_s=7")["rate_tables"][0]
        self.assertAlmostEqual(with_earth["bias_arcsec_s"]["value"], table["bias_arcsec_s"]["value"] - 7.0, places=6)
        self.assertIn("0 stages", self.refusal(3, path, *said, "--set", "analysis.table_settling_s=1e18"))

    def test_what_tells_nothing_is_refused_in_one_line(self):
        for name, values in (("one", [1.0]), ("constant", [5.0] * 100), ("zero", [0.0] * 100), ("unknown", [math.nan] * 100)):
            message = self.refusal(3, self.write(f"{name}.txt", lines(values)), *TEXT, "--out", self.folder / "page.html")
            self.assertIn(f"{name}.txt", message)
            self.assertFalse((self.folder / "page.html").exists())
        self.assertIn("no rows", self.refusal(3, self.write("empty.txt", ""), *TEXT))
        self.assertIn("'x'", self.refusal(3, self.write("word.txt", "1\nx\n"), *TEXT))

    def test_wrong_usage(self):
        path = self.write("rates.txt", lines(white(100, 1.0)))
        for asked in ("--map unit=", "--map holds=", "--map rate_hz=", "zlg import"):
            self.assertIn(asked, self.refusal(2, path))
        self.assertIn("rate_hz = '0'", self.refusal(2, path, *TEXT, "--map", "rate_hz=0"))
        for key in ("column", "column_holds", "scale_arcsec", "rate_hz", "comment", "skip_lines", "separator", "decimal", "time_column",
                    "table_column", "table_scale_arcsec_s"):
            self.assertIn("--map", self.refusal(2, path, *TEXT, "--set", f"analysis.{key}=1"))
        self.assertIn(".html", self.refusal(2, path, *TEXT, "--out", "page.pdf"))
        self.assertIn("analysis.deviations", self.refusal(2, path, *TEXT, "--set", "analysis.deviations=alan"))
        self.assertIn("analysis.deviations", self.refusal(2, path, *TEXT, "--set", "analysis.deviations=[]"))
        self.assertIn("analysis.confidence", self.refusal(2, path, *TEXT, "--set", "analysis.confidence=0.9999999999999999"))

    @unittest.skipUnless(IMU.exists(), "no recording of a real laser gyro beside the project")
    def test_a_real_unit_sees_the_earth_turn(self):
        said = ["--map", "holds=increment", "--map", "unit=arcsec", "--map", "scale=0.1", "--map", "rate_hz=100", "--map", "comment=%",
                "--map", "skip_lines=3"]
        result = self.json_of(IMU, *said, "--map", "axis=[1, 2, 3]")
        self.assertEqual([axis["samples"] for axis in result["axes"]], [184718] * 3)
        self.assertAlmostEqual(result["earth"][0]["norm_arcsec_s"], 14.86, delta=0.02)
