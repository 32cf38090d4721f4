"""Small trees of files for the tests of the checks."""

import subprocess
import tempfile
import unittest
from pathlib import Path

TOOLS = Path(__file__).resolve().parents[2] / "tools"


class TreeTest(unittest.TestCase):
    """A test with an empty folder of its own and a check to run on it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)

    def write(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        return file

    def run_check(self, name, *arguments):
        command = [TOOLS / name, *(arguments or (self.root,))]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def assert_good(self, answer):
        self.assertEqual((answer.returncode, answer.stderr), (0, ""), answer.stdout)

    def assert_refused(self, answer, *fragments):
        self.assertEqual(answer.returncode, 1, answer.stdout + answer.stderr)
        for fragment in fragments:
            self.assertIn(fragment, answer.stdout)
