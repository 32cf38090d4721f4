"""The estimate of a switch in the core against the reference in NumPy, over drawn gyros, motions and windows."""

from dataclasses import replace
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests"))
from reference import gap_estimator as reference  # noqa: E402

PROGRAM = ROOT / "build/release/bin/zlg_estimate_cases"
BEFORE, AFTER = 16, 40


def motion(draw, kind, t):
    """Angle of a drawn motion at the times t."""
    tone = lambda f, a: -a / (2 * np.pi * f) * np.cos(2 * np.pi * f * t + draw.uniform(0, 6.28))
    if kind == "rate":
        return draw.uniform(-6e4, 6e4) * t
    if kind == "tone":
        return tone(draw.uniform(1, 40), draw.uniform(100, 12000))
    if kind == "band":
        return sum(tone(f, 8485 * np.sqrt(2 / 60)) for f in draw.uniform(0.1, 20, 60))
    if kind == "ramp":
        start, lasts, rate = t[-1] - 0.15 + draw.uniform(-0.05, 0.05), draw.choice([0.02, 0.05, 0.3]), draw.choice([3600, 36000])
        during = (t - start).clip(0, lasts)
        return rate / lasts * (during**2 / 2 + lasts * (t - start - lasts).clip(0))
    return 0 * t


def read_halves(draw, gyro, angle, sign, false):
    """Halves as a free-running counter, or the phase, reads them, less the bias."""
    bias = gyro.bias * gyro.scale * gyro.tick_s / 2
    place = np.r_[0, np.cumsum(sign * bias - false)] + angle
    if gyro.fringe_noise is None:
        reading = gyro.scale * np.floor(place / gyro.scale + draw.random())
    else:
        reading = place + draw.normal(0, gyro.fringe_noise * gyro.scale, len(place))
    return np.diff(reading) - sign * bias


def second_moments(y, length):
    """Of all windows, about the mean, alike in both directions of time; and their number."""
    w = np.lib.stride_tricks.sliding_window_view(y - y.mean(), length)
    gram = w.T @ w
    return (gram + gram[::-1, ::-1]) / 2, len(w)


def simple_rows(gap_halves, relock):
    hi = BEFORE + gap_halves
    rows = [(h, h + 1, True, False) for h in range(BEFORE)] + [(BEFORE, hi, False, True)]
    rows += [(h, h + 1, True, relock) for h in range(hi, hi + 16)]
    return rows + [(h, h + 2, True, relock) for h in range(hi + 16, hi + AFTER, 2)]


def mixed_rows(draw, gap_halves, relock):
    """Rows of one and two halves, some without a reading beside the gap, some of the gap's halves read or their sum known."""
    rows, length = [], BEFORE + gap_halves + AFTER
    lo, hi = BEFORE, BEFORE + gap_halves
    h = 0
    while h < length:
        last = min(h + (2 if h >= hi + 8 else int(draw.choice([1, 2, 2]))), lo if h < lo else hi if h < hi else length)
        in_gap = lo <= h < hi
        read = draw.random() < (0.3 if in_gap else 0.9) and not (in_gap and sum(row[2] and row[0] >= lo for row in rows) == 4)
        rows.append((h, last, read, not read if in_gap else read and relock and h >= hi))
        h = last
    return rows


def drawn_case(draw, mixed):
    gyro = reference.Gyro(scale=draw.choice([3.263, 3.263 / 4]), tick_s=draw.choice([0.002, 0.005, 0.01]),
                          fringe_noise=0.0016 if draw.random() < 0.33 else None)
    gap, relock, samples = int(draw.integers(2, 25 if mixed else 33)), draw.random() < 0.8, int(draw.choice([1, 2, 4, 16, 64]))
    rows = mixed_rows(draw, gap, relock) if mixed else simple_rows(gap, relock)
    length, learnt = BEFORE + gap + AFTER, int(draw.choice([200, 2000, 6000]))
    n = learnt + length
    t = np.arange(n + 1) * gyro.tick_s / 2
    kind = draw.choice(["rest", "rate", "tone", "band", "ramp"])
    angle = motion(draw, kind, t) + np.r_[0, np.cumsum(draw.normal(0, gyro.random_walk * np.sqrt(gyro.tick_s / 2), n))]
    sign = np.tile([1.0, -1.0], n // 2 + 1)[:n]
    false, light = np.zeros(n), np.zeros((0, 0))
    if relock:
        sample_s = (np.arange(AFTER * samples) + 0.5) / samples * gyro.tick_s / 2
        light = (0.22 * np.exp(-sample_s / gyro.tick_s) + draw.normal(0, gyro.light_noise, AFTER * samples)).reshape(AFTER, samples)
        edges = np.exp(-np.arange(AFTER + 1))
        bias = gyro.bias * gyro.scale * gyro.tick_s / 2
        false[-AFTER:] = 1.03 * gyro.chi * bias * 0.22**2 * (edges[:-1] - edges[1:]) * sign[-AFTER:]
    y = read_halves(draw, gyro, angle, sign, false)
    errors = {}
    if mixed:
        errors = {"error_var": draw.choice([0.0, 1.0], len(rows)) * 1e-3, "common": draw.normal(0, 0.05, len(rows)) * [row[0] >= BEFORE for row in rows]}
    window = reference.Window(rows, (BEFORE, BEFORE + gap), y[-length:], sign[-length:], light,
                              magnetic_variance=draw.choice([0.0, 1e-5]), **errors)
    return gyro, window, *second_moments(y[:learnt], length), draw.choice([0.0, 0.02]), draw.choice([0.01, 1e-4])


def text_of(gyro, window, moments, windows, scale, scale_var, bank=len(reference.BANK)):
    """A case as the program reads it."""
    numbers = [bank, len(window.rows), *window.gap, len(window.y), *(window.light.shape if window.light.size else (0, 1)),
               gyro.scale, gyro.bias, gyro.chi, gyro.light_noise, gyro.tick_s, gyro.random_walk, gyro.fringe_noise or 0.0,
               gyro.fringe_noise is not None, scale, scale_var, window.magnetic_variance, windows]
    zero = np.zeros(len(window.rows))
    more = zip(window.rows, zero if window.error_var is None else window.error_var, zero if window.common is None else window.common)
    numbers += [x for row, *errors in more for x in [*row, *errors]]
    return " ".join(repr(float(x)) for x in [*numbers, *moments.ravel(), *window.y, *window.sign, *window.light.ravel()])


def estimates(cases, **more):
    """For each case: known, angle, variance, scale, its variance, then angle and variance of each row."""
    done = subprocess.run([PROGRAM], input="\n".join(text_of(*case, **more) for case in cases) + "\n", capture_output=True, text=True, check=True)
    return [[float(x) for x in line.split()] for line in done.stdout.splitlines()]


@pytest.mark.parametrize("mixed", [False, True], ids=["halves", "rows of every kind"])
def test_the_core_and_the_reference_agree(mixed):
    draw = np.random.default_rng(20261127 + mixed)
    cases = [drawn_case(draw, mixed) for _ in range(120)]
    for case, (known, angle, variance, scale, scale_var, *_) in zip(cases, estimates(cases), strict=True):
        want = reference.estimate(*case)
        assert known == 1
        assert abs(angle - want[0]) <= 1e-5 * np.sqrt(want[1])
        assert variance == pytest.approx(want[1], rel=1e-5, abs=1e-12)
        assert scale == pytest.approx(want[2], rel=1e-5, abs=1e-5 * np.sqrt(want[3]))
        assert scale_var == pytest.approx(want[3], rel=1e-5)


def only(window, r):
    """The same window with one row wanted."""
    rows = [(*row[:3], k == r) for k, row in enumerate(window.rows)]
    return replace(window, rows=rows)


def test_each_row_is_estimated_as_if_it_alone_were_wanted():
    draw = np.random.default_rng(6)
    cases = [drawn_case(draw, mixed) for mixed in [False, True] * 6]
    for case, (known, angle, variance, *rest) in zip(cases, estimates(cases, bank=0), strict=True):
        gyro, window, moments, windows, scale, scale_var = case
        rows = rest[2:]
        for r in [k for k, row in enumerate(window.rows) if row[3]]:
            want = reference.estimate(gyro, only(window, r), moments, windows, scale, scale_var, bank=[])
            assert abs(rows[2 * r] - want[0]) < 1e-4 * np.sqrt(want[1])
            assert rows[2 * r + 1] == pytest.approx(want[1], rel=1e-4)


def test_the_rows_add_up_to_the_angle_of_the_mixture():
    draw = np.random.default_rng(9)
    cases = [drawn_case(draw, mixed) for mixed in [False, True] * 10]
    for case, (known, angle, variance, *rest) in zip(cases, estimates(cases), strict=True):
        wanted = [k for k, row in enumerate(case[1].rows) if row[3]]
        assert sum(rest[2:][2 * r] for r in wanted) == pytest.approx(angle, abs=1e-6 * np.sqrt(variance) + 1e-9)
        if len(wanted) == 1:
            assert rest[2:][2 * wanted[0] + 1] == pytest.approx(variance, rel=1e-6)


def test_what_lies_in_the_gap_is_never_read():
    draw = np.random.default_rng(7)
    case = drawn_case(draw, False)
    first = estimates([case])
    lo, hi = case[1].gap
    case[1].y[lo:hi] = 1e6
    assert estimates([case]) == first
