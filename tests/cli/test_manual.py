"""Man pages and completions that the program makes of its own tables."""

import re
import subprocess
import unittest

from support import ZLG, folder_until


def run(*command):
    return subprocess.run([str(part) for part in command], capture_output=True, text=True, check=True).stdout


class Manual(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = folder_until(cls.addClassCleanup)
        run(ZLG, "--manual", cls.folder)
        cls.pages = {page.stem: page.read_text() for page in (cls.folder / "man1").iterdir()}
        cls.verbs = sorted(name.removeprefix("zlg-") for name in cls.pages if name != "zlg")

    def test_every_option_of_every_verb_is_in_its_page_and_in_the_completions(self):
        self.assertGreaterEqual(len(self.verbs), 10)
        fish = (self.folder / "zlg.fish").read_text()
        for verb in self.verbs:
            self.assertIn(f"zlg\\-{verb} (1)", self.pages["zlg"])
            options = set(re.findall(r"--[a-z][a-z-]*", run(ZLG, verb, "--help")))
            for option in options & {"--out", "--set", "--threads", "--force", "--json", "--config", "--seed"}:
                self.assertIn(f"\\fB{option.replace('-', chr(92) + '-')}\\fR", self.pages[f"zlg-{verb}"])
                self.assertRegex(fish, rf"__fish_seen_subcommand_from {verb}' -l {option[2:]} ")

    def completed(self, *words):
        """What bash offers where the last word is being typed."""
        source = self.folder / "zlg.bash"
        typed = " ".join(f"'{word}'" for word in words)
        script = f"compopt() {{ :; }}; . {source}; COMP_WORDS=({typed}); COMP_CWORD={len(words) - 1}; _zlg; echo \"${{COMPREPLY[@]}}\""
        return run("bash", "-c", script).split()

    def test_bash_completes_verbs_options_and_keys(self):
        self.assertEqual(self.completed("zlg", "calib"), ["calibrate"])
        self.assertEqual(self.completed("zlg", "run", "--dur"), ["--duration"])
        self.assertEqual(self.completed("zlg", "run", "--set", "gyro.tick"), ["gyro.tick_s="])
        self.assertEqual(self.completed("zlg", "process", "raw"), [])

    def test_no_page_has_a_wrong_request(self):
        for page in sorted((self.folder / "man1").iterdir()):
            done = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-z", page], capture_output=True, text=True, check=True)
            self.assertEqual(done.stderr, "", page.name)
