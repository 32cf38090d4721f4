"""The documentation says what the program says: tables, commands, and the numbers and pictures of docs/physics.md."""

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


class OwnLog(unittest.TestCase):
    def test_its_example_log_gives_the_angles_that_it_says(self):
        lines = (ROOT / "docs" / "own_log.md").read_text().splitlines()
        start = lines.index("# gyro.tick_s = 0.005")
        log = lines[start:lines.index("DATA", start)]
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


PAGES = sorted(page for page in (ROOT / "docs").glob("*.md") if "\n```sh\n" in page.read_text())
BLOCK = re.compile(r"^```(sh|text)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def words(line):
    return " ".join(line.split())


class Commands(unittest.TestCase):
    """The commands of the documents run, one after the other, and print what the pages say."""

    def follow(self, page, folder):
        printed = ""
        environment = {**os.environ, "PATH": f"{ZLG.parent}:{os.environ['PATH']}", "LC_ALL": "C.UTF-8"}
        for kind, content in BLOCK.findall(page.read_text()):
            if kind == "sh":
                done = subprocess.run(["bash", "-euo", "pipefail", "-c", content], cwd=folder, env=environment,
                                      capture_output=True, text=True, timeout=60)
                self.assertEqual(done.returncode, 0, f"{page.name}: {content}{done.stderr}")
                printed = words(done.stdout)
            else:
                for line in content.splitlines():
                    self.assertIn(words(line), printed, page.name)

    def test_there_are_pages(self):
        self.assertEqual({page.stem for page in PAGES}, {"calibration", "first_run", "own_gyro", "own_log"})

    def test_every_command_runs_and_prints_what_the_page_says(self):
        for page in PAGES:
            with self.subTest(page.name), tempfile.TemporaryDirectory() as folder:
                self.follow(page, folder)


PICTURES = ROOT / "docs" / "pictures"
PHYSICS = ROOT / "docs" / "physics.md"

SIGNED_NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


def numbers_of(page):
    """The table at the end of the page."""
    return page.partition("## Numbers\n\n")[2]


class Physics(unittest.TestCase):
    def setUp(self):
        self.text = PHYSICS.read_text()

    def test_every_number_that_links_to_the_table_is_in_it(self):
        table = set(SIGNED_NUMBER.findall(numbers_of(self.text)))
        quoted = re.findall(r"\[([\d.e-]+)(?:\s[^\]]*)?\]\(#numbers\)", self.text)
        self.assertGreater(len(quoted), 10)
        self.assertEqual(set(quoted) - table, set())

    def test_it_shows_every_picture(self):
        shown = set(re.findall(r"\(pictures/(\w+\.svg)\)", self.text))
        self.assertEqual(shown, {p.name for p in PICTURES.glob("*.svg")})

    def test_every_default_that_it_lists_is_that_of_the_program(self):
        listed = subprocess.run([ZLG, "--keys"], capture_output=True, text=True, check=True).stdout
        section, defaults = "", {}
        for line in listed.splitlines():
            if found := re.match(r"#+ `?\[?(\w+)\]?`?", line):
                section = found.group(1)
            elif found := re.match(r"\| `(\w+)` \|", line):
                defaults[f"{section}.{found.group(1)}"] = [cell.strip() for cell in line.split("|")][2:4]
        rows = re.findall(r"^\| `(\w+\.\w+)` \| ([^|]*) \| ([^|]*) \|", self.text, re.MULTILINE)
        self.assertGreater(len(rows), 25)
        for key, value, unit in rows:
            with self.subTest(key):
                self.assertIn(key, defaults)
                self.assertEqual([unit.strip(), f"`{value.strip()}`"], defaults[key])
