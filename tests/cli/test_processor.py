"""`zlg run --processor qemu`: the image of the gyro's processor in place of this program writes the same files."""

import os
import shutil
import signal
import subprocess
import time
import unittest
from pathlib import Path

from support import ZLG, CliTest, run

IMAGE = ZLG.parent.parent / "firmware" / "zlg_gyro.elf"
HAS_IMAGE = IMAGE.is_file() and shutil.which("qemu-system-arm") is not None
SHORT = ["--duration", 20, "--set", "switching.interval_s=2", "--format", "csv"]


def emulators():
    """Numbers of the running emulators that hold the image."""
    found = set()
    for command in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            words = command.read_bytes().split(b"\0")
        except OSError:
            continue
        if words[0].endswith(b"qemu-system-arm") and str(IMAGE).encode() in words:
            found.add(int(command.parent.name))
    return found


class ProcessorTest(CliTest):
    @unittest.skipUnless(HAS_IMAGE, "no image of the processor, or no emulator")
    def test_the_image_writes_the_files_of_the_host(self):
        settings = ["--set", "compensation.relock=joint", "--set", "faults.random_per_hour=600", *SHORT]
        for processor in ("host", "qemu"):
            result = run("run", *settings, "--processor", processor, "--out", self.folder / processor)
            self.assertEqual(result.returncode, 0, result.stderr)
        for path in sorted((self.folder / "host").iterdir()):
            self.assertEqual(path.read_bytes(), (self.folder / "qemu" / path.name).read_bytes(), path.name)

    @unittest.skipUnless(HAS_IMAGE, "no image of the processor, or no emulator")
    def test_the_emulator_ends_with_a_program_that_is_killed(self):
        before = emulators()
        program = subprocess.Popen([str(ZLG), "run", "--processor", "qemu", "--duration", "36000",
                                    "--out", str(self.folder / "killed")], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            deadline = time.monotonic() + 60
            while not emulators() - before and time.monotonic() < deadline:
                time.sleep(0.05)
            self.assertTrue(emulators() - before, "no emulator was started")
        finally:
            os.kill(program.pid, signal.SIGKILL)
            program.wait()
        deadline = time.monotonic() + 10
        while emulators() - before and time.monotonic() < deadline:
            time.sleep(0.05)
        self.assertFalse(emulators() - before)

    @unittest.skipUnless(HAS_IMAGE, "no image of the processor, or no emulator")
    def test_a_file_that_is_no_image_is_bad_input(self):
        result = run("run", *SHORT, "--processor", "qemu", "--image", __file__, "--out", self.folder / "none")
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertFalse((self.folder / "none").exists())

    def test_without_the_emulator_the_message_names_its_package(self):
        environment = dict(os.environ, PATH="/nowhere")
        result = run("run", *SHORT, "--processor", "qemu", "--image", __file__, "--out", self.folder / "none", env=environment)
        self.assertEqual(result.returncode, 3)
        self.assertIn("qemu-system-arm", result.stderr)
        self.assertFalse((self.folder / "none").exists())

    def test_wrong_usage(self):
        for options in (["--processor", "other"], ["--image", "x.elf"]):
            result = run("run", *SHORT, *options, "--out", self.folder / "none")
            self.assertEqual(result.returncode, 2, result.stderr)


if __name__ == "__main__":
    unittest.main()
