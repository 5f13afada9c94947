from collections.abc import Iterable, Mapping
from os import PathLike
from typing import Any, NamedTuple

import numpy

__all__ = ["Answer", "Interface", "solve", "solve_problem"]

class Interface(NamedTuple):
    blocks: Any
    points: Any
    normal: Any
    tangents: Any
    forces: Any
    gaps: Any
    status: Any
    area: Any

class Answer:
    status: str
    message: str
    summary: dict[str, Any]
    left_out: list[str]
    transformations: dict[str, numpy.ndarray[Any, Any]]
    interfaces: list[Interface]
    def __init__(self, model: Any, simulation: Any, corners: Any, notes: list[str]) -> None: ...
    def to_dict(self) -> dict[str, Any]: ...
    def write(self, path: str | PathLike[str]) -> None: ...

def solve(
    model: str | PathLike[str] | Mapping[str, Any],
    fixed: Iterable[Any] = (),
    threads: int = 1,
    overrides: Iterable[str] = (),
) -> Answer: ...
def solve_problem(
    problem: Any, fixed: Iterable[Any] = (), threads: int = 1, overrides: Iterable[str] = ()
) -> Answer: ...
