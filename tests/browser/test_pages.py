"""The pages in a browser: what the script adds, what is there without it, and how a page stands on a telephone and in the dark."""

import csv
import subprocess
import tempfile
import unittest
from pathlib import Path

from chromium import PROGRAM, Browser

ROOT = Path(__file__).resolve().parents[2]
ZLG = ROOT / "build" / "release" / "bin" / "zlg"

SWEEP = """sweep = {gyros = 12, seed = 1, duration_s = 5}
base.switching.interval_s = 1
parameter = [
    {keys = ["piezo.half_wave_v"], draw = "uniform", min = 39, max = 41},
    {keys = ["compensation.relock"], draw = "list", values = ["joint", "mean_square"]},
]
metric = [{name = "configured.switch_error_rms_arcsec", max = 3}]
"""

# Of the figure with an error bar on each point.
FIGURE = "document.querySelector('#errors-in-time')"


@unittest.skipUnless(PROGRAM, "there is no chromium")
class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="zlg-pages-")
        cls.addClassCleanup(folder.cleanup)
        out = Path(folder.name)

        def made(*arguments):
            subprocess.run([ZLG, *arguments], check=True, capture_output=True)

        made("run", "--duration", "400", "--set", "switching.interval_s=10", "--out", out / "run")
        made("design", "--out", out / "design.html")
        made("analyze", out / "run" / "angles.h5", "--out", out / "analysis.html")
        made("analyze", out / "run" / "raw.h5", "--out", out / "raw.html")
        made("run", "--duration", "1", "--out", out / "short")
        made("paper", "--duration", "20", "--out", out / "paper")
        (out / "sweep.toml").write_text(SWEEP)
        made("sweep", out / "sweep.toml", "--out", out / "sweep.h5", "--page", out / "sweep.html")
        cls.run_page, cls.sweep_page = out / "run" / "report.html", out / "sweep.html"
        cls.pages = [cls.run_page, out / "design.html", out / "analysis.html"]
        cls.more_pages = [cls.sweep_page, out / "raw.html", out / "short" / "report.html", out / "paper" / "paper.html"]
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.close)

    def place(self, selector):
        """The middle of an element, scrolled into view."""
        return self.browser.value(f"""(() => {{ const e = {selector}; e.scrollIntoView({{block: 'center'}});
            const r = e.getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]; }})()""")

    def readout(self):
        return self.browser.value(f"{FIGURE}.parentNode.querySelector('.readout').textContent")

    def labels(self):
        return self.browser.value(f"{FIGURE}.querySelector('.x-ticks').textContent.trim()")

    def test_a_point_under_the_pointer_shows_its_values_with_sigma(self):
        self.browser.open(self.run_page)
        x, y = self.place(f"{FIGURE}.querySelectorAll('.series circle')[4]")
        self.browser.mouse("mouseMoved", x, y)
        with open(self.run_page.parent / "switches.csv", encoding="utf-8") as file:
            row = list(csv.DictReader(line for line in file if not line.startswith("#")))[4]
        name, time, error = self.readout().replace("−", "-").split("\n")
        self.assertEqual(name, "error, with the claimed standard deviation")
        self.assertAlmostEqual(float(time.split(": ")[1]), 0.005 * int(row["tick"]), delta=1.0)
        value, sigma = error.split(": ")[1].split(" ± ")
        self.assertAlmostEqual(float(value), float(row["true_error_arcsec"]), delta=0.05)
        self.assertAlmostEqual(float(sigma), float(row["sigma_arcsec"]), delta=0.05)
        self.assertEqual(self.browser.value(f"getComputedStyle({FIGURE}.querySelector('.point')).visibility"), "visible")

    def test_the_arrow_keys_go_from_point_to_point(self):
        self.browser.open(self.run_page)
        self.browser.value(f"{FIGURE}.focus()")
        times = []
        for _ in range(3):
            self.browser.key("ArrowRight")
            times.append(float(self.readout().split("\n")[1].split(": ")[1]))
        self.assertEqual(times, sorted(set(times)))
        self.browser.key("ArrowLeft")
        self.assertEqual(float(self.readout().split("\n")[1].split(": ")[1]), times[1])

    def test_the_arrow_keys_go_from_series_to_series(self):
        self.browser.open(self.run_page)
        figure = "document.querySelector('#sum-of-errors')"
        self.browser.value(f"{figure}.focus()")
        names = []
        for key in ("ArrowRight", "ArrowDown", "ArrowDown"):
            self.browser.key(key)
            names.append(self.browser.value(f"{figure}.parentNode.querySelector('.readout').textContent.split('\\n')[0]"))
        self.assertEqual(len(set(names)), 3)

    def test_a_drag_zooms_and_a_double_click_and_escape_go_back(self):
        self.browser.open(self.run_page)
        whole, plot = self.labels(), f"{FIGURE}.querySelector('.plot')"
        for back in ("double click", "Escape"):
            x, y = self.place(plot)
            self.browser.drag((x - 60, y), (x + 60, y + 5))
            zoomed = self.labels()
            self.assertNotEqual(zoomed, whole)
            ticks = [float(t) for t in self.browser.value(f"[...{FIGURE}.querySelectorAll('.x-ticks text')].map(e => e.textContent)")]
            self.assertLess(max(ticks) - min(ticks), 200.0, "a quarter of the 400 s or so")
            stale = f"[...{FIGURE}.querySelectorAll(':scope > path')].filter(e => getComputedStyle(e).display != 'none').length"
            self.assertEqual(self.browser.value(stale), 2, "of the lines, the grid and the ticks were drawn anew, the others wait")
            # What the axis says of a point is what its readout says.
            where = self.browser.value(f"""(() => {{ const t = [...{FIGURE}.querySelectorAll('.x-ticks text')].map(e => +e.getAttribute('x'));
                return [t[0], t.at(-1)]; }})()""")
            self.browser.mouse("mouseMoved", x, y)
            ring = self.browser.value(f"+{FIGURE}.querySelector('.point').getAttribute('cx')")
            by_axis = ticks[0] + (ring - where[0]) / (where[1] - where[0]) * (ticks[-1] - ticks[0])
            self.assertAlmostEqual(float(self.readout().split("\n")[1].split(": ")[1]), by_axis, delta=0.5)
            if back == "Escape":
                self.browser.value(f"{FIGURE}.focus()")
                self.browser.key("Escape")
            else:
                self.browser.click(x, y, times=2)
            self.assertEqual(self.labels(), whole)

    def test_a_key_zooms_about_the_point_that_is_read(self):
        self.browser.open(self.run_page)
        whole = self.labels()
        self.browser.value(f"{FIGURE}.focus()")
        for key in ("ArrowRight", "ArrowRight", "+", "+"):
            self.browser.key(key)
        self.assertNotEqual(self.labels(), whole)
        self.assertNotEqual(self.readout(), "", "the point is still in the plot")

    def test_a_name_in_the_legend_hides_and_shows_its_series_by_pointer_and_key(self):
        self.browser.open(self.run_page)
        entry = "document.querySelector('#sum-of-errors .legend > g')"
        state = f"[getComputedStyle(document.querySelector('#sum-of-errors .series')).display, {entry}.getAttribute('aria-pressed')]"
        self.assertEqual(self.browser.value(state), ["inline", "true"])
        self.browser.click(*self.place(entry))
        self.assertEqual(self.browser.value(state), ["none", "false"])
        self.browser.value(f"{entry}.focus()")
        self.browser.key(" ")
        self.assertEqual(self.browser.value(state), ["inline", "true"])

    def test_in_the_dark_the_page_and_its_drawings_change_colour(self):
        look = f"""[getComputedStyle(document.body).backgroundColor, getComputedStyle({FIGURE}).fill,
            getComputedStyle({FIGURE}.querySelector('.series')).stroke]"""
        self.browser.open(self.run_page)
        light = self.browser.value(look)
        self.browser.open(self.run_page, dark=True)
        dark = self.browser.value(look)
        for a, b in zip(light, dark):
            self.assertNotEqual(a, b)
        brightness = [sum(int(n) for n in c[4:-1].split(",")) for c in dark]
        self.assertLess(brightness[0], 120)
        self.assertGreater(min(brightness[1:]), 300)

    def test_nothing_is_wider_than_a_telephone_and_numbers_are_seen_there(self):
        for page in self.pages:
            for script in (True, False):
                with self.subTest(page=page.name, script=script):
                    self.browser.open(page, width=390, height=800, script=script)
                    size = self.browser.send("Page.getLayoutMetrics")["cssContentSize"]
                    self.assertLessEqual(size["width"], 390)
            self.browser.open(page, width=390, height=800)
            hidden = self.browser.value("""[...document.querySelectorAll('figure.table')].filter(t => {
                const n = t.querySelector('td'); return n && n.getBoundingClientRect().right > innerWidth; }).length""")
            self.assertEqual(hidden, 0, "a table shows no number without scrolling")
            size = self.browser.value("""(() => { const svg = document.querySelector('.drawing svg');
                const scale = svg.getBoundingClientRect().width / svg.viewBox.baseVal.width;
                return scale * parseFloat(getComputedStyle(svg.querySelector('.x-ticks text')).fontSize); })()""")
            self.assertGreater(size, 10.0, "text of a plot, px")

    def test_no_page_complains_at_any_width(self):
        for page in self.pages + self.more_pages:
            for width in (390, 1200):
                self.browser.open(page, width=width)
                self.assertGreater(self.browser.value("document.querySelectorAll('.live').length"), 0)
                self.assertEqual(self.browser.complaints(), [])

    def test_no_figure_of_any_page_complains_whatever_is_done_with_it(self):
        for page in self.pages + self.more_pages:
            with self.subTest(page=page.name):
                self.browser.open(page)
                n = self.browser.value("document.querySelectorAll('figure[data-figure]').length")
                self.assertGreater(n, 0)
                self.assertEqual(self.browser.value("document.querySelectorAll('figure[data-figure].live').length"), n)
                for k in range(n):
                    self.exercise(f"document.querySelectorAll('figure[data-figure]')[{k}]")
                    self.assertEqual(self.browser.complaints(), [], k)

    def exercise(self, figure):
        """The pointer over all of a figure, a drag and back, the keys, and each name of its legend off and on."""
        x, y, width, height = self.browser.value(f"""(() => {{ const e = {figure}.querySelector('.plot');
            e.scrollIntoView({{block: 'center'}}); const r = e.getBoundingClientRect(); return [r.x, r.y, r.width, r.height]; }})()""")

        def at(across, down):
            return x + across * width, y + down * height

        shown = set()
        for across in range(1, 10):
            for down in (0.1, 0.5, 0.9):
                self.browser.mouse("mouseMoved", *at(across / 10, down))
            shown.add(self.browser.value(f"{figure}.querySelector('.readout').textContent"))
        self.assertTrue(shown - {""}, "no point of it is read")
        self.assertNotRegex(" ".join(shown), r"NaN|undefined|Infinity")
        self.browser.drag(at(0.3, 0.3), at(0.7, 0.7))
        self.browser.mouse("mouseMoved", *at(0.5, 0.5))
        self.browser.click(*at(0.5, 0.5), times=2)
        self.browser.value(f"{figure}.querySelector('svg').focus()")
        for key in ("ArrowRight", "ArrowRight", "ArrowDown", "+", "-", "Escape"):
            self.browser.key(key)
        names = f"[...{figure}.querySelectorAll('.legend > [role]')].forEach(e => e.dispatchEvent(new Event('click')))"
        for _ in ("off", "on"):
            self.browser.value(names)
            self.browser.mouse("mouseMoved", *at(0.5, 0.5))
        self.browser.mouse("mouseMoved", 1, 1)

    def test_without_script_the_page_is_whole_and_promises_nothing(self):
        self.browser.open(self.run_page, script=False)
        tree = self.browser.send("DOMSnapshot.captureSnapshot", computedStyles=["display"])
        text = " ".join(tree["strings"])
        for words in ("39 switches; a switch costs", "How this page was made"):
            self.assertIn(words, text)
        layout = tree["documents"][0]["layout"]
        shown = " ".join(tree["strings"][i] for i in layout["text"] if i >= 0)
        self.assertNotIn("point at a curve", shown)
