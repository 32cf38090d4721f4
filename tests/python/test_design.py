"""Theory for the designer."""

import numpy as np
import pytest

import zlg
from zlg import design

CONFIG = zlg.Config.of("design.switch_error_arcsec=2", "drift.magnetic_thermal_arcsec_s=0")


def test_the_best_interval_of_a_gyro_that_does_not_warm_up():
    best = design.optimum(3600.0, CONFIG)
    assert best.interval_s == pytest.approx(np.sqrt(2.0 * 3600.0 / 0.7), rel=1e-6)  # sqrt(dP t/Om)
    around = design.drift_arcsec_s(best.interval_s * np.array([0.9, 1.0, 1.1]), 3600.0, CONFIG)
    assert around[1] == pytest.approx(best.drift_arcsec_s) and around[1] == around.min()


def test_a_constant_follows_a_constant_rate_and_lags_a_slow_sine():
    assert design.substitution_response(0.0) == pytest.approx(0.0, abs=1e-15)
    f, tick_s = 0.1, 0.005
    expected = tick_s * (2 * np.pi * f * tick_s) ** 2 * 3 * 5 * 7 / 12  # A T (w T)^2 n (n+2)(n+4)/12
    assert design.substitution_response(f, order=0) == pytest.approx(expected, rel=1e-4)


def test_the_whole_design():
    result = design.design_gyro()
    assert result.stable and 30 < result.phase_margin_deg < 90
    assert {line.method for line in result.intervals} >= {"corrected", "worst_case"}
    assert "<html" in result.page


def test_relock_ends_at_the_centre():
    loop = design.relock()
    assert loop.detuning_lambda[0] == pytest.approx(0.22)
    assert abs(loop.detuning_lambda[-1]) < 1e-3 and loop.false_drift_arcsec_s.shape == (20,)


def test_a_requirement_is_a_call_of_the_module(tmp_path):
    path = tmp_path / "require.toml"
    path.write_text(
        "[require]\nrun_s = 40\nangle_error_arcsec = 30\nconfidence = 0.8\ngyros = 20\n"
        '[motion]\nkind = "rest"\n[switching]\nschedule = "fixed"\n[compensation]\nmagnetic = "none"\n'
    )
    found = zlg.design(require=path)
    assert found.met and found.probability >= 0.8 and found.gyros == 20
    assert found.choice["switching"]["interval_s"] <= 40 and found.reasons and "<svg" in found.page
    (tmp_path / "chosen.toml").write_text(found.toml)
    assert zlg.Config.load(tmp_path / "chosen.toml").switching.interval_s == found.choice["switching"]["interval_s"]
    with pytest.raises(zlg.ConfigError, match="run_s = 0"):
        zlg.design(require="[require]\nrun_s = 0\n")


def test_errors_are_told():
    with pytest.raises(zlg.DesignError, match="allowed are corrected"):
        design.optimum(method="best")
    with pytest.raises(zlg.DesignError):
        design.drift_arcsec_s(7200.0, 3600.0)
    with pytest.raises(zlg.DesignError):
        design.substitution_response(1.0, order=9)
