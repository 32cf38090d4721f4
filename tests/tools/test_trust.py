"""Claims about the pages on trust: what they name exists."""

import re
import tarfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# Pages that name tests, and how many at least.
PAGES = {"tests/regressions.md": 10, "docs/reliability.md": 3, "docs/paper.md": 10, "docs/physics.md": 20}


def existing_tests():
    tests = ROOT / "tests"
    cpp = "".join(path.read_text(encoding="utf-8") for path in tests.rglob("*_test.cpp"))
    python = "".join(path.read_text(encoding="utf-8") for path in tests.rglob("test_*.py"))
    found = re.findall(r"\b(?:TEST(?:_F|_P)?|RC_GTEST_PROP)\(\s*(\w+),\s*(\w+)", cpp)
    return {f"{suite}.{name}" for suite, name in found} | set(re.findall(r"def (test_\w+)", python))


class Pages(unittest.TestCase):
    def test_every_test_that_they_name_exists(self):
        existing = existing_tests()
        for page, least in PAGES.items():
            text = (ROOT / page).read_text(encoding="utf-8")
            named = set(re.findall(r"`([A-Z]\w+\.\w+|test_\w+)`", text))
            with self.subTest(page):
                self.assertGreater(len(named), least)
                self.assertEqual(named - existing, set())

    def test_every_bug_has_its_test(self):
        text = (ROOT / "tests" / "regressions.md").read_text(encoding="utf-8")
        rows = [line for line in text.splitlines() if line.startswith("| ")][1:]
        self.assertGreater(len(rows), 10)
        for row in rows:
            self.assertRegex(row, r"\| `[\w./]+`(, `[\w./]+`)* \|$")


class Fuzz(unittest.TestCase):
    def test_every_target_has_a_small_corpus_and_is_built(self):
        folder = ROOT / "tests" / "fuzz"
        targets = {path.name.removesuffix("_fuzz.cpp") for path in folder.glob("*_fuzz.cpp")}
        with tarfile.open(folder / "corpus.tar.xz") as corpus:
            files = [file for file in corpus if file.isfile()]
        self.assertEqual(targets, {file.name.split("/")[1] for file in files})
        self.assertLess(sum(file.size for file in files), 200_000)
        built = (folder / "CMakeLists.txt").read_text(encoding="utf-8")
        for target in targets:
            self.assertIn(target, built)
