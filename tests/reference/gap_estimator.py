"""The estimate of a switch in NumPy, with whole matrices over half-ticks: what `estimate` of the core is held against.

Observed is, for each half, y = motion + sign of the bias * its error - false angle + rounding at its end - rounding at its start.
Rows of the window are stretches of halves, of which some were read. Wanted is the motion of the rows that are wanted and were not read,
less the errors of those that are wanted and were.

    V  = C + E + D R D^T          C motion, learnt; E false angles (light, scale of chi f0) and bias; R roundings
    V_m = V + s_m^2 K_m           a bank: nothing, or a random walk (of the slope of the rate, of the slope of that)
    GLS with an unknown constant rate for each member; weights by restricted likelihood and prior; moments of the mixture

Here every kernel is integrated numerically, every covariance of halves is a matrix, and rows are sums over it. The core has closed
forms, rows alone, and one packed triangle. The sources of the method stand in src/core/compensation/estimate/.
"""

from dataclasses import dataclass, field

import numpy as np

EVERYWHERE = lambda lo, hi, length: (0, length)
BESIDE = lambda halves: lambda lo, hi, length: (lo - halves, hi + halves)
AFTER = lambda halves: lambda lo, hi, length: (hi + halves, length)
BANK = [(2, EVERYWHERE), (3, EVERYWHERE), (2, BESIDE(4)), (2, BESIDE(8)), (2, BESIDE(16)), (2, AFTER(2))]
SIZES = 10.0 ** np.arange(-0.5, 11.6, 1.5)
SHARES = 0.8, 0.4, 0.2, 0.1, 0.05, 0.02, 0.0
KNOTS = np.r_[np.arange(17), 20, 24, 28, 34, 40]
SMOOTHINGS = 10.0 ** np.arange(-3, 8, 2)


@dataclass
class Gyro:
    """Units: arcsec a count, Hz, 1, wavelengths, s, arcsec/sqrt(s); noise of a place within the fringe, counts rms, or None."""

    scale: float = 3.263
    bias: float = 60e3
    chi: float = 3.6
    light_noise: float = 0.0033
    tick_s: float = 0.005
    random_walk: float = 0.14
    fringe_noise: float | None = None


@dataclass
class Window:
    """rows: (first half, last, read, wanted) without a hole; y, sign: of each half; light: halves x samples after `gap[1]`."""

    rows: list
    gap: tuple
    y: np.ndarray
    sign: np.ndarray
    light: np.ndarray = field(default_factory=lambda: np.zeros((0, 0)))
    error_var: np.ndarray | None = None  # of each row, beyond all else; and the deviation of an error that rows have in common
    common: np.ndarray | None = None
    magnetic_variance: float = 0.0  # of the drift in a tick, that changes its sign at the gap


def is_positive(c):
    try:
        return np.linalg.cholesky(c) is not None
    except np.linalg.LinAlgError:
        return False


def basis(knots, t):
    """Cubic B-splines at the times t by their recurrence: times x terms."""
    k = np.r_[[knots[0]] * 3, knots, [knots[-1]] * 3].astype(float)
    t = np.clip(t, k[0], k[-1] - 1e-9)[:, None]
    b = ((t >= k[:-1]) & (t < k[1:])).astype(float)
    for order in (1, 2, 3):
        with np.errstate(divide="ignore", invalid="ignore"):
            rise = np.nan_to_num((t - k[: -order - 1]) / (k[order:-1] - k[: -order - 1]), posinf=0, neginf=0)
            fall = np.nan_to_num((k[order + 1 :] - t) / (k[order + 1 :] - k[1:-order]), posinf=0, neginf=0)
        b = rise * b[:, :-1] + fall * b[:, 1:]
    return b


def roughness(knots):
    """Integral of (1 + t)^3 times the square of the third derivative, the weight in the middle of each interval, as a matrix of the terms."""
    k = np.r_[[knots[0]] * 3, knots, [knots[-1]] * 3].astype(float)
    terms = np.eye(len(knots) + 2)
    for order in (3, 2, 1):  # the coefficients of a derivative are divided differences of those before it
        k = k[1:-1]
        terms = order * np.diff(terms, axis=0) / (k[order:] - k[:-order])[:, None]
    width, middle = np.diff(knots), np.add(knots[1:], knots[:-1]) / 2
    return terms.T @ (((1 + middle) ** 3 * width)[:, None] * terms)


def light_angles(light, light_noise):
    """Mean square of the detuning in each half, and its covariance, from a spline through halves x samples."""
    halves, samples = light.shape
    knots = KNOTS
    design = basis(knots, (np.arange(halves * samples) + 0.5) / samples)
    x, w = np.polynomial.legendre.leggauss(4)
    products = np.array([sum(0.5 * wi * np.outer(b, b) for wi, b in zip(w, basis(knots, h + 0.5 + 0.5 * x))) for h in range(halves)])
    normal, moment = design.T @ design, design.T @ light.ravel()
    n_free = light.size - len(moment)
    left = light.ravel() - design @ np.linalg.lstsq(design, light.ravel(), rcond=None)[0]
    variance = max(light_noise**2, left @ left / n_free if n_free > 0 else 0.0)
    rough = roughness(knots)

    def likelihood(g):
        matrix = normal + g * rough
        explained = moment @ np.linalg.solve(matrix, moment)
        wide = (len(moment) - 3) * np.log(g) - np.linalg.slogdet(matrix)[1]
        return (wide - (light.ravel() @ light.ravel() - explained) / variance) / 2

    inverse = np.linalg.inv(normal + max(SMOOTHINGS, key=likelihood) / 100 * rough)
    c, cov = inverse @ moment, variance * inverse
    q_c, q_cov = products @ c, products @ cov
    mean_sq = q_c @ c - np.einsum("kii->k", q_cov)
    covariance = 4 * q_c @ cov @ q_c.T
    covariance += 2 * q_cov.reshape(halves, -1) @ q_cov.transpose(0, 2, 1).reshape(halves, -1).T
    return mean_sq, covariance


def rounding_law(turn_counts, scatter_counts2):
    """Covariance, counts^2, of two roundings of a free-running counter that turned by so many counts between them."""
    x = turn_counts - np.floor(turn_counts)
    return (x * x - x + 1 / 6) / 2 * np.exp(-2 * np.pi**2 * np.maximum(scatter_counts2, 0))


def walk(halves, kind, first, last):
    """Covariance of the halves under a random walk of the slope of the rate (2), the slope of that (3), from `first` to `last`."""
    x, w = np.polynomial.legendre.leggauss(4)
    q = (np.arange(halves)[:, None] + 0.5 + 0.5 * x).ravel()
    w = np.tile(0.5 * w, halves) * ((q >= first) & (q < last))
    t = np.arange(halves)[:, None]
    a = ((t + 1 - q).clip(0) ** kind - (t - q).clip(0) ** kind) / kind
    return (a * w) @ a.T


def member_kernel(length, gap, kind, where):
    k = walk(length, kind, *where(*gap, length))
    if where is EVERYWHERE:
        k = (k + k[::-1, ::-1]) / 2
    unit = k[length // 2, length // 2] if where is EVERYWHERE else k.diagonal().max()
    return k / unit if unit > 0 else None


def motion_covariance(gyro, moments, windows, sums, reading_var):
    """The learnt moments, of which the largest share of the roundings is taken out that leaves the rows `sums` a covariance."""
    n = len(moments)
    learnt = moments / max(windows, 1)
    second = 2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
    least = (0.01 * reading_var + gyro.random_walk**2 * gyro.tick_s / 2 + 1e-13 * learnt.trace()) * np.eye(n)
    for share in SHARES:
        c = learnt - share * reading_var * second + least
        if is_positive(sums @ c @ sums.T):
            break
    return c


def roundings(gyro, window, rate, turned, covariance, reading_var):
    """Covariance of the roundings at the borders of halves; none between two stretches without a reading in between, and none at a border
    that was not read."""
    n = len(window.sign)
    is_read = np.zeros(n + 1)
    for first, last, read, _ in window.rows:
        if read:
            is_read[first : last + 1] = 1
    if gyro.fringe_noise is not None:
        return reading_var * np.diag(is_read)
    bias = gyro.bias * gyro.scale * gyro.tick_s / 2
    place = (rate * np.arange(n + 1) + np.r_[0, np.cumsum(window.sign) * bias - np.cumsum(turned)]) / gyro.scale
    summed = np.zeros((n + 1, n + 1))
    summed[1:, 1:] = covariance.cumsum(0).cumsum(1)
    d = np.diag(summed)
    scatter = (d[:, None] + d - 2 * summed) / gyro.scale**2
    r = gyro.scale**2 * rounding_law(place[:, None] - place, scatter)
    stretch = np.zeros(n + 1)
    for first, last, read, _ in window.rows:
        if not read:
            stretch[last:] += 1
    return r * (stretch[:, None] == stretch) * np.outer(is_read, is_read)


def estimate(gyro, window, moments, windows, scale=0.0, scale_var=0.01, bank=BANK):
    """Angle of the wanted rows, its variance, and the scale of chi f0 with its variance."""
    n = len(window.sign)
    lo, hi = window.gap
    reading_var = gyro.scale**2 * (1 / 12 if gyro.fringe_noise is None else gyro.fringe_noise**2 + 1 / 12 / 65536**2)
    bias = gyro.bias * gyro.scale * gyro.tick_s / 2
    sums = np.array([[first <= h < last for h in range(n)] for first, last, _, _ in window.rows], float)
    read = np.array([r[2] for r in window.rows])
    wanted = np.array([r[3] for r in window.rows])
    is_read = sums[read].sum(0)
    d, errors = np.zeros(n), np.zeros((n, n))
    if window.light.size:
        lit = slice(hi, hi + len(window.light))
        mean_sq, cov = light_angles(window.light, gyro.light_noise)
        k = gyro.chi * bias
        d[lit] = k * mean_sq * window.sign[lit]
        errors[lit, lit] = k * k * cov * np.outer(window.sign[lit], window.sign[lit])
        errors += np.outer(d, d) * scale_var
    side = np.r_[np.zeros(lo), np.ones(n - lo)]
    errors += np.outer(window.sign, window.sign) * (1e-4 * bias) ** 2 * (side[:, None] == side)
    if window.common is not None:  # a row's own error, in its first half: only sums over rows are seen
        first = [row[0] for row in window.rows]
        errors[np.ix_(first, first)] += np.diag(window.error_var) + np.outer(window.common, window.common)
    errors *= np.outer(is_read, is_read)
    magnetic = np.where(side > 0, 0.5, -0.5) * is_read
    y = (window.y + (1 + scale) * d) * is_read
    motion = motion_covariance(gyro, moments, windows, sums, reading_var) + window.magnetic_variance * np.outer(magnetic, magnetic)
    z, width = sums @ y, sums.sum(1)
    rate = z[read].sum() / width[read].sum()
    step = np.eye(n, n + 1, k=1) - np.eye(n, n + 1)
    law = roundings(gyro, window, rate, (1 + scale) * d, motion + errors, reading_var)
    base = motion + step @ law @ step.T
    in_gap, corrected = sums[wanted & ~read].sum(0), sums[wanted & read].sum(0)
    points = sums[read]
    unit = (np.linalg.cholesky(points @ (base + errors) @ points.T).diagonal() ** 2).min()
    kernels = [k for k in (member_kernel(n, window.gap, kind, where) for kind, where in bank) if k is not None]
    found = []
    for k in [None] + [k * (s * unit) for k in kernels for s in SIZES]:
        v = base if k is None else base + k
        cov = points @ (v + errors) @ points.T
        factor = np.linalg.cholesky(cov + 2e-15 * cov.trace() * np.eye(len(cov)))
        with_wanted = points @ (v @ in_gap - errors @ corrected)
        columns = np.c_[width[read], (z - rate * width)[read], with_wanted, -scale_var * (points @ d)]
        g = np.linalg.solve(factor, columns)
        g = g.T @ g
        level = g[0, 1] / g[0, 0]
        evidence = -0.5 * (g[1, 1] - level * g[0, 1] + np.log(g[0, 0])) - np.log(factor.diagonal()).sum()
        variance = in_gap @ v @ in_gap + corrected @ errors @ corrected - g[2, 2] + (in_gap.sum() - g[0, 2]) ** 2 / g[0, 0]
        found.append((evidence, in_gap.sum() * level + g[1, 2] - level * g[0, 2], variance,
                      g[1, 3] - level * g[0, 3], scale_var - g[3, 3] + g[0, 3] ** 2 / g[0, 0]))
    evidence, angle, variance, shift, shift_var = np.array(found).T
    of_learnt = 0.5 if windows >= 25 else 0.05
    weight = np.r_[of_learnt, np.full(len(found) - 1, (1 - of_learnt) / max(len(bank) * len(SIZES), 1))] * np.exp(evidence - evidence.max())
    weight /= weight.sum()
    mixed = lambda m, v: (weight @ m, weight @ (v + (m - weight @ m) ** 2))
    (mean, var), (moved, moved_var) = mixed(angle, variance), mixed(shift, shift_var)
    return mean + in_gap.sum() * rate + z[wanted & read].sum(), var, scale + moved, min(moved_var, scale_var) + 1e-8
