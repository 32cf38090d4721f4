"""Random gyros as settings of the program, for runs that must give the same bits everywhere."""

import random

# Key, and how a value is drawn. What is left out keeps its default.
CHOICES = {
    "gyro.readout": lambda r: r.choice(["count", "phase"]),
    "gyro.light_samples": lambda r: r.choice([8, 16, 24, 64]),
    "gyro.light_noise_lambda": lambda r: r.uniform(0.0, 0.006),
    "gyro.tick_s": lambda r: r.choice([0.004, 0.005, 0.006]),
    "gyro.scale_arcsec": lambda r: r.uniform(0.8, 4.0),
    "gyro.bias_chi": lambda r: r.uniform(2.0, 5.0),
    "gyro.temperature_rise_c": lambda r: r.uniform(-30.0, 30.0),
    "gyro.bias_temperature_coefficient_per_c": lambda r: r.uniform(-1e-4, 1e-4),
    "drift.magnetic_arcsec_s": lambda r: r.uniform(-2.0, 2.0),
    "drift.thermal_time_s": lambda r: r.uniform(100.0, 5000.0),
    "perimeter.tau_s": lambda r: r.uniform(0.004, 0.012),
    "perimeter.miss_lambda": lambda r: r.choice([0.0, 0.1, 0.22]),
    "piezo.half_wave_v": lambda r: r.uniform(35.0, 50.0),
    "piezo.hysteresis": lambda r: r.choice([0.0, 0.05]),
    "piezo.creep_per_decade": lambda r: r.choice([0.0, 0.01]),
    "piezo.mirror_hz": lambda r: r.choice([0.0, 4000.0]),
    "switching.schedule": lambda r: r.choice(["fixed", "measured"]),
    "compensation.relock": lambda r: r.choice(["frequency", "detuning", "mean_square", "joint"]),
    "compensation.bridge": lambda r: r.choice(["linear", "quadratic", "auto"]),
    "compensation.magnetic": lambda r: r.choice(["none", "estimate"]),
    "motion.amplitude_arcsec_s": lambda r: r.uniform(0.0, 2e5),
    "motion.frequency_hz": lambda r: r.uniform(0.1, 40.0),
}
EACH_KEY = 0.4  # the part of the gyros that have a value of their own


# Fidelity, perimeter loop, shifted reversals (of fidelity `laser` only) and faults take turns, so that the first three gyros have all of
# them and twelve have every combination.
COMBINATIONS = [
    ("averaged", "digital", "none", 600), ("laser", "analog", "auto", 600), ("averaged", "analog", "none", 0), ("laser", "digital", "none", 0),
    ("averaged", "analog", "none", 600), ("laser", "digital", "auto", 600), ("averaged", "digital", "none", 0), ("laser", "analog", "none", 0),
    ("laser", "analog", "none", 600), ("laser", "digital", "none", 600), ("laser", "analog", "auto", 0), ("laser", "digital", "auto", 0),
]


def random_gyros(n, duration_s, seed=1):
    """Settings of n gyros of this duration, a list of `key=value` each."""
    r = random.Random(seed)
    gyros = []
    for k in range(n):
        fidelity, loop, dither, per_hour = COMBINATIONS[k % len(COMBINATIONS)]
        gyro = [f"run.duration_s={duration_s}", f"run.seed={r.randrange(1, 2**31)}", f"switching.interval_s={r.uniform(1.0, 4.0)!r}",
                f"gyro.fidelity={fidelity}", f"perimeter.loop={loop}", f"gyro.dither={dither}", f"faults.random_per_hour={per_hour}",
                f"faults.random_seed={r.randrange(1, 1000)}"]
        gyro += [f"{key}={draw(r)}" for key, draw in CHOICES.items() if r.random() < EACH_KEY]
        gyros.append(gyro)
    return gyros
