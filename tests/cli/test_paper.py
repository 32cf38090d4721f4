"""`zlg paper`: what it writes, that it overwrites nothing unasked, and when it says no."""

import csv
import json
import unittest
import xml.etree.ElementTree as xml

from support import CliTest, body_of, folder_until, run

SHORT = ["--duration", 60, "--set", "switching.interval_s=5"]
ITEMS = ["figure 1", "figure 2", "figure 3", "figure 4", "figure 5", "table 1", "table 2", "figure 6", "figure 7", "figure 8a",
         "figure 8b", "figure 9a", "figure 9b", "figure 9c", "figure 10a", "figure 10b", "figure 10c", "figure 11"]
VERDICTS = {"agrees", "misprint", "wrong", "not supported"}

SHARED = {}


def setUpModule():
    """One recomputation serves every test here."""
    CliTest.setUpClass()
    SHARED["out"] = folder_until(unittest.addModuleCleanup) / "paper"
    SHARED["result"] = run("paper", *SHORT, "--out", SHARED["out"], "--json")
    if SHARED["result"].returncode != 0:
        raise AssertionError(f"zlg paper fails: exit {SHARED['result'].returncode}, {SHARED['result'].stderr}")


class Outputs(CliTest):
    def setUp(self):
        super().setUp()
        self.out = SHARED["out"]
        self.json = json.loads(SHARED["result"].stdout)

    def test_json_has_the_items_the_agreement_and_the_claims(self):
        self.assertEqual([item["number"] for item in self.json["items"]], ITEMS)
        self.assertGreaterEqual(self.json["chi2_per_dof"], 0.7)
        self.assertLessEqual(self.json["chi2_per_dof"], 1.4)
        self.assertGreater(self.json["degrees_of_freedom"], 100)
        self.assertEqual({claim["verdict"] for claim in self.json["claims"]}, VERDICTS)
        self.assertEqual(SHARED["result"].stderr, "")

    def test_every_figure_is_a_picture_and_a_table(self):
        figures = [figure for item in self.json["items"] for figure in item["figures"]]
        self.assertGreater(len(figures), len(ITEMS))
        for figure in figures:
            with self.subTest(figure=figure):
                root = xml.parse(self.out / f"{figure}.svg").getroot()
                self.assertEqual(root.tag, "{http://www.w3.org/2000/svg}svg")
                table = self.out / f"{figure}.csv"
                if not table.exists():
                    self.assertIn(figure, ("figure-1", "figure-2"), "only a diagram has no data")
                    continue
                rows = list(csv.DictReader(body_of(table).decode().splitlines()))
                self.assertEqual(list(rows[0]), ["series", "x", "y", "y_error"])
                for row in rows:
                    float(row["x"]), float(row["y"]), float(row["y_error"] or 0)

    def test_claims_are_those_of_the_json(self):
        rows = list(csv.DictReader((self.out / "claims.csv").read_text().splitlines()))
        self.assertEqual(rows, self.json["claims"])

    def test_page_holds_every_figure_and_fetches_nothing(self):
        page = (self.out / "paper.html").read_text()
        for item in self.json["items"]:
            for figure in item["figures"]:
                self.assertIn(f'id="{figure}"', page)
        self.assertNotRegex(page, r"(?i)(src|href)\s*=\s*[\"']?\s*(https?:)?//")

    def test_nothing_else_is_there(self):
        figures = {figure for item in self.json["items"] for figure in item["figures"]}
        for path in self.out.iterdir():
            self.assertTrue(path.name in ("paper.html", "claims.csv") or path.stem in figures, path.name)

    def test_does_not_overwrite_without_force(self):
        before = {path: path.stat().st_mtime_ns for path in self.out.iterdir()}
        self.refuse(3, "paper", *SHORT, "--out", self.out, says=["exists", "--force"])
        self.assertEqual({path: path.stat().st_mtime_ns for path in self.out.iterdir()}, before)


class Refusals(CliTest):
    def test_out_is_missing(self):
        self.refuse(2, "paper", says=["--out"])

    def test_parent_folder_is_missing(self):
        self.refuse(3, "paper", "--out", self.folder / "none" / "paper", says=["none"])

    def test_out_is_a_file(self):
        self.refuse(3, "paper", "--out", self.write("taken", "x"), says=["taken"])

    def test_wrong_configuration_leaves_nothing(self):
        out = self.folder / "paper"
        self.refuse(2, "paper", "--out", out, "--set", "piezo.half_wave_v=200", says=["half_wave_v", "200"])
        self.assertFalse(out.exists())


class SaysNo(CliTest):
    def test_where_the_twin_does_not_follow_theory(self):
        # Theory takes the magnetic drift of an experiment for constant.
        out = self.folder / "paper"
        warming = ["--set", "drift.thermal_time_s=5", "--set", "drift.magnetic_thermal_arcsec_s=50000"]
        result = self.refuse(1, "paper", *SHORT, *warming, "--out", out, says=["theory"])
        self.assertIn("written to", result.stdout)
        self.assertIn("chi-square", result.stdout)
        self.assertTrue((out / "paper.html").exists())
