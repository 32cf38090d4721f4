"""The package under test: that of ZLG_PYTHON_DIR, else of the release build."""

import os
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGE_DIR = pathlib.Path(os.environ.get("ZLG_PYTHON_DIR", ROOT / "build" / "release" / "python")).resolve()
sys.path.insert(0, str(PACKAGE_DIR))
