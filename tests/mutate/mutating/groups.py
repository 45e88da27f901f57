# SPDX-License-Identifier: MIT
"""Which files are changed, and which tests ought to see it."""

from __future__ import annotations

import dataclasses
import fnmatch
import pathlib
import random

from . import sites
from .sites import Mutant


@dataclasses.dataclass(frozen=True)
class Group:
    """Files, their part of all mutants, and the tests that they are tried with, one after the other."""

    share: float
    files: tuple[str, ...]  # patterns
    stages: tuple[str, ...]  # build:program, or python:folder


# One kernel file is soon compiled. What it lets through may lie where only vectors go.
GROUPS = {
    "kernels": Group(0.35, ("modules/bend/src/kernel/*.hpp", "modules/bend/src/pose/*", "modules/bend/src/output/*",
                            "modules/bend/src/job/*"), ("scalar:test_bend", "vectors:test_bend")),
    # How a body is bound shows when it is bent.
    "fit": Group(0.25, ("modules/fit/src/*.cpp",), ("scalar:test_fit", "scalar:test_bend")),
    "importers": Group(0.2, ("modules/mesh/src/*/read.cpp", "modules/mesh/src/stl/stl.cpp", "modules/mesh/src/ply/ply.cpp",
                             "modules/mesh/src/text.cpp", "modules/mesh/src/gltf/accessor.cpp",
                             "modules/mesh/src/gltf/document.cpp", "modules/mesh/src/gltf/nodes.cpp",
                             "modules/mesh/src/gltf/placement.cpp", "modules/mesh/src/gltf/value.cpp",
                             "modules/mesh/src/gltf/attributes.cpp", "modules/mesh/src/gltf/scene.cpp",
                             "modules/mesh/src/obj/materials.cpp", "modules/mesh/src/obj/statements.cpp"),
                       ("scalar:test_mesh",)),
    "paper": Group(0.1, ("modules/paper/src/*.cpp",), ("scalar:test_paper",)),
    "gate": Group(0.1, ("bench/gating/*.py",), ("python:tests/gate",)),
}


def counts(total: int, names: list[str]) -> dict[str, int]:
    """How many mutants each of some groups gets, by their shares."""
    whole = sum(GROUPS[name].share for name in names)
    found = {}
    for name in names:
        found[name] = round(total * GROUPS[name].share / whole)
        total -= found[name]
        whole -= GROUPS[name].share
    return found


def candidates(root: pathlib.Path, files: list[str], name: str, seed: int) -> list[Mutant]:
    """All mutants of a group, at most one a line, in an order that depends on the seed and the files alone."""
    by_line: dict[tuple[str, int], list[Mutant]] = {}
    for file in sorted(files):
        if any(fnmatch.fnmatch(file, pattern) for pattern in GROUPS[name].files):
            for mutant in sites.mutants(file, (root / file).read_text(encoding="utf-8")):
                by_line.setdefault((mutant.file, mutant.line), []).append(mutant)
    chance = random.Random(f"{seed} {name}")
    # As likely as there are changes of the line.
    order = sorted(by_line.values(), key=lambda of_line: chance.random() ** (1 / len(of_line)), reverse=True)
    return [chance.choice(of_line) for of_line in order]
