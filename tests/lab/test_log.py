"""Logs of the reader's own on the lab page: the same angles and the same complaints as those of `zlg process`."""

import base64
import gzip
import math
import re
import subprocess
import tempfile
import time
from pathlib import Path

from lab_browser import PAGE, LivingPageCase
from test_lab import zlg

HERE = Path(__file__).resolve().parent


def rows_of(path):
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    return lines[0], [tuple(float(field) for field in line.split(",")) for line in lines[1:]]


class Logs(LivingPageCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.raw = cls.folder / "raw.csv"
        made = zlg("simulate", "--duration", 60, "--set", "switching.interval_s=5", "--out", cls.raw)
        assert made.returncode == 0, made.stderr

    def state(self):
        return self.browser.value("document.getElementById('card-log').dataset.state")

    def give(self, path, state="shown"):
        self.browser.give("#log-file", path)
        self.browser.wait_until(lambda: self.state() in ("shown", "refused"))
        self.assertEqual(self.state(), state, self.browser.text("#log-text"))
        return self.browser.text("#log-text")

    def angles_of_the_module(self, log, *settings):
        """Of the module that the page holds, called by the page's own code in node."""
        packed = base64.b64decode(re.search(r'id="module">([^<]*)<', PAGE.read_text())[1])
        (self.folder / "module.wasm").write_bytes(gzip.decompress(packed))
        out = self.folder / "of_the_module.csv"
        ran = subprocess.run(["node", HERE / "log_angles.mjs", self.folder / "module.wasm", log, *settings], capture_output=True, text=True)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        out.write_text(ran.stdout)
        return rows_of(out)

    def angles_of_the_program(self, *settings):
        out = self.folder / "angles.csv"
        ran = zlg("process", self.raw, "--out", out, "--force", *[word for each in settings for word in ("--set", each)])
        self.assertEqual(ran.returncode, 0, ran.stderr)
        return rows_of(out)

    def test_the_angles_of_a_raw_log_are_those_of_the_program_to_the_last_bit(self):
        text = self.give(self.raw)
        self.assertRegex(text, r"^raw\.csv: a raw log, compensated here; 12000 ticks of 5 ms, 60 s; 11 gaps, 11 switches")
        shown = float(re.search(r"accumulated angle (\S+) arcsec", text.replace("−", "-"))[1])
        of_the_program = self.angles_of_the_program()
        self.assertAlmostEqual(shown, sum(row[2] for row in of_the_program[1]), delta=1e-6)
        self.assertEqual(self.angles_of_the_module(self.raw), of_the_program)

    def test_settings_of_the_reader_go_over_those_of_the_log(self):
        settings = ["compensation.relock=frequency", "compensation.bridge=linear"]
        self.browser.fill("#log-settings", "\n".join(settings))
        self.give(self.raw)
        self.assertIn("compensation.relock=\"frequency\"", self.browser.text("#log-notes"))
        self.assertEqual(self.angles_of_the_module(self.raw, *settings), self.angles_of_the_program(*settings))
        self.browser.fill("#log-settings", "gyro.tick_s=0.004")
        text = self.give(self.raw, "refused")
        said = zlg("process", self.raw, "--set", "gyro.tick_s=0.004", "--out", self.folder / "no.csv").stderr
        self.assertEqual(text, said.strip().removeprefix("zlg: ").replace(str(self.raw), "raw.csv"))

    def test_an_angle_log_is_shown_with_its_flags_and_its_angle(self):
        _, rows = self.angles_of_the_program()
        text = self.give(self.folder / "angles.csv")
        self.assertIn("an angle log; 12000 ticks", text)
        self.assertAlmostEqual(float(re.search(r"accumulated angle (\S+) arcsec", text.replace("−", "-"))[1]), sum(row[2] for row in rows), delta=1e-6)
        flags = dict(item.rsplit(": ", 1) for item in self.browser.value("[...document.querySelectorAll('#log-flags li')].map(e => e.textContent)"))
        self.assertEqual(int(flags["interpolated"]), sum(int(row[6]) >> 2 & 1 for row in rows))
        self.assertTrue(self.browser.value("document.getElementById('log-switches').hidden"))

    def test_a_damaged_log_is_refused_with_the_words_of_the_program(self):
        head, *rows = self.raw.read_text().splitlines(keepends=True)
        first = next(k for k, line in enumerate(rows) if line.startswith("0,"))
        damages = {
            "word": lambda r: r[first + 700].replace(",", ",x", 1),
            "field": lambda r: r[first + 700].rsplit(",", 1)[0] + "\n",
            "hole": lambda r: "",
        }
        for name, damage in damages.items():
            with self.subTest(name):
                damaged = [*rows]
                damaged[first + 700] = damage(rows)
                path = self.folder / f"{name}.csv"
                path.write_text(head + "".join(damaged))
                said = zlg("process", path, "--out", self.folder / "no.csv").stderr.strip().removeprefix("zlg: ")
                self.assertIn("row 701", said)
                self.assertEqual(self.give(path, "refused"), said.replace(str(path), path.name))

    def test_a_file_that_is_no_log_is_refused_in_one_line_that_says_what_it_is(self):
        hdf5 = self.folder / "log.h5"
        self.assertEqual(zlg("convert", self.raw, "--out", hdf5).returncode, 0)
        for name, content, words in (("log.h5", hdf5.read_bytes(), "is an HDF5 log; the page reads CSV"), ("a.zip", b"PK\x03\x04" + bytes(40), "a ZIP archive"),
                                     ("empty.csv", b"", "holds no"), ("other.csv", b"a,b\n1,2\n", "holds one row")):
            with self.subTest(name):
                path = self.folder / name
                path.write_bytes(content)
                text = self.give(path, "refused")
                self.assertIn(words, text)
                self.assertNotIn("\n", text)

    def test_text_of_another_program_is_read_as_import_reads_it(self):
        rates = [round(0.004 + 0.001 * math.sin(0.1 * k), 6) for k in range(3000)]
        plain = self.folder / "vendor.csv"
        plain.write_text("Gyro SN 0417\nZeit;Rate\n" + "".join(f"{k / 100:.2f};{rate:.6f}\n".replace(".", ",") for k, rate in enumerate(rates)))
        text = self.give(plain, "refused")
        for missing in ("unit=", "time_unit="):
            self.assertIn(missing, text)
        self.browser.fill("#log-settings", "unit=deg/s\nholds=rate\ntime_unit=s")
        self.assertRegex(self.give(plain), r"^vendor\.csv: an angle log; 3000 ticks of 10 ms, 30 s;")
        angle = float(re.search(r"accumulated angle (\S+) arcsec", self.browser.text("#log-text"))[1])
        self.assertAlmostEqual(angle, 3600 * 0.01 * sum(rates), delta=1e-6)
        self.assertIn("deg/s", self.browser.text("#log-notes"))

    def test_halves_under_other_names_give_the_angles_of_the_program(self):
        lines = [line for line in self.raw.read_text().splitlines() if not line.startswith("#")]
        names = lines[0].split(",")
        of = [names.index(name) for name in ("half", "bias_sign", "mode", "counts", "loop_closed")]
        other = self.folder / "raw2.csv"
        other.write_text("\n".join(["Nr;Sign;Helicity;N;Lock"] + [";".join(line.split(",")[k] for k in of) for line in lines[1:]]) + "\n")
        maps = ["half=Nr", "bias_sign=Sign", "mode=Helicity", "counts=N", "loop_closed=Lock", "tick_s=0.005", "scale_arcsec=3.263", "time=none"]
        self.browser.fill("#log-settings", "\n".join(maps))
        self.give(other)
        out = self.folder / "angles2.csv"
        ran = zlg("process", other, "--out", out, *[word for each in maps for word in ("--map", each)])
        self.assertEqual(ran.returncode, 0, ran.stderr)
        self.assertEqual(self.angles_of_the_module(other, *maps), rows_of(out))

    def test_a_dropped_file_is_read_and_one_that_is_being_read_can_be_left(self):
        big = self.folder / "big.csv"
        text = self.raw.read_text()
        rows = [line for line in text.splitlines() if line[0].isdigit()]
        head = text[: text.index(rows[0])]
        # The same minute again and again, its rows numbered anew: 10^6 of them.
        per_part = len(rows)
        tails = [row.split(",", 1)[1] for row in rows]
        with big.open("w") as out:
            out.write(head)
            for part in range(1_000_000 // per_part + 1):
                out.write("".join(f"{part * per_part + k},{tail}\n" for k, tail in enumerate(tails)))
        data = {"items": [], "files": [str(big)], "dragOperationsMask": 1}
        for kind in ("dragEnter", "dragOver", "drop"):
            self.browser.send("Input.dispatchDragEvent", type=kind, x=600, y=300, data=data)
        self.browser.wait_until(lambda: self.state() == "reading" and float(self.browser.value("document.getElementById('log-progress').value")) > 0.02)
        # The page goes on: its clock, its frames, its answers.
        slowest_ms = self.browser.value("""new Promise(done => { let last = performance.now(), slowest = 0, n = 0; const frame = () => {
            const now = performance.now(); slowest = Math.max(slowest, now - last); last = now; ++n < 30 ? requestAnimationFrame(frame) : done(slowest); };
            requestAnimationFrame(frame); })""")
        self.assertLess(slowest_ms, 400)
        self.browser.press("#log-close")
        self.browser.wait_until(lambda: self.state() == "closed", 1)
        begin = time.monotonic()
        self.assertIn(f"{(1_000_000 // per_part + 1) * per_part // 2} ticks", self.give(big))
        self.assertLess(time.monotonic() - begin, 60)

    def test_the_last_switch_is_shown_magnified(self):
        self.give(self.raw)
        self.assertTrue(self.browser.text("#log-switch-text").startswith("At 55 s the loop was open for 3 ticks (15 ms)"))
