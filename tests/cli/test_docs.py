"""The documentation says what the program says."""

import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from support import ROOT, ZLG


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


class Paper(unittest.TestCase):
    def test_every_test_that_it_names_exists(self):
        text = (ROOT / "docs" / "paper.md").read_text()
        named = set(re.findall(r"`([A-Z]\w+)\.(\w+)`", text))
        self.assertGreater(len(named), 10)
        sources = "".join(path.read_text() for path in (ROOT / "tests").rglob("*_test.cpp"))
        existing = set(re.findall(r"(?:TEST(?:_F|_P)?|RC_GTEST_PROP)\(\s*(\w+),\s*(\w+)", sources))
        self.assertEqual(named - existing, set())


if __name__ == "__main__":
    unittest.main()
