"""The package under test: that of ZLG_PYTHON_DIR, else of the release build."""

import os
import pathlib
import sys
import threading

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGE_DIR = pathlib.Path(os.environ.get("ZLG_PYTHON_DIR", ROOT / "build" / "release" / "python")).resolve()
sys.path.insert(0, str(PACKAGE_DIR))

# On a busy machine xdist may run the tests in another thread than the main one, which alone hears signals.
hears_signals = pytest.mark.skipif(threading.current_thread() is not threading.main_thread(),
                                   reason="the tests run in a thread that hears no signals")
