"""Builds the wheel of zlg: CMake makes the package, this packs it. Needs nothing from the network.

python3 -m build --wheel --no-isolation
"""

import base64
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


def version():
    return re.search(r"project\(zlg VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


def metadata(packages):
    head = {
        "Metadata-Version": "2.1",
        "Name": "zlg",
        "Version": version(),
        "Summary": "A Zeeman laser gyro that switches its mode: simulation, compensation, noise analysis",
        "License": "Apache-2.0",
        "Requires-Python": ">=3.11",
        "Requires-Dist": "numpy",
    }
    lines = [*head.items(), *(("Requires-External", name) for name in packages)]
    return "".join(f"{key}: {value}\n" for key, value in lines)


def packages_of(module):
    """The packages of Debian with the shared libraries that the module names; none on another system."""
    if not all(map(shutil.which, ("dpkg", "ldd", "readelf"))):
        return []
    said = lambda *command: subprocess.run(command, capture_output=True, text=True, check=False).stdout
    named = set(re.findall(r"\(NEEDED\).*\[(.+)\]", said("readelf", "-d", module)))
    files = [os.path.realpath(path) for name, path in re.findall(r"(\S+) => (\S+)", said("ldd", module)) if name in named]
    # Where /lib is /usr/lib a package may own the file by either name.
    owned = said("dpkg", "-S", *files, *(path.removeprefix("/usr") for path in files))
    return sorted({line.partition(":")[0] for line in owned.splitlines()})


def tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def built_package(config_settings):
    """The folder with the package. The setting `build-dir` names a build folder to go on with."""
    build = pathlib.Path((config_settings or {}).get("build-dir", ROOT / "build" / "wheel"))
    if not (build / "CMakeCache.txt").exists():
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DZLG_TESTS=OFF", f"-DPython_EXECUTABLE={sys.executable}"]
        subprocess.run(["cmake", "-S", str(ROOT), "-B", str(build), "-G", "Ninja", *options], check=True)
    subprocess.run(["cmake", "--build", str(build), "--target", "zlg_python"], check=True)
    return build / "python" / "zlg"


def record_line(name, content):
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(content)}\n"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    package = built_package(config_settings)
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    kept = [p for p in sorted(package.iterdir()) if p.suffix in (".py", ".pyi", ".typed") or p.name.endswith(suffix)]
    if not any(path.name == f"_zlg{suffix}" for path in kept):
        raise SystemExit(f"{package} holds no _zlg{suffix}; the build folder is of another Python")
    info = f"zlg-{version()}.dist-info"
    contents = {f"zlg/{path.name}": path.read_bytes() for path in kept}
    contents[f"{info}/METADATA"] = metadata(packages_of(package / f"_zlg{suffix}")).encode()
    contents[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    wheel = f"Wheel-Version: 1.0\nGenerator: zlg\nRoot-Is-Purelib: false\nTag: {tag()}\n"
    contents[f"{info}/WHEEL"] = wheel.encode()
    record = "".join(record_line(name, content) for name, content in contents.items())
    contents[f"{info}/RECORD"] = (record + f"{info}/RECORD,,\n").encode()
    name = f"zlg-{version()}-{tag()}.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as archive:
        for member, content in contents.items():
            archive.writestr(zipfile.ZipInfo(member, (1980, 1, 1, 0, 0, 0)), content, zipfile.ZIP_DEFLATED)
    return name
