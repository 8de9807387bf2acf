# SPDX-License-Identifier: BSD-3-Clause
"""The package as a whole: instruction sets, exceptions, import time."""

import pathlib
import re
import statistics
import time

import pytest

import hinge

ROOT = pathlib.Path(__file__).resolve().parents[2]


def built_sets():
    folder = pathlib.Path(hinge.__file__).parent
    return sorted(re.match(r"_core_(\w+)\.", f.name).group(1) for f in folder.glob("_core_*.so"))


def test_version_is_the_library_s():
    assert hinge.__version__ in (ROOT / "include/hinge/version.hpp").read_text()


def test_baseline_is_always_there():
    assert "baseline" in built_sets()


@pytest.mark.parametrize("name", ["baseline", "avx2", "avx512"])
def test_isa_is_chosen_by_the_environment(run_python, name):
    done = run_python("import hinge; print(hinge.instruction_set)", HINGE_ISA=name)
    if "the best instruction set of this CPU" in done.stderr:
        pytest.skip(f"this CPU lacks {name}")
    assert done.returncode == 0, done.stderr
    order = ["baseline", "avx2", "avx512"]
    wanted = [s for s in order[: order.index(name) + 1] if s in built_sets()]
    assert done.stdout.strip() == wanted[-1]


def test_unknown_isa_is_refused(run_python):
    done = run_python("import hinge", HINGE_ISA="mmx")
    assert done.returncode != 0
    assert "ImportError: HINGE_ISA is 'mmx': expected baseline, avx2 or avx512" in done.stderr


def test_exceptions_have_a_common_base():
    for error in (hinge.LoadError, hinge.ModelError, hinge.ConfigurationError):
        assert issubclass(error, hinge.Error)
        assert error.__module__ == "hinge"
        assert error.__doc__
    assert issubclass(hinge.ModelError, ValueError)
    assert issubclass(hinge.ConfigurationError, ValueError)


@pytest.mark.long
def test_import_costs_at_most_60_ms_more_than_numpy(run_python):
    def median(code):
        times = []
        for _ in range(20):
            start = time.perf_counter()
            assert run_python(code).returncode == 0
            times.append(time.perf_counter() - start)
        return statistics.median(times)

    numpy = median("import numpy")
    both = median("import numpy, hinge, hinge.molecular, hinge.robotics")
    print(f"import numpy {numpy * 1e3:.1f} ms, hinge adds {(both - numpy) * 1e3:.1f} ms")
    assert both - numpy < 0.060
