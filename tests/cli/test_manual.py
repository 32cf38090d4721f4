"""Man pages and completion, made of what the program's help prints."""

import re
import subprocess
import unittest

from support import ROOT, ZLG, folder_until


def run(*command):
    return subprocess.run([str(part) for part in command], capture_output=True, text=True, check=True).stdout


class Manual(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = folder_until(cls.addClassCleanup)
        run(ROOT / "packaging" / "manual", ZLG, cls.folder)
        cls.pages = {page.stem: page.read_text() for page in cls.folder.iterdir()}
        cls.verbs = sorted(name.removeprefix("zlg-") for name in cls.pages if name != "zlg")

    def test_every_option_of_every_verb_is_in_its_page(self):
        self.assertGreaterEqual(len(self.verbs), 10)
        for verb in self.verbs:
            self.assertRegex(self.pages["zlg"], rf"\n  {verb} ")
            for option in re.findall(r"--[a-z][a-z-]*", run(ZLG, verb, "--help")):
                self.assertIn(option.replace("-", "\\-"), self.pages[f"zlg-{verb}"])

    def completed(self, *words):
        """What bash offers where the last word is being typed."""
        source = ROOT / "packaging" / "zlg.bash"
        typed = " ".join(f"'{word}'" for word in words)
        script = f"PATH={ZLG.parent}:$PATH; compopt() {{ :; }}; . {source}; COMP_WORDS=({typed}); COMP_CWORD={len(words) - 1}; _zlg; echo \"${{COMPREPLY[@]}}\""
        return run("bash", "-c", script).split()

    def test_bash_completes_verbs_options_and_keys(self):
        self.assertEqual(self.completed("zlg", "calib"), ["calibrate"])
        self.assertEqual(self.completed("zlg", "run", "--dur"), ["--duration"])
        self.assertEqual(self.completed("zlg", "run", "--set", "gyro.tick"), ["gyro.tick_s="])
        self.assertEqual(self.completed("zlg", "process", "raw"), [])

    def test_no_page_has_a_wrong_request(self):
        for page in sorted(self.folder.iterdir()):
            done = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-z", page], capture_output=True, text=True, check=True)
            self.assertEqual(done.stderr, "", page.name)
