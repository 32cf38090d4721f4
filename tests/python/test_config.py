"""Configurations as dataclasses, held against the program's table of keys."""

import copy
import dataclasses
import importlib.machinery
import importlib.util
import pickle
import typing

import numpy as np
import pytest
from conftest import PACKAGE_DIR, ROOT

import zlg
from zlg import _zlg
from zlg.config import Config, Gyro, Motion, Run


def test_the_dataclasses_are_those_of_the_table_of_keys():
    path = str(ROOT / "tools" / "python_configuration")
    loader = importlib.machinery.SourceFileLoader("python_configuration", path)
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    expected = module.configuration_source(_zlg.config_keys())
    assert (PACKAGE_DIR / "zlg" / "sections.py").read_text() == expected


def test_a_key_of_each_kind_has_the_type_of_its_values():
    hints = {key: typing.get_type_hints(getattr(zlg.config, section))[key]
             for section, key in (("Gyro", "tick_s"), ("Run", "duration_s"), ("Gyro", "light_samples"), ("Design", "run_lengths_s"),
                                  ("Perimeter", "loop"), ("Switching", "interval_s"), ("Motion", "column"), ("Temperature", "profile"))}  # fmt: skip
    assert hints == {
        "tick_s": float,
        "duration_s": typing.Optional[float],
        "light_samples": int,
        "run_lengths_s": list[float],
        "loop": typing.Literal["analog", "exponential", "digital"],
        "interval_s": typing.Union[float, typing.Literal["optimal"]],
        "column": typing.Optional[typing.Union[int, str]],
        "profile": typing.Optional[typing.Union[str, list[list[float]]]],
    }


def test_every_key_is_a_member_with_its_default():
    config = Config()
    assert config.settings() == []
    for key in _zlg.config_keys():
        section = getattr(config, key["section"])
        assert key["name"] in {field.name for field in dataclasses.fields(section)}
        assert (getattr(section, key["name"]) in (None, [])) == (key["default"] == "")


def test_every_value_survives_the_way_to_cpp_and_back():
    config = Config.of(
        "run.duration_s=12.5", "run.seed=7", "switching.interval_s=optimal", "motion.kind=sum",
        "motion.amplitude_arcsec_s=[1.5, 2]", "motion.frequency_hz=[3, 4]", "motion.phase_deg=[0, 90]",
        "faults.kind=laser_off", "faults.at_s=20", "faults.duration_s=0.3", "faults.size=0",
        "analysis.deviations=[\"adev\", \"mdev\"]", "compensation.relock=joint", 'motion.path="a \\"b\\" é"',
    )  # fmt: skip
    assert config.switching.interval_s == "optimal"
    assert config.motion.amplitude_arcsec_s == [1.5, 2.0]
    assert config.faults.kind == ["laser_off"]
    assert config.motion.path == 'a "b" é'
    assert Config.from_toml(config.to_toml()) == config
    assert Config.from_settings(dict(_zlg.CheckedConfig(config.settings()).settings())).gyro == config.gyro


def test_numbers_of_numpy_are_taken():
    config = Config(run=Run(duration_s=np.float32(2.5), seed=np.int64(3)), motion=Motion(frequency_hz=np.array([0.1])))
    assert dict(config.settings()) == {"run.duration_s": "2.5", "run.seed": "3", "motion.frequency_hz": "[0.1]"}


def test_with_changes_a_copy():
    before = Config()
    after = before.with_("motion.kind=rest", switching={"interval_s": 60})
    assert (after.motion.kind, after.switching.interval_s) == ("rest", 60)
    assert before == Config()
    with pytest.raises(TypeError):
        before.with_(switching={"intervall_s": 60})


@pytest.mark.parametrize(
    "config, reason",
    [
        (Config(motion=Motion(kind="sin")), "motion.kind"),
        (Config(run=Run(duration_s=-1.0)), "run.duration_s = -1"),
        (Config(run=Run(duration_s=float("nan"))), "run.duration_s"),
        (Config(run=Run(seed=True)), "run.seed"),
        (Config(motion=Motion(kind="sum", amplitude_arcsec_s=[1.0, 2.0])), "motion"),
    ],
)
def test_what_is_not_allowed_is_told(config, reason):
    with pytest.raises(zlg.ConfigError, match=reason) as caught:
        config.check()
    assert "\n" not in str(caught.value)
    assert isinstance(caught.value, ValueError) and isinstance(caught.value, zlg.Error)


def test_a_misspelt_key_names_the_nearest():
    with pytest.raises(zlg.ConfigError, match="interval_s"):
        Config.of("switching.intervall_s=60")


def test_load_reads_a_file(tmp_path):
    (tmp_path / "a.toml").write_text("[run]\nduration_s = 60\n")
    config = Config.load(tmp_path / "a.toml", "run.seed=5")
    assert (config.run.duration_s, config.run.seed) == (60.0, 5)
    (tmp_path / "b.toml").write_text("[run]\nlength = 60\n")
    with pytest.raises(zlg.ConfigError, match="b.toml"):
        Config.load(tmp_path / "b.toml")
    with pytest.raises(OSError):
        Config.load(tmp_path / "none.toml")


def test_only_the_end_of_a_change_is_checked():
    sines = {"kind": "sum", "amplitude_arcsec_s": [1.0, 2.0], "phase_deg": [0.0, 90.0]}
    config = Config().with_("motion.frequency_hz=[3, 4]", motion=sines)
    assert config.motion.frequency_hz == [3.0, 4.0]
    with pytest.raises(zlg.ConfigError, match="motion"):
        Config().with_("motion.frequency_hz=[3]", motion=sines)


def test_an_attribute_that_is_set_is_given_whatever_its_value():
    config = Config()
    assert config.settings() == [] and not config.says("gyro.tick_s")
    config.gyro.tick_s = Config().gyro.tick_s
    assert config.settings() == [("gyro.tick_s", "0.005")] and config.says("gyro.tick_s")
    assert copy.deepcopy(config).settings() == pickle.loads(pickle.dumps(config)).settings() == config.settings()
    assert config == Config()
    assert Config(gyro=Gyro(scale_arcsec=3.263)).says("gyro.scale_arcsec")
    assert Config().with_(gyro={"tick_s": 0.005}).settings() == config.settings()
    assert Config().with_("run.seed=2", gyro={"tick_s": 0.005}).says("gyro.tick_s")
    # Of a replaced section it shows no more which key was meant.
    assert Config(gyro=dataclasses.replace(Config().gyro, tick_s=0.01)).settings() == [("gyro.tick_s", "0.01")]
    with pytest.raises(TypeError, match="tick"):
        Config().with_(gyro={"tick": 0.005})


def test_a_key_that_stands_twice_is_refused():
    assert Config.from_settings([("run.seed", "3"), ("run.seed", "3")]).run.seed == 3
    with pytest.raises(zlg.ConfigError, match="run.seed stands twice, as 3 and as 4"):
        Config.from_settings([("run.seed", "3"), ("run.seed", "4")], "raw.csv")
