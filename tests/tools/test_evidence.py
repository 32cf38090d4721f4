"""bench/evidence: what it names can be run, and a name that it does not know is refused. The figures of the pages equal the rows of evidence."""

import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
EVIDENCE = ROOT / "bench" / "evidence"


def call(*names):
    return subprocess.run([EVIDENCE, *names], capture_output=True, text=True)


class Evidence(unittest.TestCase):
    def test_every_command_is_a_file_of_the_project_or_one_of_the_campaigns(self):
        lines = call().stdout.splitlines()
        self.assertGreater(len(lines), 10)
        campaigns = re.findall(r'^    {"(\w+)", "', (ROOT / "trials" / "programs" / "zlg_trials.cpp").read_text(), re.MULTILINE)
        for line in lines:
            program, *words = line.partition(": ")[2].split()
            self.assertTrue(words[0] in campaigns if program == "zlg_trials" else (ROOT / program).is_file(), line)

    def test_every_name_that_a_document_gives_is_known(self):
        known = {line.partition(":")[0] for line in call().stdout.splitlines()}
        pages = [*(ROOT / "docs").glob("*.md"), *ROOT.glob("*.md")]
        named = {word for page in pages for words in re.findall(r"bench/evidence((?: [a-z_]+)+)(?:`|  |\n)", page.read_text()) for word in words.split()}
        self.assertGreater(len(named), 8)
        self.assertEqual(named - known, set())

    def test_an_unknown_name_is_refused_before_anything_is_measured(self):
        done = call("gyros", "nothing")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("'nothing'", done.stderr)


class Figures(unittest.TestCase):
    """tools/document_evidence, on the pages as they are and on copies of them made wrong."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        for name in ("tools/document_evidence", "tools/evidence.toml", "README.md", *(f"docs/{page}.md" for page in ("index", "accuracy", "paper", "noise", "evidence"))):
            (self.root / name).parent.mkdir(exist_ok=True)
            shutil.copy(ROOT / name, self.root / name)

    def said(self, *options):
        done = subprocess.run([self.root / "tools" / "document_evidence", *options], capture_output=True, text=True)
        self.assertEqual(done.returncode, bool(done.stderr))
        return done.stderr.splitlines()

    def change(self, name, old, new):
        text = (self.root / name).read_text(encoding="utf-8")
        self.assertEqual(text.count(old), 1)
        (self.root / name).write_text(text.replace(old, new), encoding="utf-8")

    def test_every_number_of_the_pages_is_that_of_its_row(self):
        self.assertEqual(self.said("--check"), [])

    def test_another_number_is_found_and_mended(self):
        self.change("README.md", "the rms over 39 switches", "the rms over 40 switches")
        self.assertEqual(self.said("--check"), ["README.md: not as the rows say; renew with tools/document_evidence"])
        self.assertEqual(self.said(), [])
        self.assertEqual((self.root / "README.md").read_text(encoding="utf-8"), (ROOT / "README.md").read_text(encoding="utf-8"))

    def test_a_number_without_a_row_and_a_row_without_its_piece_are_named(self):
        self.change("docs/accuracy.md", "within 1.5 % (", "within chance (")
        self.change("docs/index.md", "interval is 90 s", "interval is 91 s")
        given, number, row = self.said("--check")
        self.assertEqual(given, "docs/index.md: given, and not there: interval is 90 s")
        self.assertRegex(number, "^docs/index.md: a number without a row: .*interval is 91 s")
        self.assertEqual(row, "docs/accuracy.md: not there, or there twice: agree with an independent computation within {} %")
