"""The commands of the documents run, one after the other, and print what the pages say."""

import os
import re
import subprocess
import tempfile
import unittest

from support import ROOT, ZLG

PAGES = sorted(page for page in (ROOT / "docs").glob("*.md") if "\n```sh\n" in page.read_text())
BLOCK = re.compile(r"^```(sh|text)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def words(line):
    return " ".join(line.split())


class Pages(unittest.TestCase):
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
