"""zlg settings: what the gyro's processor stores, from a configuration; and what is refused before any gyro hears of it.

That the image runs by it is tested in tests/processor/settings_test.cpp, that the line brings it in tests/firmware/test_kept_settings.py.
"""

import json
import sys
import unittest

from support import ROOT, folder_until, run

sys.path.insert(0, str(ROOT / "tests" / "firmware"))
from gyro_line import crc32c  # noqa: E402


class Settings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = folder_until(cls.addClassCleanup)
        cls.made = cls.folder / "made.bin"
        cls.said = run("settings", "--set", "gyro.tick_s=0.004", "--json", "--out", cls.made)

    def test_they_are_written_and_named(self):
        said = json.loads(self.said.stdout)
        self.assertEqual((self.said.returncode, self.said.stderr), (0, ""))
        self.assertEqual((said["tick_s"], said["bytes"]), (0.004, self.made.stat().st_size))
        data = self.made.read_bytes()
        self.assertEqual(int.from_bytes(data[-4:], "little"), crc32c(data[:-4]))
        self.assertEqual(said["version"], f"{int.from_bytes(data[8:16], 'little'):016x}")

    def test_the_same_configuration_gives_the_same_bytes(self):
        config = self.folder / "gyro.toml"
        config.write_text("[gyro]\ntick_s = 0.004\n")
        again = self.folder / "again.bin"
        self.assertEqual(run("settings", config, "--out", again).returncode, 0)
        self.assertEqual(again.read_bytes(), self.made.read_bytes())
        other = self.folder / "other.bin"
        self.assertEqual(run("settings", config, "--set", "perimeter.loop=digital", "--out", other).returncode, 0)
        self.assertNotEqual(other.read_bytes(), self.made.read_bytes())

    def refused(self, exit_code, words, *arguments):
        found = run("settings", *arguments)
        self.assertEqual((found.returncode, found.stdout), (exit_code, ""), found.stderr)
        self.assertEqual(found.stderr.count("\n"), 1)
        self.assertIn(words, found.stderr)

    def test_a_configuration_that_is_none(self):
        out = self.folder / "none.bin"
        self.refused(2, "gyro.tick_s", "--set", "gyro.tick_s=0", "--out", out)
        self.refused(2, "bin", "--out", self.folder / "none.txt")
        self.refused(2, "--out", "--set", "gyro.tick_s=0.004")
        self.refused(3, "made.bin", "--out", self.made)
        self.assertFalse(out.exists())

    def load(self, exit_code, words, data):
        path = self.folder / "load.bin"
        path.write_bytes(data)
        self.refused(exit_code, words, path, "--to", f"unix:{self.folder}/nobody")

    def test_a_file_that_is_not_whole(self):
        data = self.made.read_bytes()
        for bad in (data[:-1], data[:5000], data[:9], data + b"\0", data[:600] + bytes([data[600] ^ 32]) + data[601:]):
            self.load(3, "cut or has changed", bad)
        self.load(3, "holds no settings", b"")
        self.load(3, "holds no settings", b"[gyro]\ntick_s = 0.004\n")

    def test_a_file_for_another_version(self):
        data = bytearray(self.made.read_bytes())
        data[8] ^= 255
        data[-4:] = crc32c(data[:-4]).to_bytes(4, "little")
        self.load(3, "is for the image of version", bytes(data))

    def test_a_line_that_is_none(self):
        self.load(3, "nobody", self.made.read_bytes())
        self.refused(2, "serial device", self.made, "--to", self.made)
        self.refused(2, "name the file", "--to", "/dev/ttyS0")


if __name__ == "__main__":
    unittest.main()
