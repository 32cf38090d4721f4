"""Stubs, docstrings and the wheel."""

import ast
import importlib
import importlib.util
import inspect
import os
import pkgutil
import re
import subprocess
import sys
import zipfile

import pytest
from conftest import PACKAGE_DIR, ROOT

import zlg
from zlg import _zlg


def names_of(body):
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            yield node.name
        elif isinstance(node, ast.AnnAssign):
            yield node.target.id


def public(owner):
    return {name for name in vars(owner) if not name.startswith("_")}


def test_the_stub_says_what_the_module_has():
    for node in ast.parse((PACKAGE_DIR / "zlg" / "_zlg.pyi").read_text()).body:
        if isinstance(node, ast.ClassDef):
            members = {name for name in names_of(node.body) if name not in ("__init__",)}
            assert members == public(getattr(_zlg, node.name)), node.name


def modules():
    return [importlib.import_module(f"zlg.{m.name}") for m in pkgutil.iter_modules(zlg.__path__)
            if not m.name.startswith("_") and m.name != "sections"]  # fmt: skip


@pytest.mark.parametrize("module", modules(), ids=lambda m: m.__name__)
def test_everything_public_says_what_it_is(module):
    assert module.__doc__
    for name in module.__all__:
        each = getattr(module, name)
        if inspect.isfunction(each) or inspect.isclass(each):
            assert each.__doc__, name
        if inspect.isfunction(each):
            signature = inspect.signature(each)
            assert signature.return_annotation is not signature.empty, name
            assert all(p.annotation is not p.empty for p in signature.parameters.values()), name


def test_the_types_agree(tmp_path):
    assert (PACKAGE_DIR / "zlg" / "py.typed").exists()
    # What the functions of the module give is typed by those of the package that call them.
    check = ["-m", "mypy", "--strict", "--no-warn-return-any", "--cache-dir", str(tmp_path), "-p", "zlg"]
    done = subprocess.run([sys.executable, *check], cwd=PACKAGE_DIR, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_wheel_holds_all_that_is_needed(tmp_path):
    build = ["-m", "build", "--wheel", "--no-isolation", "--outdir", str(tmp_path), "-C", f"build-dir={PACKAGE_DIR.parent}"]
    done = subprocess.run([sys.executable, *build, str(ROOT)], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    (wheel,) = tmp_path.glob("zlg-*.whl")
    zipfile.ZipFile(wheel).extractall(tmp_path / "site")
    environment = {**os.environ, "PYTHONPATH": str(tmp_path / "site")}
    (module,) = (tmp_path / "site" / "zlg").glob("_zlg*.so")
    assert not re.search(r"\((RPATH|RUNPATH)\)", subprocess.run(["readelf", "-d", module], capture_output=True, text=True, check=True).stdout)
    program = "import zlg, sys; print(zlg.__file__, len(zlg.simulate(zlg.Config.of('run.duration_s=1')).raw))"
    result = subprocess.run([sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=True)
    assert result.stdout.split() == [str(tmp_path / "site" / "zlg" / "__init__.py"), "400"]
    # Where a library is missing, the import says which packages bring them all.
    module.write_bytes(b"")
    result = subprocess.run([sys.executable, "-c", "import zlg"], env=environment, capture_output=True, text=True, check=False)
    assert result.returncode == 1
    assert re.search(r"^ImportError: .*_zlg.*; of Debian the wheel needs: apt install .*\blibhdf5-\S+ .*\bzlib1g$", result.stderr, re.M), result.stderr


@pytest.fixture
def backend():
    specification = importlib.util.spec_from_file_location("zlg_build", ROOT / "python" / "zlg_build.py")
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


def test_no_wheel_is_made_without_its_module(backend, tmp_path, monkeypatch):
    (tmp_path / "__init__.py").touch()
    (tmp_path / "_zlg.cpython-27-x86_64-linux-gnu.so").touch()
    monkeypatch.setattr(backend, "built_package", lambda settings: tmp_path)
    with pytest.raises(SystemExit, match="holds no _zlg.*another Python"):
        backend.build_wheel(tmp_path)
    assert not list(tmp_path.glob("*.whl"))
