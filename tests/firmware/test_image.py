"""What the image is linked of. ZLG_BUILD names the folder of the build, which is build/release otherwise."""

import os
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MAP = Path(os.environ.get("ZLG_BUILD", ROOT / "build" / "release")) / "firmware" / "zlg_gyro.map"


@unittest.skipUnless(MAP.is_file(), "needs the image: arm-none-eabi-g++ was not there when it was built")
class Libraries(unittest.TestCase):
    def test_the_image_needs_no_library_of_cpp(self):
        # Debian brings it in a package of 1.6 GB that a bare machine does not have.
        archives = {Path(name).name for name in re.findall(r"^(?:LOAD )?(\S+\.a)\b", MAP.read_text(encoding="utf-8"), re.M)}
        foreign = {name for name in archives if not name.startswith("libzlg_")}
        self.assertTrue(foreign, "the map names no archive: the pattern is wrong")
        self.assertLessEqual(foreign, {"libc.a", "libgcc.a"})
