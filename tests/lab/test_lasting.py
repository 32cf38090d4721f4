"""The lab page at full speed for a long time: the memory of its module and of its page does not grow. What the worker holds beside the module is not seen here."""


from lab_browser import PageCase


class Lasting(PageCase):
    def test_many_switches_leave_the_memory_as_it_was(self):
        self.browser.open_lab("switching.interval_s=0.5")
        self.browser.wait_for_state("running")
        self.browser.fill("#speed", "4")
        seen = {}
        for at_s in (300, 600, 1500):
            self.browser.wait_until(lambda: self.time_s() > at_s, 120)
            # What a frame has just brought is no growth: the least of several.
            used = []
            for _ in range(5):
                self.browser.send("HeapProfiler.collectGarbage")
                used.append(self.browser.send("Runtime.getHeapUsage")["usedSize"])
            seen[at_s] = (min(used), int(self.browser.value("document.documentElement.dataset.moduleBytes")))
        # 2.3 to 3.2 MB, by the frames that are on their way, up to 12 000 s of gyro time. A kilobyte kept of each of the 1800 switches between
        # would nearly double it.
        self.assertLess(seen[1500][0], 1.5 * seen[600][0])
        self.assertEqual(seen[1500][1], seen[600][1])
