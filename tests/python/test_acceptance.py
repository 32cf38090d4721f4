"""The acceptance test from Python: the record of the program, and what is refused."""

import json
import subprocess

import numpy as np
import pytest
from conftest import PACKAGE_DIR

import zlg

PROGRAM = PACKAGE_DIR.parent / "bin" / "zlg"
PLAN = """[unit]
serial = "A1"
[[run]]
files = ["a.csv"]
kind = "static"
time = "none"
column = 1
holds = "rate"
unit = "deg/h"
rate_hz = 10
[limits]
"bias.deg_h" = { max = 1 }
"""


@pytest.fixture
def plan(tmp_path):
    rates = np.random.default_rng(1).normal(0.0, 1.0, 4000)
    (tmp_path / "a.csv").write_text("".join(f"{float(rate)!r}\n" for rate in rates))
    (tmp_path / "plan.toml").write_text(PLAN)
    return tmp_path / "plan.toml"


def test_the_record_is_that_of_the_program(plan):
    test = zlg.accept(plan)
    told = json.loads(subprocess.run([PROGRAM, "accept", plan, "--json"], capture_output=True, check=True).stdout)
    assert test.passed
    assert test["bias.deg_h"].verdict == "pass"
    for quantity in told["quantities"]:
        assert test[quantity["name"]].value == quantity["value"]
        assert test[quantity["name"]].uncertainty == quantity["uncertainty"]
    assert test.runs == told["runs"]
    with pytest.raises(KeyError):
        test["bias"]


def test_its_page_can_be_verified(plan):
    page = plan.parent / "report.html"
    zlg.accept(plan).write(page)
    done = subprocess.run([PROGRAM, "accept", "--verify", page, plan.parent / "a.csv"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_what_the_program_refuses_is_an_exception(plan):
    plan.write_text(PLAN.replace("static", "still"))
    with pytest.raises(zlg.ConfigError, match="allowed is static"):
        zlg.accept(plan)


def test_threads_that_cannot_be_are_no_finding_about_the_gyro(plan):
    with pytest.raises(ValueError, match="threads"):
        zlg.accept(plan, threads=0)
