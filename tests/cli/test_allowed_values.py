"""What `zlg --keys` allows, every verb takes, or refuses with one line that names a key which was set.

ZLG_DRAWS: values a key and verb; without it each key is tried with one verb."""

import math
import os
import re

from support import CliTest, csv_text, quiet_log, run

DRAWS = int(os.environ.get("ZLG_DRAWS", "0"))
VERBS = 4
NUMBER = r"(-?[0-9.]+(?:e-?[0-9]+)?)"
LARGEST = 1.7976931348623157e308


def keys():
    """(key, words of what is allowed) of the table."""
    section = ""
    for line in run("--keys").stdout.splitlines():
        if line.startswith("## ["):
            section = line[4:-1]
        cells = [cell.strip() for cell in line.split(" | ")]
        name = re.match(r"\|?\s*`?(\w+)`?$", cells[0])
        if len(cells) >= 5 and name and name.group(1) != "key":
            yield f"{section}.{name.group(1)}", cells[3]


def limits(words):
    least, most = -LARGEST, LARGEST
    both = re.search(NUMBER + r"\.\." + NUMBER, words)
    if both:
        least, most = float(both.group(1)), float(both.group(2))
    for pattern, min_of in (("above ", lambda x: math.nextafter(x, math.inf)), ("from ", lambda x: x)):
        found = re.search(pattern + NUMBER, words)
        if found:
            least = min_of(float(found.group(1)))
    found = re.search("up to " + NUMBER, words)
    if found:
        most = float(found.group(1))
    found = re.search("to below " + NUMBER, words)
    if found:
        most = math.nextafter(float(found.group(1)), -math.inf)
    return least, most


class AllowedValues(CliTest):
    def value(self, words):
        names = re.findall(r'"([^"]+)"', words)
        if names:
            return self.random.choice(names)
        if words == "-1 or 1":
            return self.random.choice(["-1", "1"])
        if "text" in words:
            return "text"
        least, most = limits(words)
        kind = self.random.randrange(5)
        if kind == 0:
            x = least
        elif kind == 1:
            x = most
        else:
            low = math.log10(least) if least > 0 else -9
            high = math.log10(most) if 0 < most < 1e9 else 9
            x = 10 ** self.random.uniform(min(low, high), high)
        x = min(max(x, least), most)
        if "but 0" in words and x == 0:
            x = 1.0
        whole = re.fullmatch(r"-?\d+\.\.\d+|from \d+", words)
        return str(int(min(x, 2**53))) if whole else repr(x)

    def draw(self, turn, *verb):
        complaints = []
        for k, (key, words) in enumerate(keys()):
            if DRAWS == 0 and k % VERBS != turn:
                continue
            if key in ("run.duration_s", "gyro.tick_s", "motion.path") or key == "gyro.fidelity":
                continue
            for _ in range(max(DRAWS, 1)):
                value = self.value(words)
                setting = f"{key}={value}"
                result = run(*verb, "--set", setting, timeout=60)
                lines = result.stderr.splitlines()
                if result.returncode == 0:
                    continue
                # A gyro that cannot switch is a result: a piezo of a thousand seconds, say.
                if result.returncode == 1 and lines and re.search("switch(es)? of modes", lines[-1]):
                    continue
                named = result.returncode in (2, 3) and len(lines) == 1 and key in lines[0]
                if not named:
                    complaints.append(f"{setting}: exit {result.returncode}: {lines[-2:]}")
        self.assertEqual(complaints, [], "\n" + "\n".join(complaints))

    def test_run(self):
        self.draw(0, "run", "--duration", 1, "--set", "switching.interval_s=0.4", "--out", self.folder / "run", "--force")

    def test_simulate(self):
        self.draw(1, "simulate", "--duration", 0.5, "--set", "perimeter.loop=digital", "--out", self.folder / "a.csv", "--force")

    def test_design(self):
        self.draw(2, "design", "--json")

    def test_process(self):
        log = self.write("log.csv", csv_text(quiet_log(gap=range(20, 23)), lines=["gyro.tick_s = 0.005", "gyro.scale_arcsec = 3.263"]))
        self.draw(3, "process", log, "--out", self.folder / "a.csv", "--force")
