#!/usr/bin/env python3
"""How fast the gyro of the lab page runs beside the program, both fidelities: Chromium, one worker, three compensations.

usage: bench/lab_speed.py [SECONDS [ROUNDS]]

SECONDS of an averaged gyro, a tenth of them of a laser gyro. In a round the page runs a link to that time, and the program the same gyro, one after
the other: `zlg run --threads 1`, with all of its comparisons and its report, and a sweep of this one gyro with no more than the page's three
compensations. Printed are the medians of the ratios of elapsed time; wanted are 0.35 (averaged) and 0.65 (laser) of `zlg run`.
"""

import statistics
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "tests" / "lab"), str(ROOT / "tests" / "cli")]

from lab_browser import LabBrowser  # noqa: E402
from support import run  # noqa: E402

SWEEP = """[sweep]
gyros = 1
duration_s = {duration_s}
[base.gyro]
fidelity = "{fidelity}"
[[metric]]
name = "configured.drift_arcsec_s"
[[metric]]
name = "switching.drift_arcsec_s"
[[metric]]
name = "bridge_quadratic.drift_arcsec_s"
"""


def of_page(browser, fidelity, duration_s):
    """From the first state to the last, by the page's own clock."""
    browser.open_lab(f"gyro.fidelity={fidelity}&until={duration_s:g}")
    browser.value("""begun_ms = ended_ms = 0;
        new MutationObserver(() => {
            const state = document.querySelector('[data-zlg="state"]').textContent;
            if (state === 'running' && begun_ms === 0) begun_ms = performance.now();
            if (state === 'done') ended_ms = performance.now();
        }).observe(document.querySelector('[data-zlg="state"]'), {childList: true, characterData: true, subtree: true});
        begun_ms = document.querySelector('[data-zlg="state"]').textContent === 'running' ? performance.now() : 0;""")
    browser.wait_for_state("done", timeout_s=600)
    return 1e-3 * browser.value("ended_ms - begun_ms")


def of_program(*command):
    begin = time.monotonic()
    made = run(*command)
    if made.returncode != 0:
        sys.exit(made.stderr)
    return time.monotonic() - begin


def main(seconds=2000.0, rounds=5):
    browser = LabBrowser()
    try:
        for fidelity, duration_s, wanted in (("averaged", seconds, 0.35), ("laser", seconds / 10, 0.65)):
            ratios = []
            for k in range(rounds):
                with tempfile.TemporaryDirectory() as folder:
                    (Path(folder) / "one.toml").write_text(SWEEP.format(duration_s=duration_s, fidelity=fidelity))
                    page_s = of_page(browser, fidelity, duration_s)
                    whole_s = of_program("run", "--threads", 1, "--set", f"gyro.fidelity={fidelity}", "--duration", duration_s, "--out", f"{folder}/run")
                    alone_s = of_program("sweep", f"{folder}/one.toml", "--out", f"{folder}/one.h5", "--threads", 1)
                    ratios.append((whole_s / page_s, alone_s / page_s))
            whole, alone = (statistics.median(column) for column in zip(*ratios))
            print(f"{fidelity}, {duration_s:g} s: the page is {duration_s / page_s:.0f} times faster than real time, {whole:.2f} of `zlg run` (wanted {wanted}), "
                  f"{alone:.2f} of the same three compensations in a sweep")
    finally:
        browser.close()


if __name__ == "__main__":
    main(*(kind(word) for kind, word in zip((float, int), sys.argv[1:])))
