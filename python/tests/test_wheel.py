# SPDX-License-Identifier: BSD-3-Clause
"""pip makes a wheel without a network, and what it installs works."""

import os
import subprocess
import sys
import zipfile

import pytest

from conftest import ROOT


@pytest.mark.long
def test_pip_builds_and_installs(tmp_path):
    build = os.environ.get("HINGE_PYTHON_BUILD_DIR")
    if not build:
        pytest.skip("HINGE_PYTHON_BUILD_DIR is not set (./run python sets it): a build from nothing takes long")
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "-q"]
    settings = ["--config-settings", f"build-dir={build}"]
    offline = ["--no-deps", "--no-index"]
    wheel = [*pip, "wheel", *offline, *settings, "-w", str(tmp_path), str(ROOT / "python")]
    done = subprocess.run(wheel, capture_output=True, text=True, timeout=1200)
    assert done.returncode == 0, done.stdout + done.stderr
    (made,) = tmp_path.glob("hinge-*.whl")
    names = zipfile.ZipFile(made).namelist()
    for wanted in ("hinge/__init__.py", "hinge/py.typed", "hinge/molecular/__init__.pyi"):
        assert wanted in names
    assert any(name.startswith("hinge/_core_baseline.") for name in names)
    folder = tmp_path / "site"
    install = [*pip, "install", "--no-deps", "--no-index", "--target", str(folder), str(made)]
    subprocess.run(install, check=True, timeout=300)
    code = (
        "import hinge, hinge.molecular as hm; assert hinge.__file__.startswith('" + str(folder) + "')\n"
        f"m = hm.Molecule({str(ROOT / 'molecular/data/1ubq.pdb')!r})\n"
        "print(hm.Checker(m).collides_coordinates(m.models))"
    )
    env = {**os.environ, "PYTHONPATH": str(folder)}
    told = subprocess.run([sys.executable, "-c", code], env=env, capture_output=True, text=True, cwd=tmp_path)
    assert told.stdout.strip() == "[ True]", told.stderr
