# SPDX-License-Identifier: BSD-3-Clause
"""PEP 517 back end: builds a wheel with CMake, from the repository that this folder is in. Needs no network.

Settings (pip's --config-settings): levels=baseline,avx2 (the instruction sets), jobs=2, build-dir=FOLDER (kept, for a
faster second build), cmake-args="-D... -D...".
"""

import base64
import hashlib
import os
import pathlib
import platform
import re
import shlex
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

PYTHON = pathlib.Path(__file__).resolve().parent.parent
ROOT = PYTHON.parent


def _version():
    text = (ROOT / "include/hinge/version.hpp").read_text()
    return re.search(r'version_string = "([^"]+)"', text).group(1)


def _metadata():
    return (
        f"Metadata-Version: 2.1\nName: hinge\nVersion: {_version()}\n"
        "Summary: Collision hierarchies for articulated models: molecules, robots, and models of your own\n"
        "License: BSD-3-Clause\nRequires-Python: >=3.9\nRequires-Dist: numpy>=1.21\n"
    )


def _tag():
    abi = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{abi}-{abi}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def _build(settings, build_dir, stage):
    """Configures, builds and installs the package into `stage`."""
    cmake = shutil.which("cmake")
    if cmake is None:
        raise SystemExit("hinge: cmake is not installed (Debian: cmake ninja-build g++ pybind11-dev)")
    options = {
        "CMAKE_BUILD_TYPE": "Release",
        "CMAKE_UNITY_BUILD": "ON",
        "HINGE_BUILD_PYTHON": "ON",
        "HINGE_BUILD_TESTS": "OFF",
        "HINGE_TOOL_LEVELS": "",
        "Python3_EXECUTABLE": sys.executable,
    }
    if settings.get("levels"):
        options["HINGE_PYTHON_LEVELS"] = settings["levels"].replace(",", ";")
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    arguments = [f"-D{name}={value}" for name, value in options.items()]
    more = shlex.split(settings.get("cmake-args", ""))
    subprocess.run([cmake, "-S", ROOT, "-B", build_dir, *generator, *arguments, *more], check=True)
    jobs = settings.get("jobs") or os.environ.get("HINGE_JOBS") or str(os.cpu_count() or 1)
    subprocess.run([cmake, "--build", build_dir, "-j", jobs, "--target", "hinge_python"], check=True)
    install = [cmake, "--install", build_dir, "--component", "python", "--prefix", stage]
    subprocess.run(install, check=True)


def _record_line(name, data):
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(data)}\n"


def _write_wheel(path, stage):
    info = f"hinge-{_version()}.dist-info"
    files = {str(f.relative_to(stage)): f.read_bytes() for f in sorted(stage.rglob("*")) if f.is_file()}
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    wheel = f"Wheel-Version: 1.0\nGenerator: hinge_build\nRoot-Is-Purelib: false\nTag: {_tag()}\n"
    files[f"{info}/WHEEL"] = wheel.encode()
    record = "".join(_record_line(name, data) for name, data in files.items())
    files[f"{info}/RECORD"] = (record + f"{info}/RECORD,,\n").encode()
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, (2000, 1, 1, 0, 0, 0))  # the same files make the same wheel
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o755 if name.endswith(".so") else 0o644) << 16
            archive.writestr(entry, data)


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """Writes the metadata and returns the name of their folder, so that pip need not build a wheel to read them."""
    info = pathlib.Path(metadata_directory) / f"hinge-{_version()}.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(_metadata())
    return info.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Builds the wheel and returns its file name."""
    settings = dict(config_settings or {})
    if platform.system() != "Linux":
        raise SystemExit(f"hinge: built and tested on Linux only, this is {platform.system()}")
    name = f"hinge-{_version()}-{_tag()}.whl"
    with tempfile.TemporaryDirectory(prefix="hinge-build-") as temporary:
        stage = pathlib.Path(temporary) / "stage"
        _build(settings, pathlib.Path(settings.get("build-dir") or f"{temporary}/build").resolve(), stage)
        _write_wheel(pathlib.Path(wheel_directory) / name, stage)
    return name


def build_sdist(sdist_directory, config_settings=None):
    """Not supported: the package needs the C++ sources beside this folder."""
    raise SystemExit("hinge: there is no source archive of the Python folder alone; install from the repository")


def get_requires_for_build_wheel(config_settings=None):
    """Nothing beyond pyproject.toml."""
    return []
