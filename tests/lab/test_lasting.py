"""The lab page at full speed for a long time: its memory does not grow, and it answers."""

import unittest

from lab_browser import PAGE, PROGRAM
from test_lab import setup_browser


@unittest.skipUnless(PROGRAM, "there is no chromium")
@unittest.skipUnless(PAGE.exists(), "this build holds no lab page")
class Lasting(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        setup_browser(cls)

    def time_s(self):
        return float(self.browser.marked("time"))

    def test_twenty_minutes_of_many_switches_leave_the_memory_as_it_was_after_five(self):
        self.browser.open_lab("switching.interval_s=0.5")
        self.browser.wait_for_state("running")
        self.browser.fill("#speed", "4")
        seen = {}
        for at_s in (300, 600, 1500):
            self.browser.wait_until(lambda: self.time_s() > at_s, 120)
            self.browser.send("HeapProfiler.collectGarbage")
            page = self.browser.send("Runtime.getHeapUsage")
            seen[at_s] = (page["usedSize"], int(self.browser.value("document.documentElement.dataset.moduleBytes")))
        self.assertLess(seen[1500][0], 1.15 * seen[600][0])
        self.assertEqual(seen[1500][1], seen[600][1])


if __name__ == "__main__":
    unittest.main()
