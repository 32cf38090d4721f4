"""How results show themselves, and what other libraries get of them."""

import matplotlib
import numpy as np
import pytest
import zlg

matplotlib.use("Agg")

CONFIG = zlg.Config.of("run.duration_s=60", "switching.interval_s=10")


@pytest.fixture(scope="module")
def result():
    return zlg.run(CONFIG, raw=True, page=True)


@pytest.fixture(scope="module")
def fit():
    noise = np.random.default_rng(1).normal(size=4000)
    return zlg.analysis.fit_noise(noise, rate_hz=200, data_type="rate", unit="deg/h")


def test_the_version_is_that_of_the_project():
    assert tuple(int(part) for part in zlg.__version__.split(".")) >= (0, 2, 0)


def test_a_configuration_is_the_call_that_makes_it():
    assert repr(zlg.Config()) == "zlg.Config.of()"
    made = zlg.Config.of('motion.kind="rest"', "perimeter.discriminator_signal=[0.1, 0.2]", "perimeter.discriminator_detuning_lambda=[0.1, 0.2]")
    assert eval(repr(made)) == made


def test_whatever_is_in_a_result_its_text_is_short(result, fit):
    curve = zlg.analysis.deviations_of_log(result.angles)
    for each in (result, result.raw, result.angles, result.switches, result["configured"], curve, fit, fit.terms, CONFIG):
        assert 0 < len(repr(each)) < 1200, type(each)
    assert "<12000: " in repr(result.angles)
    assert "angle_random_walk_arcsec_sqrt_s=0.07" in repr(fit.terms)  # 1 deg/h at 200 Hz: 1/sqrt(200) arcsec/sqrt(s)
    assert repr(zlg.analysis.NoiseTerms()) == "NoiseTerms()"


def test_plots_show_what_is_in_a_result(result, fit):
    lines = result.plot().get_lines()
    assert [line.get_label() for line in lines] == [variant.name for variant in result.variants]
    assert result.angles.plot().get_lines()[0].get_ydata()[-1] == result.angles.error_arcsec[-1]
    curve = zlg.analysis.deviations_of_log(result.angles)
    axes = curve.plot()
    assert axes.get_xscale() == axes.get_yscale() == "log"
    assert curve.plot(axes) is axes
    assert list(fit.plot().get_lines()[0].get_xdata()) == list(fit.tau_s)


def test_data_frames_hold_the_columns(result):
    pytest.importorskip("pandas")
    frame = result.angles.to_pandas()
    assert frame.index.name == "t_s" and frame.index[-1] == pytest.approx(60.0)
    assert list(frame["flags"]) == list(result.angles.flags)
    raw = result.raw.to_pandas()
    assert len(raw) == 24000 and "light_a" not in raw
    assert result.to_pandas().loc["configured", "switch_rms_arcsec"] == result["configured"].switch_rms_arcsec
    curve = zlg.analysis.deviations_of_log(result.angles).to_pandas()
    assert curve.index.name == "tau_s" and "deviation" in curve


@pytest.mark.parametrize("setting", ["gyro.scle_arcsec=1", "gyro.tick_s=-1", "noequals"])
def test_a_refused_setting_does_not_speak_of_the_command_line(setting):
    for call in (lambda: zlg.Config.of(setting), lambda: CONFIG.with_(setting)):
        with pytest.raises(zlg.ConfigError) as refused:
            call()
        assert "--" not in str(refused.value) and str(refused.value).startswith("zlg.Config: ")


def test_a_log_goes_from_format_to_format_and_back(result, tmp_path):
    zlg.logs.write_raw(tmp_path / "a.h5", result.raw)
    zlg.logs.write_raw(tmp_path / "b.csv", zlg.logs.read_raw(tmp_path / "a.h5"))
    zlg.logs.write_raw(tmp_path / "c.h5", zlg.logs.read_raw(tmp_path / "b.csv"))
    back = zlg.logs.read_raw(tmp_path / "c.h5")
    assert np.array_equal(back.counts, result.raw.counts) and back.settings == result.raw.settings
    assert np.array_equal(back.detuning_sq_lambda2, result.raw.detuning_sq_lambda2)
    zlg.logs.write_angles(tmp_path / "angles.csv", result.angles)
    zlg.logs.write_angles(tmp_path / "angles.h5", zlg.logs.read_angles(tmp_path / "angles.csv"))
    assert np.array_equal(zlg.logs.read_angles(tmp_path / "angles.h5").sigma_arcsec, result.angles.sigma_arcsec)
    with pytest.raises(zlg.IoError, match="exists"):
        zlg.logs.write_raw(tmp_path / "b.csv", result.raw)
