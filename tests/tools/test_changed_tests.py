"""Claims about tools/changed_tests, tools/run_tests and scripts/test quick: each kind of change runs its tests, and nothing is a failure."""

import os
import shutil
import subprocess
import sys
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path

from trees import TOOLS, TreeTest

SCRIPTS = TOOLS.parent / "scripts"
sys.dont_write_bytecode = True
loader = SourceFileLoader("changed_tests", str(TOOLS / "changed_tests"))
changed_tests = module_from_spec(spec_from_loader(loader.name, loader))
loader.exec_module(changed_tests)
FILES = (
    "src/core/control/monitor.cpp", "src/core/common/maths/logarithm.cpp", "src/core/include/zlg/core/records.hpp",
    "tests/core/control/monitor_test.cpp", "tests/core/test_estimate.py", "tests/wire/frame_test.cpp", "tests/twin/twin_test.cpp", "tests/rig/rig_test.cpp",
    "tests/study/study_test.cpp", "tests/report/page_test.cpp", "tests/trials/campaign_test.cpp", "tests/firmware/gyro_test.cpp",
    "tests/processor/qemu_test.cpp",
    "tests/nocompile/volts.cpp", "tests/cli/test_run.py", "tests/cli/test_physics.py", "tests/cli/support.py",
    "tests/cli/golden/run.csv", "tests/python/test_examples.py", "tests/firmware/test_image.py", "tests/install/test_install.py",
    "tests/tools/test_trust.py", "tests/lab/test_views.py", "tests/fuzz/wire_fuzz.cpp",
)
# What is changed, and what must be chosen for it.
CHOICES = {
    "a source of the core, and what may include it": (
        ["src/core/control/monitor.cpp"],
        ["own core", "users firmware rig study trials wire", "later cli firmware lab processor python"]),
    "mathematics of the core, which the twin uses too": (
        ["src/core/common/maths/logarithm.cpp"], ["own core", "users firmware rig study trials twin wire", "later cli firmware lab processor python"]),
    "records of the core": (
        ["src/core/include/zlg/core/records.hpp"],
        ["own core", "users firmware rig study trials twin wire", "later cli firmware lab processor python"]),
    "the estimate of a switch, which NumPy judges": (
        ["src/core/compensation/estimate/walk_kernel.cpp"],
        ["own core", "users firmware rig study trials wire", "core tests/core/test_estimate.py", "later cli firmware lab processor python"]),
    "its test": (["tests/core/test_estimate.py"], ["core tests/core/test_estimate.py"]),
    "its reference": (["tests/reference/gap_estimator.py"], ["tools tests/tools", "core tests/core/test_estimate.py"]),
    "its cases": (["tests/core/estimate_cases.cpp"], ["own core", "core tests/core/test_estimate.py"]),
    "the script of a page": (["src/report/page.js"], ["own report", "users study trials", "later browser cli lab python"]),
    "the build of a library": (
        ["src/report/CMakeLists.txt"], ["own report", "users study trials", "later browser cli lab python"]),
    "a test in C++ stands for its folder alone": (["tests/core/control/monitor_test.cpp"], ["own core"]),
    "what must not compile": (["tests/nocompile/volts.cpp"], ["nocompile"]),
    "the program": (["cli/main.cpp"], ["cli tests/cli"]),
    "one test of the program": (["tests/cli/test_run.py"], ["cli tests/cli/test_run.py"]),
    "what all tests of the program use": (["tests/cli/support.py", "tests/cli/test_run.py"], ["cli tests/cli"]),
    "numbers that a test keeps": (["tests/cli/golden/run.csv"], ["cli tests/cli"]),
    "the Python package": (["python/zlg/x.py"], ["python tests/python"]),
    "the image": (["firmware/src/main.cpp"], ["own firmware", "users trials", "firmware tests/firmware", "later cli processor python"]),
    "the lab page": (["lab/src/main.ts"], ["lab tests/lab"]),
    "a script": (["scripts/run"], ["tools tests/tools"]),
    "a check": (["tools/check_mirror"], ["tools tests/tools"]),
    "the build": (["cmake/ZlgTarget.cmake"], ["all", "tools tests/tools", "install tests/install"]),
    "the build of the tests": (["tests/CMakeLists.txt"], ["all", "tools tests/tools", "install tests/install"]),
    "a document": (["docs/physics.md"], ["tools tests/tools", "cli tests/cli/test_physics.py"]),
    "an example": (["examples/design.py"], ["tools tests/tools", "python tests/python/test_examples.py"]),
    "a benchmark": (["bench/allan.cpp"], ["bench", "tools tests/tools"]),
    "a campaign": (["trials/gyros/draw.cpp"], ["own trials", "later cli python"]),
    "made-up inputs": (["tests/fuzz/wire_fuzz.cpp"], ["tools tests/tools", "later fuzz"]),
    "a list of the tests": (["tests/regressions.md"], ["tools tests/tools"]),
    "a file of the root": (["LICENSE"], ["tools tests/tools"]),
    "a name of another alphabet": (["docs/кольцо.md"], ["tools tests/tools", "cli tests/cli/test_physics.py"]),
    "several": (
        ["src/report/page.cpp", "src/core/control/monitor.cpp", "cli/main.cpp"],
        ["own core report", "users firmware rig study trials wire", "cli tests/cli", "later browser firmware lab processor python"]),
    "nothing": ([], []),
}

# A program of tests that behaves as GoogleTest does; one of its tests fails where the source holds a wrong sign.
PROGRAM = """#!{python}
import json, sys
from pathlib import Path
names = ["Monitor.Sees", "Monitor.Judges", "Accuracy.OfACampaign"]
if "--gtest_list_tests" in sys.argv:
    print("Running main()\\nMonitor.\\n  Sees\\n  Judges  # GetParam() = 1\\nAccuracy.\\n  OfACampaign")
    sys.exit()
flags = Path(sys.argv[1].partition("=")[2]).read_text().splitlines()
chosen = flags[0].partition("=")[2].split(":")
wrong = "-" in Path("{source}").read_text()
if "crash" in Path("{source}").read_text():
    sys.exit(139)
tests = [{{"name": name, "result": "COMPLETED", **({{"failures": [1]}} if wrong and name == names[1] else {{}})}} for name in chosen]
Path(flags[1].partition(":")[2]).write_text(json.dumps({{"testsuites": [{{"testsuite": tests}}]}}))
print("ran", *chosen)
sys.exit(wrong and names[1] in chosen)
"""


class Choice(TreeTest):
    def setUp(self):
        super().setUp()
        for file in FILES:
            self.write(file, "")
        self.write("tests/cli/test_physics.py", 'PAGES = ROOT / "docs"\n')
        self.write("tests/python/test_examples.py", 'EXAMPLES = ROOT / "examples"\n')

    def test_each_kind_of_change_chooses_its_tests(self):
        for claim, (paths, expected) in CHOICES.items():
            with self.subTest(claim):
                self.assertEqual(changed_tests.chosen(self.root, paths), expected)

    def test_no_file_of_the_project_chooses_nothing(self):
        root = TOOLS.parent
        listed = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True, check=False).stdout.splitlines()
        # One of each folder and ending.
        for path in {(Path(line).parent, Path(line).suffix): line for line in listed}.values():
            words = {line.split()[0] for line in changed_tests.chosen(root, [path])}
            self.assertTrue(words - {"later", "all", "bench"}, path)


class Quick(TreeTest):
    """scripts/test quick in a repository of its own, without a compiler: the program of tests is a script."""

    def setUp(self):
        super().setUp()
        for name in ("changed_tests", "run_tests", "check_includes"):
            self.write(f"tools/{name}", (TOOLS / name).read_text(encoding="utf-8")).chmod(0o755)
        self.write("scripts/test", (SCRIPTS / "test").read_text(encoding="utf-8")).chmod(0o755)
        self.write("scripts/install", "#!/bin/sh\n").chmod(0o755)
        self.write("scripts/compiler_cache", "")
        for name in ("tools/check_mirror", "tools/check_budget", "build/stubs/cmake", "build/stubs/clang-format-14"):
            self.write(name, "#!/bin/sh\n").chmod(0o755)
        source = self.write("src/core/control/monitor.cpp", "int sum(int a, int b) { return a + b; }\n")
        self.write("tests/core/control/monitor_test.cpp", "")
        self.write("tests/wire/frame_test.cpp", "")
        self.write(".gitignore", "build\n")
        for folder in ("core", "wire"):
            program = PROGRAM.format(python=sys.executable, source=source if folder == "core" else self.root / ".gitignore")
            self.write(f"build/release/bin/zlg_{folder}_tests", program).chmod(0o755)
        self.git("init", "-q")
        self.commit()

    def git(self, *arguments):
        identity = ["-c", "user.name=x", "-c", "user.email=x@y.invalid", "-c", "commit.gpgsign=false"]
        subprocess.run(["git", *identity, *arguments], cwd=self.root, check=True, capture_output=True)

    def commit(self):
        self.git("add", "-A")
        self.git("commit", "-q", "--allow-empty", "-m", "x")

    def quick(self, *arguments):
        environment = {**os.environ, "PATH": f"{self.root}/build/stubs:{os.environ['PATH']}"}
        return subprocess.run(["bash", self.root / "scripts" / "test", "quick", *arguments], env=environment, capture_output=True,
                              text=True, check=False)

    def change(self, text):
        self.write("src/core/control/monitor.cpp", text)

    def test_a_comment_in_the_core_runs_its_tests_and_those_of_its_users(self):
        self.change("// Why.\nint sum(int a, int b) { return a + b; }\n")
        answer = self.quick()
        self.assertEqual(answer.returncode, 0, answer.stdout + answer.stderr)
        self.assertRegex(answer.stdout, r"unit tests: core +ok")
        self.assertRegex(answer.stdout, r"unit tests of what depends on it ok")
        self.assertTrue(answer.stdout.endswith("\n4 passed, 0 failed\n"), answer.stdout)
        self.assertIn("left to scripts/test", answer.stdout)

    def test_so_does_a_change_that_was_just_committed_and_one_since_a_revision(self):
        self.change("// Why.\n")
        self.commit()
        self.assertIn("4 passed, 0 failed", self.quick().stdout)
        self.commit()
        self.assertIn("4 passed, 0 failed", self.quick("HEAD~2").stdout)

    def test_a_wrong_sign_fails_by_a_test(self):
        self.change("int sum(int a, int b) { return a - b; }\n")
        answer = self.quick()
        self.assertEqual(answer.returncode, 1)
        self.assertTrue(answer.stdout.endswith("\n1 passed, 1 failed\n"), answer.stdout)

    def test_a_crash_is_a_failure(self):
        self.change("crash\n")
        answer = self.quick()
        self.assertEqual(answer.returncode, 1)
        self.assertTrue(answer.stdout.endswith("\n0 passed, 2 failed\n"), answer.stdout)

    def test_a_file_that_moved_stands_for_the_place_that_it_left(self):
        self.write("src/core/control/other.cpp", "int difference(int a, int b) { return a + b; }\n")
        self.commit()
        shutil.move(self.root / "src/core/control/other.cpp", self.root / "other.txt")
        self.commit()
        self.assertIn("4 passed, 0 failed", self.quick().stdout)

    def test_nothing_run_is_a_failure(self):
        self.commit()
        for arguments in ([], ["HEAD"]):
            answer = self.quick(*arguments)
            self.assertEqual(answer.returncode, 1, answer.stdout)
            self.assertIn("no test was run", answer.stdout)
            self.assertTrue(answer.stdout.endswith("\n0 passed, 1 failed\n"), answer.stdout)

    def test_an_unknown_revision_is_refused(self):
        answer = self.quick("no_such")
        self.assertEqual((answer.returncode, answer.stderr.count("\n")), (2, 1), answer.stderr)
        self.assertIn("no revision 'no_such'", answer.stderr)
