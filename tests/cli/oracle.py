"""Offline reference of the compensation, written from the equations and not from the program.

It sees the whole log at once, so it has no state, no delay and no streaming. Least squares (14), (15) is solved in exact
rationals; only the re-lock formulas, which hold a root or a logarithm, are floating point.

Notation: a gap is the ticks first..last; j = 1..n inside it, j = 0 the tick before, j = n + 1 the tick after.
"""

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
import math

LONGEST_BRIDGED = 16
ORDER = {"constant": 0, "linear": 1, "quadratic": 2}


@dataclass(frozen=True)
class Settings:
    """[gyro] and [compensation] with the defaults of the configuration."""

    tick_s: float = 0.005
    scale_arcsec: float = 3.263
    bias_hz: float = 60e3
    bias_chi: float = 3.6
    reference_temperature_c: float = 20.0
    bias_temperature_coefficient_per_c: float = 0.0
    relock: str = "none"
    relock_ticks: int = 20
    bridge: str = "quadratic"
    extrapolation_points: int = 4
    points_before: int = 2
    points_after: int = 2


@dataclass
class Tick:
    """What the angle log must say of one tick; None in a flag: the contract leaves it open."""

    raw: Fraction
    gap: bool
    final: Fraction = Fraction(0)
    dtheta: Fraction = Fraction(0)
    lump: Fraction = Fraction(0)
    correction: bool = False
    extrapolated: bool = False
    interpolated: bool = False
    lower_order: object = False
    unrepaired: bool = False
    relock_corrected: bool = False
    relock_uncorrected: bool = False
    settled: bool = True  # at the end of this tick nothing is outstanding: both sums agree


@lru_cache(maxsize=None)
def weights(positions, target, order):
    """Exact weights of the least-squares polynomial through `positions`, read at `target`; order at most points - 1."""
    order = min(order, len(positions) - 1)
    size = order + 1
    table = [[Fraction(sum(x ** (r + c) for x in positions)) for c in range(size)] + [Fraction(target**r)] for r in range(size)]
    for pivot in range(size):
        row = next(r for r in range(pivot, size) if table[r][pivot] != 0)
        table[pivot], table[row] = table[row], table[pivot]
        table[pivot] = [value / table[pivot][pivot] for value in table[pivot]]
        for other in range(size):
            if other != pivot:
                factor = table[other][pivot]
                table[other] = [a - factor * b for a, b in zip(table[other], table[pivot])]
    return tuple(sum(table[r][size] * x**r for r in range(size)) for x in positions)


def fit(ticks, points, target, order):
    """Value at tick `target` of the polynomial through the final values of `points`."""
    shift = points[0]
    exact = weights(tuple(p - shift for p in points), target - shift, order)
    return sum(w * ticks[p].final for w, p in zip(exact, points))


def find_gaps(ticks):
    """Longest runs of gap ticks as pairs (first, last)."""
    gaps = []
    for k, tick in enumerate(ticks):
        if tick.gap and gaps and gaps[-1][1] == k - 1:
            gaps[-1][1] = k
        elif tick.gap:
            gaps.append([k, k])
    return [tuple(g) for g in gaps]


def bad(row):
    return row["loop_closed"] == 0 or row.get("valid", 1) == 0


def bias_zero_hz(row, settings):
    """Bias frequency at zero detuning and the temperature of this half."""
    warmth = row.get("temperature_c", settings.reference_temperature_c) - settings.reference_temperature_c
    return settings.bias_hz * (1.0 + settings.bias_temperature_coefficient_per_c * warmth)


def helicity_sign(first):
    return first["bias_sign"] * first["mode"]


def deficit_hz(rows, tick, settings):
    """f_i - f0, negative where the bias is weakened by detuning."""
    first, second = rows[2 * tick], rows[2 * tick + 1]
    return helicity_sign(first) * (first["counts"] - second["counts"]) / settings.tick_s - bias_zero_hz(first, settings)


def root_q(rows, one, i, settings):
    """q of eq (11) from tick i >= 2, where tick 1 is `one`; None where the data do not allow it."""
    begin, now = deficit_hz(rows, one, settings), deficit_hz(rows, one + i - 1, settings)
    if not (begin != 0.0 and 0.0 < now / begin < 1.0):
        return None
    return (now / begin) ** (1.0 / (2 * (i - 1)))


def drift_hz(rows, ticks, one, i, settings):
    """False drift of tick i after a gap (tick 1 is `one`), for bias + first; None: not usable."""
    tick = one + i - 1
    first, second = rows[2 * tick], rows[2 * tick + 1]
    f0 = bias_zero_hz(first, settings)
    if settings.relock == "frequency":
        if i == 1 and (one + 1 >= len(ticks) or ticks[one + 1].gap):
            return None
        q = root_q(rows, one, max(i, 2), settings)
        return None if q is None else deficit_hz(rows, tick, settings) * (1.0 - q) / (1.0 + q)
    if settings.relock == "detuning":
        d1, d2 = first["detuning_lambda"], second["detuning_lambda"]
        if not (math.isfinite(d1) and math.isfinite(d2) and d1 != 0.0 and 0.0 < d2 / d1 < 1.0):
            return None
        return settings.bias_chi * f0 / 4.0 * math.log(d2 / d1) * (d1 + d2) ** 2
    m1, m2 = first["detuning_sq_lambda2"], second["detuning_sq_lambda2"]
    if not (math.isfinite(m1) and math.isfinite(m2)):
        return None
    return settings.bias_chi * f0 / 2.0 * (m2 - m1)


def correct_relock(rows, ticks, gaps, settings):
    """Sets final and dtheta of the measured ticks; returns what tick 1 of `frequency` has still to correct, by gap."""
    late = {}
    for tick in ticks:
        tick.final = tick.dtheta = tick.raw
    if settings.relock == "none":
        return late
    for gap in gaps:
        one = gap[1] + 1
        for i in range(1, settings.relock_ticks + 1):
            k = one + i - 1
            if k >= len(ticks) or ticks[k].gap:
                break
            drift = drift_hz(rows, ticks, one, i, settings)
            if drift is None:
                ticks[k].relock_uncorrected = True
                continue
            false_angle = Fraction(helicity_sign(rows[2 * k]) * settings.scale_arcsec * settings.tick_s * drift)
            ticks[k].relock_corrected = True
            ticks[k].final = ticks[k].raw - false_angle
            if settings.relock == "frequency" and i == 1:
                late[gap] = -false_angle
            else:
                ticks[k].dtheta = ticks[k].final
    return late


def measured(ticks, first, last):
    return [k for k in range(max(first, 0), min(last, len(ticks) - 1) + 1) if not ticks[k].gap]


def extrapolate(ticks, gap, history, order):
    """Eq (14): dtheta of the gap. Beyond the longest bridged gap the mean of the points, without a point zero."""
    for k in range(gap[0], gap[1] + 1):
        if not history:
            ticks[k].dtheta = Fraction(0)
            continue
        used = order if k - gap[0] < LONGEST_BRIDGED else 0
        ticks[k].dtheta = fit(ticks, history, k, used)


def finish(ticks, gap, settings, history):
    """Eq (15): final of the gap, from both sides where there are two. Returns the points and whether both sides serve."""
    first, last = gap
    before = measured(ticks, first - settings.points_before, first - 1)
    after = measured(ticks, last + 1, last + settings.points_after)
    order = ORDER[settings.bridge]
    if last - first + 1 > LONGEST_BRIDGED or not (history or after):
        for k in range(first, last + 1):
            ticks[k].final = fit(ticks, history, k, 0) if history else Fraction(0)
            ticks[k].unrepaired = True
        return [], False
    if not after:
        for k in range(first, last + 1):
            ticks[k].final = ticks[k].dtheta
        return history, False
    both = bool(before)
    points = before + after if both else measured(ticks, last + 1, last + settings.extrapolation_points)
    for k in range(first, last + 1):
        ticks[k].final = fit(ticks, points, k, order)
        ticks[k].interpolated = both
    return points, both


def bridge(ticks, gap, settings):
    """Fills one gap and says how its order was kept."""
    order = ORDER[settings.bridge]
    history = measured(ticks, gap[0] - settings.extrapolation_points, gap[0] - 1)
    extrapolate(ticks, gap, history, order)
    points, _ = finish(ticks, gap, settings, history)
    final_lowered = bool(points) and order > len(points) - 1
    causal_lowered = order > len(history) - 1
    for k in range(gap[0], gap[1] + 1):
        ticks[k].extrapolated = True if history else None
        if ticks[k].unrepaired:
            ticks[k].lower_order = None
        else:
            ticks[k].lower_order = True if final_lowered else (None if causal_lowered else False)


def correction_tick(ticks, gap, settings):
    """j = n + 1 + points_after, later at a log's start, and after the next gap if it falls into one; None: never."""
    reach = settings.points_after
    if gap[0] == 0:
        reach = max(reach, settings.extrapolation_points)
    waiting = measured(ticks, gap[1] + 1 + reach, len(ticks) - 1)
    return waiting[0] if waiting else None


def compensate(rows, settings):
    """Every tick of the log as the contract wants it; an odd last half is dropped."""
    ticks = []
    for first, second in zip(rows[0::2], rows[1::2]):
        counts = first["counts"] + second["counts"]
        ticks.append(Tick(raw=Fraction(settings.scale_arcsec) * counts, gap=bad(first) or bad(second)))
    gaps = find_gaps(ticks)
    late = correct_relock(rows, ticks, gaps, settings)
    correction_due = [(gap[0], correction_tick(ticks, gap, settings)) for gap in gaps]
    for gap in gaps:
        if settings.bridge != "none":
            bridge(ticks, gap, settings)
        lump = sum(ticks[k].final - ticks[k].dtheta for k in range(gap[0], gap[1] + 1)) + late.get(gap, 0)
        target = correction_tick(ticks, gap, settings)
        if target is not None:
            ticks[target].lump += lump
            ticks[target].correction = True
    for k, tick in enumerate(ticks):
        tick.dtheta += tick.lump
        tick.settled = not any(begin <= k and (due is None or due > k) for begin, due in correction_due)
    return ticks
