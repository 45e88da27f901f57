# SPDX-License-Identifier: MIT
"""The source trees that are compared, and their builds, which are kept from run to run.

Base and head are compiled alike, as the preset `release` says: head's build is that preset's. Functions begin on cache
lines in both, so that what is changed in one does not move the others about in their lines, which alone can change a
loop's time by some per cent.
"""

from __future__ import annotations

import dataclasses
import os
import pathlib
import platform
import re
import shutil
import subprocess

from .outcome import Broken, Unmeasured

OPTIONS = ("-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O3 -DNDEBUG -falign-functions=64")
BENCH_ALONE = ("-DGOFFER_TOOLS=OFF", "-DGOFFER_TESTS=OFF", "-DGOFFER_SAMPLES=OFF", "-DGOFFER_INSTALL=OFF",
               "-DGOFFER_BENCH=ON")
MOST_TREES = 4  # that are kept
FOLDER = pathlib.Path("build/gate")
BUILD = pathlib.Path("build/release")  # in every source tree alike, so that ccache sees the same paths


@dataclasses.dataclass
class Tree:
    """A built tree."""

    label: str  # the commit, with a + where files differ from it
    build: pathlib.Path

    def program(self, name: str) -> str:
        """A program's path."""
        return str(self.build / "bin" / name)

    def library(self, folder: str, name: str) -> str:
        """A static library's path."""
        return str(self.build / folder / f"lib{name}.a")

    def compiler(self) -> str:
        """Name, version and what it makes code for, as in "GNU 12.2.0 x86_64"."""
        for file in self.build.glob("CMakeFiles/*/CMakeCXXCompiler.cmake"):
            found = dict(re.findall(r'set\(CMAKE_CXX_COMPILER_(ID|VERSION) "(.*?)"\)', file.read_text()))
            return f"{found.get('ID', 'unknown')} {found.get('VERSION', '')} {platform.machine()}"
        return "unknown"


class BuildFailure(Unmeasured):
    """A tree does not build. There is nothing to compare with where that is a base."""


class Repository:
    """The repository that the gate is run in."""

    def __init__(self, root: pathlib.Path):
        self.root = root
        self.folder = root / FOLDER

    def git(self, *words: str) -> str:
        """What a git command prints; Unmeasured where it fails."""
        try:
            done = subprocess.run(["git", "-C", str(self.root), *words], capture_output=True, text=True, check=True)
        except OSError as error:
            raise Unmeasured(f"git does not run: {error}") from error
        except subprocess.CalledProcessError as error:
            said = (error.stderr.strip().splitlines() or ["failed"])[0]
            raise Unmeasured(f"git {' '.join(words)}: {said}") from error
        return done.stdout.strip()

    def commit(self, reference: str) -> str:
        """The commit that a reference names."""
        try:
            return self.git("rev-parse", "--verify", "--quiet", f"{reference}^{{commit}}")
        except Unmeasured:
            raise Unmeasured(f"there is no commit {reference} here (a shallow clone has the last one alone)") from None

    def default_base(self) -> str:
        """Where this branch left the main one; the commit before this one where this is the main branch."""
        head = self.commit("HEAD")
        for upstream in ("origin/HEAD", "origin/main", "main"):
            try:
                base = self.git("merge-base", "HEAD", upstream)
            except Unmeasured:
                continue
            if base != head or self.is_changed():
                return base
        return self.commit("HEAD~1")

    def is_changed(self) -> bool:
        """Whether files differ from the commit at hand."""
        return self.git("status", "--porcelain", "--untracked-files=no") != ""

    def label(self) -> str:
        """Names the files as they are: their commit, and a + if they differ from it."""
        return self.commit("HEAD")[:12] + ("+" if self.is_changed() else "")

    def head(self, targets: list[str]) -> Tree:
        """Builds the files as they are; Broken where that fails."""
        try:
            return Tree(self.label(), self._build(self.root, "head", targets))
        except BuildFailure as reason:
            raise Broken(str(reason)) from reason

    def base(self, reference: str, targets: list[str]) -> Tree:
        """Builds a commit, in a tree of its own."""
        commit = self.commit(reference)
        source = self.folder / "trees" / commit
        if not source.is_dir():
            self._forget_old()
            self._unpack(commit, source)
        os.utime(source)
        return Tree(commit[:12], self._build(source, f"base {commit[:12]}", targets, BENCH_ALONE))

    def _unpack(self, commit: str, source: pathlib.Path) -> None:
        partial = self.folder / "partial"
        shutil.rmtree(partial, ignore_errors=True)
        partial.mkdir(parents=True)
        with subprocess.Popen(["git", "-C", str(self.root), "archive", commit], stdout=subprocess.PIPE) as archive:
            unpacked = subprocess.run(["tar", "-x", "-C", str(partial)], stdin=archive.stdout, check=False)
        if archive.returncode != 0 or unpacked.returncode != 0:
            raise Unmeasured(f"git archive {commit[:12]} failed")
        source.parent.mkdir(exist_ok=True)
        partial.rename(source)

    def _forget_old(self) -> None:
        trees = sorted((self.folder / "trees").glob("*"), key=lambda tree: tree.stat().st_mtime, reverse=True)
        for tree in trees[MOST_TREES - 1:]:
            shutil.rmtree(tree, ignore_errors=True)

    def _build(self, source: pathlib.Path, what: str, targets: list[str],
               options: tuple[str, ...] = ()) -> pathlib.Path:
        environment = dict(os.environ)
        if shutil.which("ccache"):
            # Paths below the source count as relative, so that one tree finds what another compiled.
            environment |= {"CMAKE_CXX_COMPILER_LAUNCHER": "ccache", "CCACHE_BASEDIR": str(source),
                            "CCACHE_NOHASHDIR": "1"}
        build = source / BUILD
        generator = ["-G", "Ninja"] if shutil.which("ninja") else []
        commands = [["cmake", "-S", str(source), "-B", str(build), *generator, *OPTIONS, *options],
                    ["cmake", "--build", str(build), "--parallel", str(os.cpu_count()), "--target", *targets]]
        build.mkdir(parents=True, exist_ok=True)
        log = build / "gate.log"
        with open(log, "w", encoding="utf-8") as file:
            for command in commands:
                try:
                    done = subprocess.run(command, stdout=file, stderr=subprocess.STDOUT, env=environment, check=False)
                except OSError as error:
                    raise Unmeasured(f"{command[0]} does not run: {error}") from error
                if done.returncode != 0:
                    raise BuildFailure(f"{what} does not build {' and '.join(targets)}: {_first_error(log)} (see {log})")
        return build


def _first_error(log: pathlib.Path) -> str:
    lines = log.read_text(errors="replace").splitlines()
    telling = [line.strip() for line in lines if re.search(r"error|unknown target|No rule|failed", line, re.IGNORECASE)]
    return (telling or lines or ["no output"])[0][:200]
