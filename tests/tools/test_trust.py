"""Claims about the pages on trust: what they name exists."""

import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGES = ("tests/regressions.md", "docs/reliability.md")


def existing_tests():
    tests = ROOT / "tests"
    cpp = "".join(path.read_text(encoding="utf-8") for path in tests.rglob("*_test.cpp"))
    python = "".join(path.read_text(encoding="utf-8") for path in tests.rglob("test_*.py"))
    found = re.findall(r"\b(?:TEST(?:_F|_P)?|RC_GTEST_PROP)\(\s*(\w+),\s*(\w+)", cpp)
    return {f"{suite}.{name}" for suite, name in found} | set(re.findall(r"def (test_\w+)", python))


class Pages(unittest.TestCase):
    def test_every_test_that_they_name_exists(self):
        existing = existing_tests()
        for page in PAGES:
            text = (ROOT / page).read_text(encoding="utf-8")
            named = set(re.findall(r"`([A-Z]\w+\.[A-Z]\w+|test_\w+)`", text))
            with self.subTest(page):
                self.assertEqual(named - existing, set())

    def test_every_bug_has_its_test(self):
        text = (ROOT / "tests" / "regressions.md").read_text(encoding="utf-8")
        rows = [line for line in text.splitlines() if line.startswith("| ")][1:]
        self.assertGreater(len(rows), 10)
        for row in rows:
            self.assertRegex(row, r"\| `[\w./]+`(, `[\w./]+`)* \|$")


class Fuzz(unittest.TestCase):
    def test_every_target_has_a_corpus_and_is_built(self):
        folder = ROOT / "tests" / "fuzz"
        targets = {path.name.removesuffix("_fuzz.cpp") for path in folder.glob("*_fuzz.cpp")}
        self.assertEqual(targets, {path.name for path in (folder / "corpus").iterdir()})
        built = (folder / "CMakeLists.txt").read_text(encoding="utf-8")
        for target in targets:
            self.assertIn(target, built)

    def test_the_corpus_stays_small(self):
        sizes = [path.stat().st_size for path in (ROOT / "tests" / "fuzz" / "corpus").rglob("*") if path.is_file()]
        self.assertLess(sum(sizes), 200_000)
