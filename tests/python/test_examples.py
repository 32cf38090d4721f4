"""The examples, and the lines of the README, run and draw."""

import os
import re
import struct
import subprocess
import sys

import pytest
from conftest import PACKAGE_DIR, ROOT

EXAMPLES = ("simulate", "process", "design", "compare_bridges", "allan_with_gaps", "sweep")
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(PACKAGE_DIR), "MPLBACKEND": "Agg"}


def run(command, folder):
    done = subprocess.run([sys.executable, *command], cwd=folder, env=ENVIRONMENT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done


def size_of(png):
    content = png.read_bytes()
    assert content[:8] == b"\x89PNG\r\n\x1a\n"
    return struct.unpack(">II", content[16:24])


@pytest.mark.parametrize("name", EXAMPLES)
def test_example(name, tmp_path):
    done = run([str(ROOT / "examples" / f"{name}.py"), "picture.png"], tmp_path)
    width, height = size_of(tmp_path / "picture.png")
    assert width >= 700 and height >= 400
    assert "Warning" not in done.stderr


def test_the_examples_are_those():
    assert {path.stem for path in (ROOT / "examples").glob("*.py")} == set(EXAMPLES)


def test_the_lines_of_the_readme(tmp_path):
    (lines,) = [block for block in re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.S)]
    assert len([line for line in lines.splitlines() if line.strip()]) <= 10
    (tmp_path / "lines.py").write_text(lines)
    done = run(["lines.py"], tmp_path)
    assert re.fullmatch(r"constant: \d+\.\d arcsec a switch, .*\nauto: \d+\.\d arcsec a switch, .*\n", done.stdout)
    assert not done.stderr
