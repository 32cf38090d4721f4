"""docs/physics.md: its pictures, the numbers that it quotes, the tests and the defaults that it names."""

import re
import subprocess
import unittest

from support import ROOT, ZLG

PICTURES = ROOT / "docs" / "pictures"
PAGE = ROOT / "docs" / "physics.md"

NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


def numbers_of(page):
    """The table at the end of the page."""
    return page.partition("## Numbers\n\n")[2]


class Page(unittest.TestCase):
    def setUp(self):
        self.text = PAGE.read_text()

    def test_every_number_that_links_to_the_table_is_in_it(self):
        table = set(NUMBER.findall(numbers_of(self.text)))
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
