# SPDX-License-Identifier: MIT
"""Counts that are the same in every run: what goffer_count does, as callgrind sees it, and what the runtime takes.

Work is counted in goffer's own code alone: what the C library does depends on the processor. Callgrind has no AVX-512.
"""

from __future__ import annotations

import collections
import dataclasses
import pathlib
import re
import shutil
import subprocess
import tempfile

from .outcome import Unmeasured
from .trees import Tree

FRAME = "goffer_counted_frame"  # the function of goffer_count that is counted
# Divisions and roots: one takes as long as many others.
SLOW = re.compile(r"^(v?(div|sqrt)[sp][sd]|i?div[bwlq]?|f(div|sqrt)|[su]div)$")
LIBRARIES = (("engine", "goffer_engine"), ("modules/bend", "goffer_bend"))


@dataclasses.dataclass(frozen=True)
class Work:
    """The instructions that one frame takes."""

    instructions: float
    slow: float  # divisions and roots

    def minus(self, other: "Work", share: float = 1) -> "Work":
        """Less `share` of another."""
        return Work(*(a - share * b for a, b in zip(dataclasses.astuple(self), dataclasses.astuple(other))))

    def over(self, count: float) -> "Work":
        """One of `count` parts."""
        return Work(*(value / count for value in dataclasses.astuple(self)))


def output_of(*command: str) -> str:
    """What a command prints; Unmeasured where it fails."""
    if shutil.which(command[0]) is None:
        raise Unmeasured(f"{command[0]} is not here: bash .ci/setup bench installs it")
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        last = (done.stderr.strip().splitlines() or ["no output"])[-1]
        raise Unmeasured(f"{command[0]} failed ({done.returncode}): {last}")
    return done.stdout


def slow_addresses(program: str) -> set[int]:
    """Where a program has divisions and roots."""
    code = output_of("objdump", "-d", "--no-show-raw-insn", program)
    lines = re.findall(r"^ *([0-9a-f]+):\t(\S+)", code, re.MULTILINE)
    return {int(address, 16) for address, name in lines if SLOW.match(name)}


def read_profile(text: str, program: str, slow: set[int]) -> Work:
    """Sums up what one dump of callgrind says of the code of `program` itself, inlined code included."""
    instructions = slow_ones = 0
    inside = called = False
    for line in text.splitlines():
        if line.startswith("ob="):
            inside = line[3:] == program
        elif line.startswith("calls="):
            called = True  # the next line is what the called function cost, which it says itself
        elif line.startswith("0x"):
            if inside and not called:
                address, cost = line.split()
                instructions += int(cost)
                slow_ones += int(cost) if int(address, 16) in slow else 0
            called = False
    return Work(instructions, slow_ones)


def profiles(program: str) -> dict[tuple[str, str], dict[tuple[int, int], Work]]:
    """The work of goffer_count's frames, by (instruction set, streams) and (instances, vertices of each)."""
    slow = slow_addresses(program)
    found: dict[tuple[str, str], dict[tuple[int, int], Work]] = collections.defaultdict(dict)
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        lines = output_of("valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", "--dump-instr=yes",
                          "--dump-line=no", "--compress-pos=no", "--compress-strings=no",
                          f"--toggle-collect={FRAME}", f"--dump-after={FRAME}", program, "work").splitlines()
        for number, line in enumerate(lines, start=1):
            isa, streams, instances, vertices = line.split()
            dump = out.with_name(f"out.{number}").read_text()
            found[isa, streams][int(instances), int(vertices)] = read_profile(dump, program, slow)
    return found


def per_vertex(frames: dict[tuple[int, int], Work]) -> Work:
    """From the frames that differ in vertices alone."""
    (_, few), (_, many) = sorted(size for size in frames if size[0] == 1)
    return frames[1, many].minus(frames[1, few]).over(many - few)


def per_instance(frames: dict[tuple[int, int], Work]) -> Work:
    """From the frames that differ in instances alone: what one costs beside its vertices."""
    few, many = sorted(size for size in frames if size[0] > 1)
    each = frames[many].minus(frames[few]).over(many[0] - few[0])
    return each.minus(per_vertex(frames), share=few[1])


def work_counts(program: str) -> dict[str, float]:
    """Counts the work of each kernel, for each set of streams."""
    counts = {}
    for (isa, streams), frames in profiles(program).items():
        vertex, instance = per_vertex(frames), per_instance(frames)
        of = f"{isa}/{streams}"
        counts[f"instructions_per_vertex/{of}"] = round(vertex.instructions, 2)
        counts[f"roots_and_divisions_per_vertex/{of}"] = round(vertex.slow, 3)
        counts[f"instructions_per_instance/{of}"] = round(instance.instructions)
    return counts


def memory_counts(program: str) -> dict[str, float]:
    """What goffer_count says of itself; what it cannot count is below 0, and left out."""
    lines = (line.split() for line in output_of(program, "memory").splitlines())
    return {name: float(value) for name, value in lines if float(value) >= 0}


def size_counts(tree: Tree) -> dict[str, float]:
    """Bytes of code and constants in the runtime's libraries."""
    sizes = {}
    for folder, name in LIBRARIES:
        rows = output_of("size", "--totals", tree.library(folder, name)).splitlines()
        sizes[f"text_bytes/{name}"] = float(rows[-1].split()[0])
    return sizes


def count(tree: Tree) -> dict[str, float]:
    """All counts of a tree, by name, in the order of their names."""
    program = tree.program("goffer_count")
    found = work_counts(program) | memory_counts(program) | size_counts(tree)
    return dict(sorted(found.items()))
