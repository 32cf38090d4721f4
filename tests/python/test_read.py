"""zlg.read: files of other programs, by the rules of `zlg import`."""

import json
import os
import subprocess

import h5py
import numpy as np
import pytest

import zlg
from conftest import ROOT

ZLG = os.environ.get("ZLG", ROOT / "build" / "release" / "bin" / "zlg")


def rates(n=6000, mean=15.04, seed=3):
    return np.random.default_rng(seed).normal(mean, 3.0, n)


def by_program(path, *said):
    return json.loads(subprocess.run([ZLG, "analyze", path, *said, "--json"], capture_output=True, text=True, check=True).stdout)["axes"][0]


def test_a_text_says_all_by_its_names_and_analyze_takes_it(tmp_path):
    path = tmp_path / "lab.csv"
    path.write_text("t_s;w [°/h]\n" + "".join(f"{k / 100:.2f};{w:.6f}\n".replace(".", ",") for k, w in enumerate(rates())))
    (axis,) = zlg.read(path)
    assert axis.rate_hz == 100 and axis.rates_arcsec_s.shape == (6000,) and not axis.warnings
    found = zlg.analyze([axis]).axes[0]
    same = by_program(path)
    assert (found.n_samples, found.n_known) == (same["samples"], same["known"])
    assert found.mean_arcsec_s == same["mean_rate_arcsec_s"]


def test_what_is_open_is_asked_for_with_its_keys(tmp_path):
    path = tmp_path / "ns.h5"
    with h5py.File(path, "w") as file:
        file["t"] = 1_700_000_000_000_000_000 + np.arange(6000) * 500_000
        file["w"], file["temperature"] = rates(), rates(seed=4)
    with pytest.raises(zlg.MappingError, match="axis=.*unit=.*holds=.*time_unit="):
        zlg.read(path)
    (axis,) = zlg.read(path, axis="w", unit="deg/h", holds="rate", time_unit="ns")
    assert axis.rate_hz == pytest.approx(2000, rel=1e-9)
    np.testing.assert_array_equal(axis.rates_arcsec_s, rates())
    assert len(zlg.read(path, axis=["w", "temperature"], unit="deg/h", holds="rate", time_unit="ns")) == 2
    with pytest.raises(zlg.MappingError, match="did you mean 'unit'"):
        zlg.read(path, units="deg/h")


def test_holes_modes_and_warnings_come_along(tmp_path):
    path = tmp_path / "m.csv"
    n = np.delete(np.arange(6000), slice(1000, 1020))
    mode = np.where(n // 600 % 2 == 0, 1, -1)
    rows = zip(n % 256, np.repeat(rates(), 5)[: len(n)] + mode, mode)
    path.write_text("counter,w_dph,state\n" + "".join(f"{c},{w:.6f},{m}\n" for c, w, m in rows))
    with pytest.warns(UserWarning, match="stands 5 times"):
        (axis,) = zlg.read(path, rate_hz=100, axis="w_dph", mode="state")
    assert np.flatnonzero(np.isnan(axis.rates_arcsec_s)).tolist() == list(range(1000, 1020))
    result = zlg.analyze([axis]).axes[0]
    assert result.warnings == axis.warnings and result.modes is not None


def test_logs_of_our_own_and_raw_files(tmp_path):
    raw = zlg.simulate(zlg.Config.of("run.duration_s=2")).raw
    zlg.logs.write_raw(tmp_path / "raw.h5", raw)
    np.testing.assert_array_equal(zlg.read(tmp_path / "raw.h5").counts, raw.counts)
    zlg.logs.write_angles(tmp_path / "a.csv", zlg.compensate(raw))
    assert isinstance(zlg.read(tmp_path / "a.csv"), zlg.logs.AngleLog)
    with h5py.File(tmp_path / "own.h5", "w") as file:
        file["N"], file["dir"], file["m"] = raw.counts, raw.bias_sign, raw.mode
    own = zlg.read(tmp_path / "own.h5", counts="N", bias_sign="dir", mode="m", loop_closed="always:1", scale_arcsec=3.263, tick_s=0.005)
    np.testing.assert_array_equal(own.counts, raw.counts)
    assert own.config.gyro.tick_s == 0.005
