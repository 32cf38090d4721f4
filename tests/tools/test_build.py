"""Claims about the build and its scripts on a machine that lacks packages."""

import re
import subprocess
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def files_of_cmake():
    """Not asked of git, which a bare machine lacks."""
    return [path for pattern in ("CMakeLists.txt", "*.cmake") for path in sorted(ROOT.rglob(pattern))
            if path.relative_to(ROOT).parts[0] != "build"]


class Configuration(unittest.TestCase):
    def test_no_absence_of_a_header_is_remembered(self):
        # CMake's check_* commands keep their first answer for ever; find_* look again until they find.
        self.assertTrue(files_of_cmake())
        for path in files_of_cmake():
            with self.subTest(str(path.relative_to(ROOT))):
                self.assertIsNone(re.search(r"^\s*check_\w+\(", path.read_text(encoding="utf-8"), re.M))


class Version(unittest.TestCase):
    def test_a_citation_names_the_version_that_is_built(self):
        built = re.search(r"project\(zlg VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")).group(1)
        cited = re.search(r"^version: (.*)$", (ROOT / "CITATION.cff").read_text(encoding="utf-8"), re.M).group(1)
        self.assertEqual(cited, built)


class Workflows(unittest.TestCase):
    def test_they_call_scripts_that_are_there(self):
        called = [re.findall(r"^ *- run: (scripts/\w+)", path.read_text(encoding="utf-8"), re.M)
                  for path in sorted((ROOT / ".github" / "workflows").iterdir())]
        self.assertEqual(called, [["scripts/test"], ["scripts/test"]])


class Scripts(unittest.TestCase):
    def refused(self, *command):
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1)
        return done.stderr

    def test_an_unknown_set_of_packages_is_refused(self):
        self.assertIn("'everything', allowed: build, bench, python, site, package, test, deep, tidy",
                      self.refused("scripts/install", "everything"))

    def test_an_unknown_kind_of_test_is_refused(self):
        self.assertIn("'all', allowed: deep, quick, tidy", self.refused("scripts/test", "all"))

    def test_every_set_that_a_script_installs_is_known(self):
        install = (ROOT / "scripts" / "install").read_text(encoding="utf-8")
        known = set(re.search(r"usage: scripts/install \[([^\]]+)\]", install).group(1).split("|"))
        for path in sorted((ROOT / "scripts").iterdir()):
            used = re.findall(r"scripts/install\"? (\w+)", path.read_text(encoding="utf-8"))
            self.assertLessEqual(set(used), known, path.name)


if __name__ == "__main__":
    unittest.main()
