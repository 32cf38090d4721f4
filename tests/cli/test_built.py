"""The built programs: where they look for their libraries, and what the compiler has put in against foreign bytes."""

import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from support import ZLG

PROGRAMS = [path for path in sorted(Path(ZLG).parent.iterdir()) if path.read_bytes()[:4] == b"\x7fELF"]


def said_of(program, *options):
    """What readelf tells of a program."""
    return subprocess.run(["readelf", "-W", *options, program], capture_output=True, text=True, check=True).stdout


@unittest.skipUnless(shutil.which("readelf"), "there is no readelf")
class Built(unittest.TestCase):
    def test_no_program_looks_for_libraries_elsewhere_than_the_system(self):
        self.assertIn(Path(ZLG), PROGRAMS)
        for program in PROGRAMS:
            with self.subTest(program.name):
                self.assertNotRegex(said_of(program, "-d"), r"\((?:RPATH|RUNPATH)\)")

    def test_no_library_of_the_current_folder_is_loaded(self):
        libraries = re.findall(r"\(NEEDED\)\s+Shared library: \[(.+)\]", said_of(ZLG, "-d"))
        self.assertGreater(len(libraries), 5)
        with tempfile.TemporaryDirectory() as folder:
            for library in libraries:
                (Path(folder) / library).touch()  # the loader refuses an empty library
            done = subprocess.run([ZLG, "--version"], cwd=folder, capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_a_write_beyond_an_array_ends_the_program(self):
        called = set(re.findall(r" UND (\w+)", said_of(ZLG, "--dyn-syms")))
        self.assertIn("__stack_chk_fail", called)
        self.assertRegex(" ".join(called), r"\b__\w+_chk\b")
        # Of the assertions of the standard library.
        self.assertTrue(any("__glibcxx_assert_fail" in name for name in called), sorted(called))

    def test_what_the_loader_has_resolved_is_read_only(self):
        self.assertRegex(said_of(ZLG, "-d"), r"BIND_NOW|Flags:.* NOW")
        self.assertIn("GNU_RELRO", said_of(ZLG, "-l"))
