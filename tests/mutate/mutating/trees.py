# SPDX-License-Identifier: MIT
"""Copies of the working tree that mutants are built and tested in."""

from __future__ import annotations

import contextlib
import dataclasses
import hashlib
import math
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator

from .groups import GROUPS
from .sites import Mutant

OPTIONS = ["-DCMAKE_BUILD_TYPE=None", "-DCMAKE_CXX_FLAGS=-O1 -D_GLIBCXX_ASSERTIONS", "-DGOFFER_TOOLS=OFF", "-DGOFFER_BENCH=OFF",
           "-DGOFFER_SAMPLES=OFF", "-DGOFFER_INSTALL=OFF"]
BUILDS = {"scalar": ["-DGOFFER_SIMD=OFF"], "vectors": ["-DGOFFER_SIMD=ON"]}
SLOW = 0.5  # seconds, of a test case that is run after the others
PATIENCE = 5  # times as much of the processor as the unchanged program takes
LEAST_PATIENCE = 10.0  # seconds
STUCK = 1800.0  # seconds by the clock, which says little where the machine is busy
LIMITED = ["prlimit", f"--as={8 << 30}", "--core=0"]  # a changed program may ask for all the memory that there is
OUT_OF_TIME = (-signal.SIGXCPU, -signal.SIGKILL)


class Broken(Exception):
    """The tree as it is cannot be built or fails its tests."""


@dataclasses.dataclass
class Stage:
    """One run of tests, and how long it takes where nothing is changed."""

    command: list[str]
    folder: pathlib.Path
    seconds: float = 0.0


@dataclasses.dataclass(frozen=True)
class Outcome:
    """What became of a mutant."""

    verdict: str  # caught, survived, or not counted: unbuildable, same, stuck
    by: str = ""  # what caught it
    seconds: float = 0.0


def stages_of(names: list[str]) -> list[tuple[str, str]]:
    """What some groups are tried with: builds and their programs."""
    found = dict.fromkeys(stage for name in names for stage in GROUPS[name].stages)
    return [tuple(stage.split(":")) for stage in found]


def files_of(root: pathlib.Path) -> list[str]:
    """Files that are tracked or would be."""
    words = ["git", "-C", str(root), "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    listed = subprocess.run(words, check=True, capture_output=True, text=True).stdout.split("\0")
    return sorted(file for file in set(filter(None, listed)) if (root / file).is_file())


def escaped(name: str) -> str:
    """A test case's name, as doctest's filters want it."""
    return name.replace("\\", "\\\\").replace(",", "\\,")


def faults(said: str) -> str:
    """What tests say of their failures; all that they say where that is not plain."""
    return "\n".join(line for line in said.split("\n") if "ERROR" in line or line.startswith("FAIL:")) or said


class Tree:
    """A copy of the sources, with its builds."""

    def __init__(self, root: pathlib.Path, folder: pathlib.Path):
        self._root = root
        self._folder = folder
        self._sources = folder / "tree"
        self._stages: dict[tuple[str, str], list[Stage]] = {}
        self._digests: dict[tuple[str, str], str] = {}

    def build(self, names: list[str]) -> None:
        """Copies what is new, and builds what some groups are tried with."""
        self._copy()
        for build, program in stages_of(names):
            if build != "python":
                self._configure(build)
                if not self._make(build, program, show=True):
                    raise Broken(f"{program} cannot be built")
                self._digests[build, program] = self._digest(build, program)

    def time_tests(self, names: list[str]) -> None:
        """Runs the tests that some groups are tried with, which must pass."""
        for build, program in stages_of(names):
            self._stages[build, program] = self._python(program) if build == "python" else self._doctest(build, program)

    def try_out(self, mutant: Mutant, group: str) -> Outcome:
        """Whether the group's tests see a change."""
        start = time.monotonic()
        with self._changed(mutant):
            outcome = self._judge(group)
        return dataclasses.replace(outcome, seconds=time.monotonic() - start)

    def _judge(self, group: str) -> Outcome:
        same = True
        for build, program in stages_of([group]):
            if build != "python":
                if not self._make(build, program):
                    return Outcome("unbuildable")
                if self._digest(build, program) == self._digests[build, program]:
                    continue
            same = False
            for stage in self._stages[build, program]:
                code, _ = self._run(stage.command, stage.folder, max(LEAST_PATIENCE, PATIENCE * stage.seconds))
                if code is None:
                    return Outcome("stuck")
                if code != 0:
                    return Outcome("caught", "time" if code in OUT_OF_TIME else f"{build} {program}")
        return Outcome("same" if same else "survived")

    @contextlib.contextmanager
    def _changed(self, mutant: Mutant) -> Iterator[None]:
        path = self._sources / mutant.file
        text = path.read_text(encoding="utf-8")
        lines = text.split("\n")
        assert lines[mutant.line - 1] == mutant.old, f"{mutant.file}:{mutant.line} is not what it was"
        lines[mutant.line - 1] = mutant.new
        path.write_text("\n".join(lines), encoding="utf-8")
        try:
            yield
        finally:
            path.write_text(text, encoding="utf-8")

    def _copy(self) -> None:
        wanted = files_of(self._root)
        for file in wanted:
            there = self._sources / file
            there.parent.mkdir(parents=True, exist_ok=True)
            if not there.is_file() or there.read_bytes() != (self._root / file).read_bytes():
                shutil.copy(self._root / file, there)
        for path in list(self._sources.rglob("*")):
            if path.is_file() and str(path.relative_to(self._sources)) not in set(wanted):
                path.unlink()

    def _doctest(self, build: str, program: str) -> list[Stage]:
        folder = self._folder / build
        command = [str(folder / "bin" / program)]
        code, said = self._run([*command, "--duration=true"], folder)
        if code != 0:
            raise Broken(f"{program} fails as it is:\n{faults(said)}")
        times = {name: float(seconds) for seconds, name in re.findall(r"^(\d+\.\d+) s: (.*)$", said, re.M)}
        slow = sorted((name for name in times if times[name] > SLOW), key=lambda name: times[name])
        command.append("--abort-after=1")
        fast = [*command, *(["--test-case-exclude=" + ",".join(map(escaped, slow))] if slow else [])]
        stages = [Stage(fast, folder, sum(seconds for name, seconds in times.items() if name not in slow))]
        return stages + [Stage([*command, "--test-case=" + escaped(name)], folder, times[name]) for name in slow]

    def _python(self, tests: str) -> list[Stage]:
        folder = self._sources / tests
        stages = []
        for file in sorted(folder.glob("test_*.py")):
            stage = Stage(["/usr/bin/python3", "-B", "-m", "unittest", "-f", file.stem], folder)
            start = time.monotonic()
            code, said = self._run(stage.command, folder)
            if code != 0:
                raise Broken(f"{tests} fails as it is:\n{faults(said)}")
            stage.seconds = time.monotonic() - start
            stages.append(stage)
        return sorted(stages, key=lambda stage: stage.seconds)

    def _configure(self, build: str) -> None:
        launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        words = ["cmake", "-S", str(self._sources), "-B", str(self._folder / build), "-G", "Ninja", *OPTIONS, *BUILDS[build],
                 *launcher]
        subprocess.run(words, check=True, stdout=subprocess.DEVNULL)

    def _make(self, build: str, program: str, show: bool = False) -> bool:
        words = ["cmake", "--build", str(self._folder / build), "--target", program, "--parallel", "2"]
        # Paths below the folder count as relative, so that one copy finds what another compiled.
        cache = {"CCACHE_BASEDIR": str(self._folder), "CCACHE_NOHASHDIR": "1"}
        done = subprocess.run(words, check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              errors="replace", env=os.environ | cache)
        if show and done.returncode != 0:
            print(done.stdout, file=sys.stderr)
        return done.returncode == 0

    def _digest(self, build: str, program: str) -> str:
        return hashlib.sha256((self._folder / build / "bin" / program).read_bytes()).hexdigest()

    def _run(self, command: list[str], folder: pathlib.Path, seconds: float = STUCK) -> tuple[int | None, str]:
        """The exit code, None where the clock ran out, and what was said. `seconds` are the processor's."""
        command = [*LIMITED, f"--cpu={math.ceil(seconds)}", *command]
        with tempfile.TemporaryDirectory(dir=self._folder) as scratch:
            # With no more models than those of the tree, so that every machine finds the same.
            environment = os.environ | {"TMPDIR": scratch, "GOFFER_MODELS": scratch, "GOFFER_TEST_ROUNDS": "few"}
            with subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                  errors="replace", env=environment, start_new_session=True) as process:
                try:
                    said, _ = process.communicate(timeout=STUCK)
                    return process.returncode, said
                except subprocess.TimeoutExpired:
                    os.killpg(process.pid, signal.SIGKILL)
                    process.communicate()
                    return None, ""
