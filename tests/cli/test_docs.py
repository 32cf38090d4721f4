"""The documentation says what the program says."""

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from support import ROOT, ZLG, folder_until


class Reference(unittest.TestCase):
    def test_configuration_is_documented_as_the_program_lists_it(self):
        listed = subprocess.run([ZLG, "--keys"], capture_output=True, text=True, check=True).stdout
        written = (ROOT / "docs" / "configuration.md").read_text()
        self.assertTrue(written.endswith(listed), "renew the tables of docs/configuration.md with: zlg --keys")


class Readme(unittest.TestCase):
    def test_its_example_log_gives_the_angles_that_it_says(self):
        lines = (ROOT / "README.md").read_text().splitlines()
        start = lines.index("    # gyro.tick_s = 0.005")
        log = [line[4:] for line in lines[start:lines.index("", start)]]
        with tempfile.TemporaryDirectory() as folder:
            raw, angles = Path(folder) / "raw.csv", Path(folder) / "angles.csv"
            raw.write_text("\n".join(log) + "\n")
            subprocess.run([ZLG, "process", raw, "--out", angles], capture_output=True, check=True)
            rows = [row for row in angles.read_text().splitlines() if not row.startswith("#")]
        column = rows[0].split(",").index("dtheta_arcsec")
        self.assertEqual([row.split(",")[column] for row in rows[1:]], ["6.526", "0", "3.263"])


NUMBER = re.compile(r"\d+(?:\.\d+)?")


class Result(unittest.TestCase):
    """The table and the picture of the README are what the program gives."""

    @classmethod
    def setUpClass(cls):
        cls.made = folder_until(cls.addClassCleanup)
        subprocess.run([ROOT / "tools" / "readme_result", cls.made], check=True, timeout=600, env={**os.environ, "ZLG": str(ZLG)})

    def assert_same(self, committed, made, allowed):
        """The same text; numbers differ by no more than another C library's last digits."""
        self.assertEqual(NUMBER.split(committed), NUMBER.split(made), "renew with tools/readme_result")
        for ours, theirs in zip(NUMBER.findall(committed), NUMBER.findall(made)):
            self.assertLessEqual(abs(float(ours) - float(theirs)), allowed(ours), f"{ours} and {theirs}: renew with tools/readme_result")

    def test_the_table_of_the_readme(self):
        made = (self.made / "result.md").read_text()
        lines = (ROOT / "README.md").read_text().splitlines(True)
        start = lines.index(made.splitlines(True)[0])
        self.assert_same("".join(lines[start:start + made.count("\n")]), made, lambda text: 1.001 * 10.0 ** -len(text.partition(".")[2]))

    def test_the_picture_of_the_readme(self):
        self.assert_same((ROOT / "docs" / "result.svg").read_text(), (self.made / "result.svg").read_text(), lambda _: 1.001)


class Evidence(unittest.TestCase):
    def test_every_test_that_a_page_names_exists(self):
        sources = "".join(path.read_text() for path in (ROOT / "tests").rglob("*_test.cpp"))
        existing = set(re.findall(r"(?:TEST(?:_F|_P)?|RC_GTEST_PROP)\(\s*(\w+),\s*(\w+)", sources))
        for page, least in (("paper", 10), ("physics", 20)):
            named = set(re.findall(r"`([A-Z]\w+)\.(\w+)`", (ROOT / "docs" / f"{page}.md").read_text()))
            self.assertGreater(len(named), least)
            self.assertEqual(named - existing, set(), page)
