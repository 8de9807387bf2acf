# SPDX-License-Identifier: BSD-3-Clause
from . import molecular as molecular, robotics as robotics

__version__: str
instruction_set: str

__all__ = [
    "ConfigurationError",
    "Error",
    "LoadError",
    "ModelError",
    "instruction_set",
    "molecular",
    "robotics",
]

class Error(Exception): ...
class LoadError(Error): ...
class ModelError(Error, ValueError): ...
class ConfigurationError(Error, ValueError): ...
