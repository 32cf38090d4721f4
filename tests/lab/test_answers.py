"""How soon the lab page answers. It runs alone: a second browser beside it would take the processor."""


from lab_browser import LivingPageCase


class Answers(LivingPageCase):
    def test_a_click_is_answered_within_a_tenth_of_a_second_at_full_speed(self):
        """From the click to the picture after the changed state, by the page's own clock.

        Nine of ten clicks, in the best of three rounds: other programs may want the processor.
        """
        for fidelity in ("averaged", "laser"):
            with self.subTest(fidelity=fidelity):
                self.browser.open_lab(f"gyro.fidelity={fidelity}")
                self.browser.wait_for_state("running")
                self.browser.fill("#speed", "4")
                self.browser.wait_until(lambda: self.browser.text("#speed-text") == "as fast as it goes")
                self.browser.value("""asked_ms = 0;
                    document.getElementById('run').addEventListener('click', () => asked_ms = performance.now(), true);
                    new MutationObserver(() => {
                        const from_ms = asked_ms;
                        asked_ms = 0;
                        if (from_ms > 0) requestAnimationFrame(() => answers.push(performance.now() - from_ms));
                    }).observe(document.querySelector('[data-zlg="state"]'), {childList: true, characterData: true, subtree: true});""")
                rounds_ms = []
                while len(rounds_ms) < 3 and (not rounds_ms or rounds_ms[-1][17] >= 100):
                    rounds_ms.append(self.answers_ms())
                self.assertLess(rounds_ms[-1][17], 100, rounds_ms)

    def answers_ms(self):
        """Of twenty clicks, in rising order."""
        self.browser.value("answers = []")
        for n in range(1, 21):
            self.browser.press("#run")
            self.browser.wait_until(lambda n=n: self.browser.value("answers.length") == n, timeout_s=5)
        return sorted(self.browser.value("answers"))
