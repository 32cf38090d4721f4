"""Recorded motions on the lab page: the gyro that they turn is that of `zlg run` on the same file."""

import json
import math
import tempfile
from pathlib import Path

from lab_browser import LivingPageCase
from test_lab import zlg


class Motions(LivingPageCase):
    def setUp(self):
        super().setUp()
        self.browser.fill("#speed", "4")
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def saved(self, name, button):
        self.browser.send("Page.setDownloadBehavior", behavior="allow", downloadPath=str(self.folder))
        self.browser.value(f"document.getElementById('{button}').click()")
        self.browser.wait_until((self.folder / name).exists)
        return self.folder / name

    def fingerprint_of_the_program(self):
        """Of the exported configuration, beside the motion."""
        config = self.saved("gyro.toml", "export-toml")
        ran = zlg("run", config, "--set", f"motion.path={self.motion}", "--logs", "none", "--json", "--out", self.folder / "run")
        self.assertEqual(ran.returncode, 0, ran.stderr)
        return json.loads(ran.stdout)["fingerprint"]

    def test_a_file_of_rates_turns_the_gyro_to_its_end_as_in_the_program(self):
        self.motion = self.folder / "own.csv"
        rows = "".join(f"{2 + k / 100},{k % 7},{30 * math.sin(k / 40)}\n" for k in range(1200))
        self.motion.write_text(f"# of a table\ntime_s,n,rate_deg_s\n{rows}")
        self.browser.give("#motion-file", self.motion)
        self.browser.wait_until(lambda: "1200 rows" in self.browser.text("#motion-text"))
        self.assertEqual(self.browser.text("#motion-text"), "own.csv: 1200 rows of “rate_deg_s” in deg/s, 100 a second, 12 s")
        self.browser.wait_for_state("done")
        self.assertEqual(self.browser.marked("time"), "12.0000")
        self.assertEqual(self.browser.marked("fingerprint"), self.fingerprint_of_the_program())

    def test_each_motion_that_the_page_makes_can_be_saved_and_run_by_the_program(self):
        names = self.browser.value("[...document.querySelectorAll('#motions button')].map(e => e.textContent)")
        self.assertEqual(len(names), 3)
        for k, name in enumerate(names, 1):
            with self.subTest(name):
                self.browser.press(f"#motions button:nth-child({k})")
                file = f"{name.replace(' ', '_')}.csv"
                self.browser.wait_until(lambda: self.browser.text("#motion-text").startswith(f"{file}: "))
                # "done" may still be that of the motion before.
                self.browser.wait_until(lambda: f", {float(self.browser.marked('time')):g} s" in self.browser.text("#motion-text"))
                self.browser.wait_for_state("done")
        self.motion = self.saved(file, "motion-save")
        self.assertEqual(self.browser.marked("fingerprint"), self.fingerprint_of_the_program())

    def test_what_is_no_motion_is_refused_in_one_line_and_the_gyro_goes_on(self):
        files = {
            "no_times.csv": ("a,rate_deg_s\n1,2\n2,3\n", "has no column of times"),
            "no_unit.csv": ("t_s,rate\n1,2\n2,3\n", "has no column of rates"),
            "other_unit.csv": ("t_s,x_mdps,x_mdeg_s,x_urad_s,x_grad_s\n1,2,2,2,2\n2,3,3,3,3\n", "has no column of rates"),
            "twice.csv": ("t_s,rate_dps,rate_dps\n1,2,2\n2,3,3\n", "two columns are named 'rate_dps'"),
            "hexadecimal.csv": ("t_s,rate_dps\n0,1\n1,0x10\n", "row 2, column 'rate_dps': '0x10' is no finite number"),
            "slowing.csv": ("t_s,rate_dps\n" + "".join(f"{0.01 * k + 0.0045 * max(0, k - 150)},1\n" for k in range(300)), "off the even steps"),
            "word.csv": ("t_s,rate_dps\n0,1\n1,x\n", "word.csv:3, row 2, column 'rate_dps': 'x' is no finite number"),
            "hole.csv": ("t_s,rate_dps\n0,1\n1,1\n2,1\n4,1\n5,1\n", "a motion has no holes"),
            "short.csv": ("t_s,rate_dps\n0,1,2\n", "short.csv:2, row 1: 3 fields, where the column names are 2"),
        }
        for name, (text, words) in files.items():
            with self.subTest(name):
                (self.folder / name).write_text(text)
                self.browser.give("#motion-file", self.folder / name)
                self.browser.wait_until(lambda: name in self.browser.text("#motion-text") and "Reading" not in self.browser.text("#motion-text"))
                self.assertIn(words, self.browser.text("#motion-text"))
                self.assertEqual(self.browser.marked("state"), "running")

    def test_a_dropped_motion_is_offered_as_one(self):
        path = self.folder / "own.csv"
        path.write_text("t_s,rate_dps\n" + "".join(f"{k / 50},{k % 9}\n" for k in range(100)))
        data = {"items": [], "files": [str(path)], "dragOperationsMask": 1}
        for kind in ("dragEnter", "dragOver", "drop"):
            self.browser.send("Input.dispatchDragEvent", type=kind, x=600, y=300, data=data)
        self.browser.wait_until(lambda: self.browser.value("document.getElementById('log-as-motion').offsetParent !== null"))
        self.browser.press("#log-as-motion")
        self.browser.wait_until(lambda: "100 rows" in self.browser.text("#motion-text"))
        self.browser.wait_for_state("done")
        self.assertEqual(self.browser.marked("time"), "2.0000")
