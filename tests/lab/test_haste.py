"""What a reader in haste meets, or one who has not followed the story: nothing is lost, nothing wrong is shown."""

import re
from urllib.parse import unquote

from lab_browser import LivingPageCase, PageCase

FAULT = "[...document.querySelectorAll('#faults button')].find((button) => button.textContent === {!r}).click();"
CHANGE = "(() => {{ const field = document.querySelector('[data-key=\"{}\"] input'); field.value = {!r}; field.dispatchEvent(new Event('change')); }})();"


class Haste(LivingPageCase):
    def link(self):
        self.browser.value("document.getElementById('share').click()")
        link = unquote(self.browser.value("document.getElementById('share-link').value"))
        self.browser.value("document.getElementById('share-dialog').close()")
        return link

    def report(self):
        return self.browser.text("#fault-report")

    def test_a_setting_and_a_fault_in_one_breath(self):
        self.browser.value(CHANGE.format("drift.magnetic_arcsec_s", "3") + FAULT.format("light noisy") + CHANGE.format("run.seed", "7"))
        self.browser.wait_until(lambda: "run.seed=7" in self.link())
        link = self.link()
        self.assertIn("drift.magnetic_arcsec_s=3", link)
        self.assertIn("light_noisy", link)

    def test_a_wrong_setting_and_a_fault_in_one_breath(self):
        self.browser.value(CHANGE.format("drift.magnetic_arcsec_s", "much") + FAULT.format("light noisy"))
        self.browser.wait_until(lambda: self.browser.marked("message"))
        self.browser.value(FAULT.format("frame missed"))
        self.browser.wait_until(lambda: "frame_missed" in self.link())
        self.assertNotIn("much", self.link())

    def test_of_a_good_and_a_wrong_setting_in_one_breath_the_good_one_stays(self):
        self.browser.value(CHANGE.format("drift.magnetic_arcsec_s", "3") + CHANGE.format("gyro.light_noise_lambda", "much"))
        self.browser.wait_until(lambda: self.browser.marked("message"))
        self.assertIn("drift.magnetic_arcsec_s=3", self.link())
        self.browser.value(FAULT.format("frame missed"))
        self.browser.wait_until(lambda: "frame_missed" in self.link())
        self.assertIn("drift.magnetic_arcsec_s=3", self.link())

    def field(self, key):
        return self.browser.value(f"document.querySelector('[data-key=\"{key}\"] input').value")

    def test_what_was_refused_stays_marked_and_hinders_nothing(self):
        self.browser.value(CHANGE.format("drift.magnetic_arcsec_s", "3"))
        self.browser.wait_until(lambda: "magnetic_arcsec_s=3" in self.link())
        self.browser.value(CHANGE.format("drift.magnetic_arcsec_s", "much"))
        self.browser.wait_until(lambda: self.browser.marked("message"))
        self.browser.value(CHANGE.format("run.seed", "7"))
        self.browser.wait_until(lambda: "run.seed=7" in self.link())
        self.assertIn("magnetic_arcsec_s=3", self.link())
        self.assertEqual(self.field("drift.magnetic_arcsec_s"), "much")
        self.assertIn("much", self.browser.text('[data-key="drift.magnetic_arcsec_s"] .wrong'))
        self.browser.wait_until(lambda: not self.browser.marked("message"))
        self.browser.value(CHANGE.format("drift.magnetic_arcsec_s", ""))
        self.browser.wait_until(lambda: "magnetic" not in self.link())
        self.assertEqual(self.browser.text('[data-key="drift.magnetic_arcsec_s"] .wrong'), "")

    def test_of_two_settings_that_a_message_names_the_one_that_was_changed_is_wrong(self):
        self.browser.fill("#search", "gyro.")
        self.browser.value(CHANGE.format("gyro.tick_s", "0.01"))
        self.browser.value(CHANGE.format("gyro.bias_edge_s", "0.004"))
        self.browser.wait_until(lambda: "gyro.bias_edge_s=0.004" in self.link())
        self.browser.value(CHANGE.format("gyro.tick_s", "0.005"))
        self.browser.wait_until(lambda: self.browser.marked("message"))
        self.assertIn("gyro.bias_edge_s", self.browser.text('[data-key="gyro.tick_s"] .wrong'))
        self.browser.value(CHANGE.format("gyro.light_noise_lambda", "0.002"))
        self.browser.wait_until(lambda: "light_noise_lambda=0.002" in self.link())
        self.assertIn("gyro.tick_s=0.01", self.link())
        self.assertEqual(self.field("gyro.tick_s"), "0.005")
        # Once what stood in its way has gone, it is taken.
        self.browser.value(CHANGE.format("gyro.bias_edge_s", "0.001"))
        self.browser.wait_until(lambda: "gyro.bias_edge_s=0.001" in self.link())
        self.assertNotIn("gyro.tick_s", self.link())

    def test_two_wrong_settings_one_after_the_other(self):
        self.browser.value(CHANGE.format("gyro.light_noise_lambda", "much"))
        self.browser.wait_until(lambda: "light_noise_lambda" in self.browser.marked("message"))
        self.browser.value(CHANGE.format("drift.magnetic_arcsec_s", "more"))
        self.browser.wait_until(lambda: "magnetic_arcsec_s" in self.browser.text('[data-key="drift.magnetic_arcsec_s"] .wrong'))
        self.assertIn("much", self.browser.text('[data-key="gyro.light_noise_lambda"] .wrong'))
        self.browser.value(CHANGE.format("drift.magnetic_arcsec_s", "1"))
        self.browser.wait_until(lambda: "magnetic_arcsec_s=1" in self.link())
        self.assertNotIn("light_noise", self.link())

    def test_a_fault_while_a_change_is_caught_up_with_is_at_its_time(self):
        self.browser.open_lab("switching.interval_s=1&gyro.fidelity=laser")
        self.browser.wait_until(lambda: self.time_s() > 40)
        self.browser.press("#run")
        self.browser.wait_for_state("paused")
        before_s = self.time_s()
        self.browser.value(FAULT.format("frame missed") + "setTimeout(() => {" + FAULT.format("light noisy") + "}, 150);")
        self.browser.wait_until(lambda: "light_noisy" in self.link() and self.time_s() > before_s - 0.01)
        times_s = [float(time) for time in re.search(r"faults.at_s=\[([^]]*)]", self.link())[1].split(",")]
        self.assertEqual([round(time - before_s, 1) for time in times_s], [0.1, 0.1])

    def test_steps_in_one_breath_are_all_taken(self):
        self.browser.press("#run")
        self.browser.wait_for_state("paused")
        before_s = self.time_s()
        self.browser.value(3 * "document.getElementById('step-tick').click();")
        self.browser.wait_until(lambda: self.time_s() > before_s + 0.0149)
        self.browser.value(3 * "document.getElementById('step-half').click();")
        self.browser.wait_until(lambda: self.time_s() > before_s + 0.0224)
        self.assertAlmostEqual(self.time_s(), before_s + 0.0225, delta=1e-9)

    def test_a_link_to_a_late_time_can_be_stopped_stepped_and_jumped_on_the_way(self):
        self.browser.open_lab("switching.interval_s=1&gyro.fidelity=laser&until=7200")
        self.browser.wait_until(lambda: self.time_s() > 3)
        self.browser.press("#run")
        self.browser.wait_for_state("paused")
        stands_s = self.time_s()
        self.assertLess(stands_s, 7200)
        self.browser.press("#step-tick")
        self.browser.wait_until(lambda: self.time_s() != stands_s)
        self.assertAlmostEqual(self.time_s(), stands_s + 0.005, delta=1e-9)
        self.browser.press("#jump")
        self.browser.wait_until(lambda: self.browser.marked("state") == "paused" and self.time_s() > stands_s + 0.006)
        self.assertLess(self.time_s(), stands_s + 1.2)

    def test_a_fault_beside_one_of_a_link_without_quotes(self):
        self.browser.open_lab("faults.kind=laser_off&faults.at_s=5&faults.duration_s=1&faults.size=0")
        self.browser.wait_for_state("running")
        self.browser.value(FAULT.format("frame missed"))
        self.browser.wait_until(lambda: "frame_missed" in self.link())
        self.assertIn("laser_off", self.link())

    def test_what_a_fault_raised_is_reported_however_short_it_was(self):
        for fault, said in (("laser off", "light lost"), ("frame missed", "frame missed"), ("counter bit stuck", "bias lost"), ("temperature nan", "temperature not finite")):
            with self.subTest(fault):
                self.browser.open_lab("switching.interval_s=1")
                self.browser.wait_for_state("running")
                self.browser.wait_until(lambda: self.time_s() > 1)  # so that it knows its bias
                self.browser.value(FAULT.format(fault))
                self.browser.fill("#speed", "2")  # a hundredfold: between two pictures the gyro runs three seconds
                self.browser.wait_until(lambda said=said: said in self.report(), 20)

    def test_a_fault_of_a_switch_lasts_until_there_is_one(self):
        self.browser.open_lab("switching.interval_s=30")
        self.browser.wait_for_state("running")
        self.browser.value(FAULT.format("switch wrong mode"))
        self.browser.wait_until(lambda: "nothing yet; it acts on the next switch" in self.report())
        self.browser.fill("#speed", "2")
        self.browser.wait_until(lambda: "relock failed" in self.report())
        self.assertGreater(self.time_s(), 30)
        self.browser.open_lab("motion.kind=rest")
        self.browser.wait_for_state("running")
        self.assertEqual(self.report(), "")
        self.browser.value(FAULT.format("vibration"))
        self.browser.fill("#speed", "2")
        self.browser.wait_until(lambda: "nothing; it did no harm" in self.report())

    def test_a_hand_however_quick_raises_nothing(self):
        self.browser.open_lab("switching.interval_s=100&motion.kind=rest")
        self.browser.wait_for_state("running")
        for rate in ("30", "-30", "30", "0"):
            self.browser.value(f"(() => {{ const pad = document.getElementById('pad'); pad.value = {rate}; pad.dispatchEvent(new Event('input')); }})()")
            # The case follows, with its inertia.
            self.browser.wait_until(lambda rate=rate: self.browser.text("#now dd").startswith(rate.replace("-", "\u2212") + " "))
        self.assertNotIn("bias", self.browser.text("#health"))
        self.assertEqual(self.browser.marked("fingerprint"), "turned by hand")

    def test_a_fault_while_the_hand_lets_go_leaves_the_turns_as_they_were(self):
        self.browser.open_lab("switching.interval_s=100&motion.kind=rest")
        self.browser.wait_for_state("running")
        self.browser.fill("#speed", "-1")
        self.browser.value("(() => { const pad = document.getElementById('pad'); pad.value = 30; pad.dispatchEvent(new Event('input')); })()")
        self.browser.wait_until(lambda: self.browser.text("#now dd").startswith("30 "))
        self.browser.value("document.getElementById('pad').dispatchEvent(new Event('pointerup'));" + FAULT.format("frame missed"))
        self.browser.wait_until(lambda: "frame_missed" in self.link())
        self.browser.wait_until(lambda: self.browser.text("#now dd").startswith("0 "))
        self.assertNotIn("bias", self.browser.text("#health"))

    def test_a_gyro_that_has_not_begun_shows_nothing_of_the_one_before(self):
        self.browser.wait_until(lambda: self.time_s() > 3)
        self.browser.press("#run")
        self.browser.wait_for_state("paused")
        self.browser.press("#restart")
        self.browser.wait_until(lambda: self.time_s() == 0)
        self.assertRegex(self.browser.text("#now"), "Piezo\u2013Next switch\u2013")
        self.assertIn("at the start", self.browser.text("#ring"))

    def test_an_empty_field_is_its_default_and_shows_it(self):
        self.browser.fill('[data-key="drift.magnetic_arcsec_s"] input', "3")
        self.browser.wait_until(lambda: "magnetic" in self.link())
        self.browser.fill('[data-key="drift.magnetic_arcsec_s"] input', "")
        self.browser.wait_until(lambda: "magnetic" not in self.link())
        self.assertEqual(self.browser.value("document.querySelector('[data-key=\"drift.magnetic_arcsec_s\"] input').value"), "0.7")

    def test_a_gyro_that_never_switches_has_no_next_switch(self):
        self.browser.fill('[data-key="switching.interval_s"] input', "1e9")
        self.browser.wait_until(lambda: "never" in self.browser.text("#now"))
        self.assertTrue(self.browser.value("document.getElementById('jump').disabled"))
        self.browser.value("document.activeElement.blur()")
        self.browser.key("n")
        before_s = self.time_s()
        self.browser.key(" ")
        self.browser.wait_for_state("paused")
        self.assertLess(self.time_s(), before_s + 60)  # near real time, not as fast as it goes

    def test_a_motion_that_was_turned_by_hand_is_not_in_the_link(self):
        self.browser.value("(() => { const pad = document.getElementById('pad'); pad.value = 5; pad.dispatchEvent(new Event('input')); })()")
        self.browser.wait_until(lambda: self.browser.marked("fingerprint") == "turned by hand")
        self.link()
        self.assertIn("turned by hand is neither in the link", self.browser.text("#share-note"))


class BrokenLinks(PageCase):
    def test_each_says_so_and_the_default_gyro_is_a_click_away(self):
        for fragment, said in (("garbage", "section.key=value"), ("foo=1", "foo"), ("switching.interval_s=optimal", "seconds")):
            with self.subTest(fragment):
                self.browser.open_lab(fragment)
                self.browser.wait_for_state("refused")
                self.assertIn(said, self.browser.marked("message"))
                self.assertIn("names no gyro", self.browser.text("#note"))
                # The controls know nothing of it, and the key does what the button does.
                self.browser.value("document.activeElement.blur()")
                self.browser.key("0")
                self.browser.wait_for_state("running")
                self.browser.value(CHANGE.format("run.seed", "7"))
                self.browser.wait_until(lambda: "run.seed=7" in self.browser.value("(document.getElementById('share').click(), document.getElementById('share-link').value)"))
                self.assertEqual(self.browser.marked("message"), "")
                self.assertEqual(self.browser.text("#note"), "")

    def test_a_wrong_setting_behind_one_is_no_hindrance(self):
        self.browser.open_lab("foo=1")
        self.browser.wait_for_state("refused")
        self.browser.value(CHANGE.format("drift.magnetic_arcsec_s", "much"))
        self.browser.wait_until(lambda: "magnetic" in self.browser.marked("message"))
        self.browser.value(CHANGE.format("run.seed", "7"))
        self.browser.wait_for_state("running")
