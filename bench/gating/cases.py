# SPDX-License-Identifier: MIT
"""Which cases of goffer_bench are compared in pairs."""

from __future__ import annotations

import re
from collections.abc import Iterable

# Widest first. `{widest}` stands for the first of these that the program has cases for.
ISAS = ("avx512", "avx2", "neon", "sse4.2", "scalar")

PAIRED = (
    "setup/instance",
    "setup/batch",
    "setup/bounds",
    "setup/bounds_batch",
    "setup/path",
    "deform/positions/cache/{widest}/1",
    "deform/positions+normals/cache/{widest}/1",
    "deform/interleaved-positions+normals/cache/{widest}/1",
    "deform/packed/cache/{widest}/1",
    "deform/positions/cache/avx2/1",
    "deform/positions+normals/cache/avx2/1",
    # Small bodies, whose instances cost as much as their vertices. No crowd that leaves the cache: how fast memory is
    # depends on which pages a process was given, and one process after the other is given the same ones.
    "sweep/positions/100x200/{widest}/1",
    "sweep/positions+normals/1000x200/{widest}/1",
    "deform/positions+normals/crowd500x200-joints8/{widest}/1",
)


def isas_of(names: Iterable[str]) -> set[str]:
    """The instruction sets of cases."""
    return {isa for name in names for isa in ISAS if isa in name.split("/")}


def widest(names: Iterable[str]) -> str:
    """The widest instruction set among the cases that a program has."""
    found = isas_of(names)
    return next((isa for isa in ISAS if isa in found), "scalar")


def resolve(pattern: str, isa: str) -> str:
    """A case's name on a machine whose widest instruction set is `isa`."""
    return pattern.replace("{widest}", isa)


def paired(names: list[str], only: str = "") -> list[str]:
    """The cases to compare, given those of head; `only` is a regular expression that picks among them."""
    isa = widest(names)
    found = dict.fromkeys(resolve(case, isa) for case in PAIRED)
    return [case for case in found if re.search(only, case)]
