"""docs/physics.md, its pictures and its numbers are what the program computes."""

import re
import subprocess
import unittest

from support import ROOT, ZLG, folder_until

PROGRAM = ZLG.parent / "zlg_physics_pictures"
PICTURES = ROOT / "docs" / "pictures"
PAGE = ROOT / "docs" / "physics.md"
DRAWN_BY_HAND = "chain.svg"

NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


def last_digit(number):
    """What one more in the last digit is worth."""
    mantissa, _, exponent = number.partition("e")
    return 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


def numbers_of(page):
    """The table at the end of the page."""
    return page.partition("## Numbers\n\n")[2]


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = folder_until(cls.addClassCleanup)
        subprocess.run([PROGRAM, cls.made], check=True, timeout=600)

    def assert_same(self, name, committed, allowed):
        """The same text; numbers differ by no more than another compiler's rounding: `allowed(number)`."""
        made = (self.made / name).read_text()
        renew = f"{name}: renew with zlg_physics_pictures docs/pictures; numbers.md is the end of the page"
        self.assertEqual(NUMBER.split(committed), NUMBER.split(made), renew)
        for a, b in zip(NUMBER.findall(committed), NUMBER.findall(made)):
            self.assertLessEqual(abs(float(a) - float(b)), allowed(a), f"{a} and {b}; {renew}")

    def test_the_folder_holds_what_the_program_makes(self):
        named = {p.name for p in PICTURES.iterdir()} - {DRAWN_BY_HAND} | {"numbers.md"}
        self.assertEqual(named, {p.name for p in self.made.iterdir()})

    def test_every_committed_picture_is_what_the_program_draws(self):
        pictures = sorted(p.name for p in self.made.glob("*.svg"))
        self.assertEqual(len(pictures), 8)
        for name in pictures:
            with self.subTest(name):
                self.assert_same(name, (PICTURES / name).read_text(), lambda _: 0.5)  # of 680 units of width

    def test_every_committed_number_is_what_the_program_computes(self):
        self.assert_same("numbers.md", numbers_of(PAGE.read_text()), lambda a: max(1.001 * last_digit(a), 0.02 * abs(float(a))))

    def test_a_wrong_call_and_a_folder_that_cannot_be_are_refused(self):
        self.assertEqual(subprocess.run([PROGRAM], stderr=subprocess.DEVNULL).returncode, 2)
        inside_a_file = PAGE / "pictures"
        self.assertEqual(subprocess.run([PROGRAM, inside_a_file], stderr=subprocess.DEVNULL).returncode, 3)


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
