"""Sweeps from Python: the rows of the file as a data frame."""

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
