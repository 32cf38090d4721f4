"""What the lab page shows and does: controls, faults, turning by hand, links, narrow and dark screens."""

import json
import re
import tempfile
from pathlib import Path

from lab_browser import LivingPageCase
from test_lab import zlg


class Views(LivingPageCase):
    def pause(self):
        self.browser.press("#run")
        self.browser.wait_for_state("paused")

    def change(self, key, value):
        self.browser.fill(f"[data-key=\"{key}\"] input, [data-key=\"{key}\"] select", value)

    def link(self, until=False):
        """What the dialogue offers."""
        self.browser.press("#share")
        if until:
            self.browser.press("#share-until")
        link = self.browser.value("document.getElementById('share-link').value")
        command = self.browser.text("#share-command")
        self.browser.value("document.getElementById('share-dialog').close()")
        return link, command

    def test_next_switch_stops_after_a_switch_and_shows_it(self):
        self.pause()
        before_s = self.time_s()
        self.browser.press("#jump")
        self.browser.wait_until(lambda: self.time_s() > before_s and self.browser.marked("state") == "paused")
        text = self.browser.text("#switch-text")
        self.assertRegex(text, r"open for 3 ticks \(15 ms\) and caught mode")
        at_s = float(re.search(r"At ([\d.]+) s", text)[1])
        self.assertLess(at_s, self.time_s())
        self.assertGreater(at_s, self.time_s() - 1.0)
        self.assertRegex(self.browser.text("#histogram-text"), r"^\d+ switch")

    def test_a_line_that_was_hidden_stays_hidden(self):
        shown = "[...document.querySelectorAll('#plot-error .u-series')].map((line) => !line.classList.contains('u-off'))"
        self.browser.value("document.querySelectorAll('#plot-error .u-series')[2].querySelector('th').click()")
        before = self.browser.value(shown)
        self.assertEqual([at for at, is_shown in enumerate(before) if not is_shown], [2])
        self.addCleanup(self.browser.send, "Emulation.setEmulatedMedia", media="screen", features=[])
        self.browser.value("document.querySelector('#plot-error canvas').dataset.old = 'yes'")
        self.browser.send("Emulation.setEmulatedMedia", media="screen", features=[{"name": "prefers-color-scheme", "value": "dark"}])
        self.browser.wait_until(lambda: self.browser.value("document.querySelector('#plot-error canvas').dataset.old") is None)
        self.assertEqual(self.browser.value(shown), before)

    def test_keys_step_and_pause(self):
        self.browser.value("document.activeElement.blur()")
        self.browser.key(" ")
        self.browser.wait_for_state("paused")
        before_s = self.time_s()
        self.browser.key("t")
        self.browser.wait_until(lambda: abs(self.time_s() - before_s - 0.005) < 1e-9)
        self.browser.key("h")
        self.browser.wait_until(lambda: abs(self.time_s() - before_s - 0.0075) < 1e-9)
        self.browser.key("0")
        self.browser.wait_until(lambda: self.time_s() == 0.0)

    def test_a_changed_setting_is_in_force_from_the_start_on_and_in_the_link(self):
        self.pause()
        time_s = self.time_s()
        self.change("motion.kind", "rest")
        self.browser.wait_until(lambda: "motion.kind" in self.link()[0])
        self.browser.wait_until(lambda: self.time_s() == round((time_s + 1e-9) // 0.005 * 0.005, 4))
        link, command = self.link(until=True)
        fingerprint = self.browser.marked("fingerprint")
        with tempfile.TemporaryDirectory() as out:
            words = [word.strip("'") for word in command.split()[2:]]
            ran = zlg("run", *words, "--logs", "none", "--json", "--out", Path(out) / "run")
        self.assertEqual(json.loads(ran.stdout)["fingerprint"], fingerprint, ran.stderr)
        self.browser.open_lab(link.split("#")[1])
        self.browser.wait_for_state("done")
        self.assertEqual(self.browser.marked("fingerprint"), fingerprint)

    def test_a_refused_setting_is_explained_where_it_stands_and_the_gyro_goes_on(self):
        self.change("switching.interval_s", "-3")
        self.browser.wait_until(lambda: self.browser.marked("message"))
        self.assertIn("switching.interval_s", self.browser.text('[data-key="switching.interval_s"] .wrong'))
        time_s = self.time_s()
        self.browser.wait_until(lambda: self.time_s() > time_s)
        self.change("switching.interval_s", "2")
        self.browser.wait_until(lambda: not self.browser.marked("message"))
        self.assertIn("switching.interval_s=2", self.link()[0])

    def test_search_finds_any_setting_with_unit_range_and_meaning(self):
        self.browser.fill("#search", "mirror")
        shown = self.browser.value("[...document.querySelectorAll('.control')].map(e => e.dataset.key)")
        self.assertIn("piezo.mirror_hz", shown)
        self.assertIn("Hz", self.browser.text('[data-key="piezo.mirror_hz"] label'))
        self.assertIn("Allowed: ", self.browser.text('[data-key="piezo.mirror_hz"] small'))
        keys = re.findall(r"^\| `(\w+)` \|", zlg("--keys").stdout, re.MULTILINE)
        self.browser.fill("#search", "_")
        shown = {key.split(".")[1] for key in self.browser.value("[...document.querySelectorAll('.control')].map(e => e.dataset.key)")}
        self.assertLess(shown - set(keys), {""})
        self.assertGreater(len(shown), 80)

    def test_each_fault_has_a_button_and_its_health_is_named(self):
        kinds = re.search(r"^\| `kind` \|[^|]*\|[^|]*\|([^|]*)\|", zlg("--keys").stdout.split("## [faults]")[1], re.MULTILINE)[1]
        names = re.findall(r'"(\w+)"', kinds)
        buttons = self.browser.value("[...document.querySelectorAll('#faults button')].map(e => e.textContent)")
        self.assertEqual([name.replace("_", " ") for name in names], buttons)
        for k in range(len(buttons)):
            # Not where the mouse is: the page may move under it, for each fault is also a line on the page.
            self.browser.value(f"document.querySelectorAll('#faults button')[{k}].click()")
            self.assertEqual(self.browser.marked("message"), "")
        self.browser.wait_until(lambda: "overspeed" in self.link()[0], 60)
        self.assertEqual(self.browser.marked("message"), "")

    def test_a_dark_laser_is_seen(self):
        self.assertNotIn("light lost: now", self.browser.text("#health"))
        self.browser.fill("#speed", "-1")
        self.browser.press("#faults button:first-child")
        self.browser.wait_until(lambda: "light lost: now" in self.browser.text("#health"))

    def test_a_gyro_that_is_turned_by_hand_has_no_fingerprint_until_it_begins_again(self):
        self.change("motion.kind", "rest")
        self.browser.value("""(() => { const e = document.getElementById('pad'); e.value = 10; e.dispatchEvent(new Event('input')); })()""")
        self.browser.wait_until(lambda: self.browser.text("#now dd").startswith("10 "))
        self.assertEqual(self.browser.marked("fingerprint"), "turned by hand")
        self.browser.value("document.getElementById('pad').dispatchEvent(new Event('pointerup'))")
        self.browser.wait_until(lambda: self.browser.text("#now dd").startswith("0 "))
        self.browser.press("#restart")
        self.browser.wait_until(lambda: len(self.browser.marked("fingerprint")) == 16)

    def test_nothing_is_wider_than_the_screen_and_every_field_has_a_name(self):
        for width in (390, 760, 1200):
            for dark in (False, True):
                with self.subTest(width=width, dark=dark):
                    self.browser.open_lab("switching.interval_s=1", width=width, dark=dark)
                    self.browser.wait_for_state("running")
                    self.assertEqual(self.browser.value("document.documentElement.scrollWidth"), width)
        unnamed = self.browser.value("""[...document.querySelectorAll('input, select, textarea, button')].filter(e =>
            !(e.labels?.length || e.getAttribute('aria-label') || e.textContent.trim())).map(e => e.outerHTML)""")
        self.assertEqual(unnamed, [])
