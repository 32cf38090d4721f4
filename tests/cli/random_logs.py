"""Random raw logs: any motion, gaps anywhere, re-lock transients with noise, so that every branch of the contract occurs."""

import math

from oracle import ORDER, Settings
from support import OPTIONAL, columns_of


def random_gaps(rng, n_ticks, longest=10):
    """Ticks that are gaps: clusters, single ticks, the log's start and end."""
    gaps = set()
    for _ in range(rng.randint(1, 6)):
        first = rng.randrange(n_ticks)
        for _ in range(rng.choice([1, 1, 2, 3])):
            length = rng.randint(1, longest)
            gaps.update(range(first, min(first + length, n_ticks)))
            first += length + rng.randint(1, 6)
    if rng.random() < 0.35:
        gaps.update(range(rng.randint(1, longest)))
    if rng.random() < 0.35:
        gaps.update(range(n_ticks - rng.randint(1, longest), n_ticks))
    return split_long(gaps, n_ticks, longest)


def split_long(gaps, n_ticks, longest):
    """Opens one tick wherever overlapping gaps have grown beyond `longest`."""
    run = 0
    for k in range(n_ticks):
        run = run + 1 if k in gaps else 0
        if run > longest:
            gaps.discard(k)
            run = 0
    return gaps


def random_settings(rng, relock, bridge):
    """Settings with nothing at a round value, so that no comparison of the re-lock formulas is a tie."""
    order = ORDER.get(bridge, 0)
    points_before = rng.randint(1, 4)
    return Settings(
        tick_s=rng.choice([0.005, 0.0025, 0.01]),
        scale_arcsec=rng.choice([3.263, 0.7123, 0.05]) * rng.uniform(0.9, 1.1),
        bias_hz=60e3 * rng.uniform(0.9, 1.1),
        bias_chi=rng.uniform(1.0, 6.0),
        reference_temperature_c=rng.uniform(-10.0, 40.0),
        bias_temperature_coefficient_per_c=rng.choice([0.0, rng.uniform(-1e-4, 1e-4)]),
        relock=relock,
        relock_ticks=rng.randint(2, 25),
        bridge=bridge,
        extrapolation_points=rng.randint(order + 1, 8),
        points_before=points_before,
        points_after=rng.randint(max(1, order + 1 - points_before), 4),
    )


class Motion:
    """A rate in arcsec/s: constant, sine, and steps."""

    def __init__(self, rng):
        self.offset = rng.uniform(-5000.0, 5000.0)
        self.amplitude = rng.uniform(0.0, 12000.0)
        self.omega = 2.0 * math.pi * rng.uniform(0.5, 20.0)
        self.phase = rng.uniform(0.0, 6.28)

    def angle(self, t0, t1):
        swing = math.cos(self.omega * t0 + self.phase) - math.cos(self.omega * t1 + self.phase)
        return self.offset * (t1 - t0) + self.amplitude * swing / self.omega


def random_log(rng, settings, gaps, n_ticks):
    """Rows with every column; loop or light fails in either half of a gap tick, or in both."""
    motion = Motion(rng)
    first_sign, mode, temperature = rng.choice([1, -1]), rng.choice([1, -1]), rng.uniform(-20.0, 60.0)
    miss, since, half_s = 0.0, 0.0, settings.tick_s / 2.0
    tau = settings.tick_s * rng.uniform(1.5, 5.0)
    rows, broken = [], {}
    for half in range(2 * n_ticks):
        k, begins = half // 2, half % 2 == 0
        if begins and k in gaps:
            if k - 1 not in gaps:
                temperature = rng.uniform(-20.0, 60.0)
                mode = rng.choice([mode, -mode])
                miss = rng.uniform(-0.25, 0.25)
            since = 0.0
            broken = rng.choice([{0: "loop"}, {1: "loop"}, {0: "loop", 1: "loop"}, {0: "light"}, {1: "light"},
                                 {0: "light", 1: "loop"}])
        fails = broken.get(half % 2) if k in gaps else None
        detuning = miss * math.exp(-since / tau)
        since += 0.0 if k in gaps else half_s
        sign = first_sign if begins else -first_sign
        warm = 1.0 + settings.bias_temperature_coefficient_per_c * (temperature - settings.reference_temperature_c)
        mean, square = detuning + rng.gauss(0.0, 0.004), detuning**2 + abs(rng.gauss(0.0, 0.0005)) + 1e-9
        bias = sign * mode * settings.bias_hz * warm * (1.0 - settings.bias_chi * detuning**2) * half_s
        turned = motion.angle(half * half_s, (half + 1) * half_s) / settings.scale_arcsec
        counts = round(bias + turned + rng.uniform(-0.5, 0.5))
        if fails:
            counts = rng.choice([0, counts, rng.randint(-10000, 10000)])
        rows.append({"half": half, "bias_sign": sign, "mode": mode, "counts": counts,
                     "loop_closed": 0 if fails == "loop" else 1, "valid": 0 if fails == "light" else 1,
                     "detuning_lambda": mean, "detuning_sq_lambda2": square, "piezo_v": rng.uniform(0.0, 200.0),
                     "temperature_c": temperature})
    return rows


def drop_columns(rng, rows, needed):
    """Leaves out optional columns that this method does not read; a log without `valid` has no failures of light."""
    light_failed = any(row["valid"] == 0 for row in rows)
    kept = set(needed) | ({"valid"} if light_failed else set())
    for name in OPTIONAL:
        if name not in kept and rng.random() < 0.5:
            for row in rows:
                del row[name]
    columns = columns_of(rows)
    rng.shuffle(columns)
    return columns
