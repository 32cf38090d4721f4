"""Sweeps from Python: the rows of the file as a data frame; Sobol's indices against known functions and OpenTURNS."""

import numpy as np
import pytest

import zlg

SWEEP = """
sweep = {gyros = 6, seed = 3, duration_s = 5}
base.switching.interval_s = 2
parameter = [
    {keys = ["gyro.bias_chi"], draw = "uniform", min = 3.4, max = 3.8},
    {keys = ["compensation.relock"], draw = "list", values = ["mean_square", "none"]},
]
metric = [{name = "configured.switch_error_rms_arcsec"}]
"""


def test_gives_rows_that_run_repeats(tmp_path):
    reported = []
    frame = zlg.sweep(SWEEP, tmp_path / "r.h5", threads=2, progress=reported.append)
    assert list(frame.index) == list(range(6))
    assert reported[-1] == 1.0 and len(reported) == 6
    assert frame.attrs["units"]["configured.switch_error_rms_arcsec"] == "arcsec"
    row = frame.loc[3]
    config = zlg.Config.of("run.duration_s=5", "switching.interval_s=2", f"run.seed={row['seed']}",
                           f"gyro.bias_chi={float(row['gyro.bias_chi'])!r}", f"compensation.relock={row['compensation.relock']}")
    alone = zlg.run(config, angles=False)
    assert alone.fingerprint == row["fingerprint"]
    assert alone["configured"].switch_rms_arcsec == row["configured.switch_error_rms_arcsec"]


def test_reads_what_was_written_and_parts_of_it(tmp_path):
    frame = zlg.sweep(SWEEP, tmp_path / "r.h5")
    again = zlg.read_sweep(tmp_path / "r.h5")
    assert again.equals(frame)
    part = zlg.sweep(SWEEP, tmp_path / "part.h5", part=(2, 3))
    assert list(part.index) == [1, 4]
    assert part.equals(frame.loc[[1, 4]])


def test_takes_a_file_and_names_it(tmp_path):
    path = tmp_path / "sweep.toml"
    path.write_text(SWEEP.replace("gyros = 6", "gyros = 0"))
    with pytest.raises(zlg.ConfigError, match="sweep.toml:2"):
        zlg.sweep(path, tmp_path / "r.h5")
    path.write_text(SWEEP)
    assert len(zlg.sweep(path, tmp_path / "r.h5")) == 6
    with pytest.raises(zlg.IoError, match="another sweep"):
        zlg.sweep(SWEEP.replace("seed = 3", "seed = 4"), tmp_path / "r.h5")
    with pytest.raises(ValueError, match="part"):
        zlg.sweep(path, tmp_path / "r.h5", part=(4, 3))


def saltelli(n, d, seed):
    """Blocks A, B, and A with one column of B."""
    chance = np.random.default_rng(seed)
    a, b = chance.uniform(-np.pi, np.pi, (2, n, d))
    mixed = []
    for k in range(d):
        mixed.append(a.copy())
        mixed[-1][:, k] = b[:, k]
    return np.concatenate([a, b, *mixed])


def ishigami(x):
    return np.sin(x[:, 0]) + 7 * np.sin(x[:, 1]) ** 2 + 0.1 * x[:, 2] ** 4 * np.sin(x[:, 0])


def test_indices_are_those_of_openturns():
    openturns = pytest.importorskip("openturns")
    samples = saltelli(500, 3, 2)
    values = ishigami(samples)
    theirs = openturns.JansenSensitivityAlgorithm(samples, values.reshape(-1, 1), 500)
    ours = zlg.sobol(samples, values)
    assert ours.first == pytest.approx(list(theirs.getFirstOrderIndices()), abs=1e-12)
    assert ours.total == pytest.approx(list(theirs.getTotalOrderIndices()), abs=1e-12)


def test_a_failed_run_drops_its_row_and_another_design_is_refused():
    samples = saltelli(64, 3, 3)
    values = ishigami(samples)
    values[70] = np.nan
    found = zlg.sobol(samples, values)
    assert (found.n_rows, found.n_dropped) == (63, 1)
    assert np.all(np.isfinite(found.first))
    with pytest.raises(ValueError, match="no design of Saltelli"):
        zlg.sobol(samples[::-1], values)
    with pytest.raises(ValueError, match="dimensions"):
        zlg.sobol(samples[:, 0], values)


def test_a_sweep_with_sensitivity_is_a_design(tmp_path):
    text = SWEEP.replace("gyros = 6", "gyros = 12, sensitivity = true").replace('"uniform"', '"sobol"')
    text = "".join(line for line in text.splitlines(True) if "compensation" not in line)
    frame = zlg.sweep(text, tmp_path / "r.h5", threads=2)
    found = zlg.sobol(frame[["gyro.bias_chi"]], frame["gyro.bias_chi"])
    assert found.n_rows == 4
    # Of a single input B and A_B are the same points: nothing is left beside it.
    assert found.first == pytest.approx([1.0], abs=1e-12)
