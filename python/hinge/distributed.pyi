# SPDX-License-Identifier: BSD-3-Clause
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal, Protocol

from . import Error

__all__ = ["Question", "Summary", "UnitError", "run"]

class UnitError(Error): ...

@dataclass(frozen=True)
class Question:
    tool: str
    words: tuple[str, ...]
    unit: int
    def __init__(self, tool: Literal["biocd", "robocd"], *words: object, unit: int = 10000) -> None: ...

class _Executor(Protocol):
    def submit(self, fn: Callable[..., object], /, *args: object) -> object: ...

@dataclass
class Summary:
    units: int = 0
    computed: int = 0
    there: int = 0
    conformations: int = 0
    retries: int = 0
    workers: int = 0
    seconds: float = 0.0
    notes: tuple[str, ...] = ()
    log: str = ""

def run(
    question: Question,
    executor: _Executor,
    folder: str | os.PathLike[str],
    *,
    threads: int = 1,
    ship: Sequence[str | os.PathLike[str]] | None = None,
    retries: int = 3,
    in_flight: int | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> Summary: ...
