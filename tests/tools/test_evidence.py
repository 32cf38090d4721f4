"""bench/evidence: what it names can be run, and a name that it does not know is refused."""

import re
import subprocess
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
