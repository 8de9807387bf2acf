# SPDX-License-Identifier: BSD-3-Clause
"""Collision hierarchies for articulated models: which primitives come too close at configuration q?

hinge.molecular   proteins, nucleic acids and ligands as mechanisms of torsions; lengths in angstrom
hinge.robotics    robots from URDF or from code, against themselves and the bodies around them; lengths in metres
hinge.report()    a page with pictures and tables that opens in any browser
hinge.Model       points, spheres, capsules or triangles from arrays, and hinge.Checker; lengths in any unit

Angles are in radians everywhere. The compiled part is chosen at import: the best instruction set of the CPU, or the
one that the environment variable HINGE_ISA names (baseline, avx2 or avx512). All sets give the same answers.

Calls that compute release the interpreter's lock, obey Ctrl-C, and take `threads` (the answers do not depend on it)
and `progress`: a callable with (done, total), or a progress bar such as tqdm's. Several threads may use one object.
After Ctrl-C in a call that reads a file or builds a checker, its work runs on and is dropped; the process waits for it
at its exit, and a second Ctrl-C ends the process at once.
In several processes, start them by "spawn" or "forkserver".
"""

import importlib as _importlib
import sys as _sys

from . import _isa

_SETS = ("baseline", "avx2", "avx512")


def _load_core():
    """Imports the module for the wanted instruction set, or for the next lower one that was built."""
    wanted = _SETS.index(_isa.wanted())
    for name in reversed(_SETS[: wanted + 1]):
        full = f"{__name__}._core_{name}"
        try:
            return name, _importlib.import_module(full)
        except ModuleNotFoundError as error:
            if error.name != full:
                raise
    raise ImportError(f"hinge: no compiled module up to {_SETS[wanted]} in {__path__[0]}; build the package again")


instruction_set, _core = _load_core()
for _name in ("", ".molecular", ".robotics"):  # what the modules of the package import
    _sys.modules[f"{__name__}._core{_name}"] = getattr(_core, _name[1:]) if _name else _core

__version__ = _core.version
Error = _core.Error
LoadError = _core.LoadError
ModelError = _core.ModelError
ConfigurationError = _core.ConfigurationError

from . import molecular, robotics  # noqa: E402
from ._checker import Checker  # noqa: E402
from ._model import Model  # noqa: E402
from ._planning import Motion  # noqa: E402
from ._report import Report, report  # noqa: E402

for _public in (Checker, Model, Motion, Report, report):
    _public.__module__ = __name__
del _public, _name

__all__ = [
    "Checker",
    "ConfigurationError",
    "Error",
    "LoadError",
    "Model",
    "ModelError",
    "Motion",
    "Report",
    "instruction_set",
    "molecular",
    "report",
    "robotics",
]
