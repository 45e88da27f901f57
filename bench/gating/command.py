# SPDX-License-Identifier: MIT
"""The command line of bench/gate."""

from __future__ import annotations

import argparse
import filecmp
import json
import os
import pathlib
import re
import sys

from . import baseline, cases, counts, history, machine, ratios, report
from .outcome import Broken, Part, Unmeasured, exit_code
from .trees import Repository, Tree

ROOT = pathlib.Path(__file__).resolve().parents[2]
PARTS = ("counts", "ratios", "pairs")
EPILOG = """
Exit code 0: no regression; 1: a regression, or the files do not build; 2: it could not be measured, and one line says
why. bench/README.md says how to read the report, and how noise is handled.
"""


def parse(words: list[str] | None) -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(prog="bench/gate", epilog=EPILOG,
                                     description="Whether the files as they are (head) are slower than a commit "
                                                 "(base), or than bench/baseline.json says.")
    add = parser.add_argument
    folder = ROOT / "build/gate"
    add("--base", metavar="REF", help="the commit to compare with; by default where this branch left the main one, "
        "and on the main one the commit before")
    add("--only", metavar="PARTS", default=",".join(PARTS), help="which of counts,ratios,pairs; all by default")
    add("--cases", metavar="REGEX", default="", help="compare only the pairs whose names it is found in")
    add("--pairs", metavar="N", type=int, default=20, help="pairs of each case, at least 15; default %(default)s")
    add("--threshold", metavar="PERCENT", type=float, default=5, help="a slowdown that is above it fails; default "
        "%(default)s")
    add("--skip-same", action="store_true", help="measure no pairs where base and head are the same program")
    add("--programs", metavar=("BASE", "HEAD"), nargs=2, help="compare these instead of building any; pairs alone")
    add("--baseline", metavar="FILE", type=pathlib.Path, default=ROOT / "bench/baseline.json", help="instead of "
        "bench/baseline.json")
    add("--update", action="store_true", help="write head's counts into the baseline, and do nothing else")
    add("--json", metavar="FILE", type=pathlib.Path, default=folder / "report.json",
        help="default build/gate/report.json")
    add("--markdown", metavar="FILE", type=pathlib.Path, default=folder / "report.md",
        help="default build/gate/report.md")
    add("--record", metavar="CSV", type=pathlib.Path, nargs="?", const=folder / "history.csv",
        help="append what was measured to a history; default build/gate/history.csv")
    add("--chart", metavar="CSV", type=pathlib.Path, nargs="?", const=folder / "history.csv",
        help="draw a history beside it, as SVG, and do nothing else")
    given = parser.parse_args(words)
    given.only = set(filter(None, given.only.split(",")))
    if unknown := given.only - set(PARTS):
        parser.error(f"no such part: {', '.join(sorted(unknown))}; there are {', '.join(PARTS)}")
    if not given.only:
        parser.error(f"--only: one or more of {', '.join(PARTS)}")
    try:
        re.compile(given.cases)
    except re.error as fault:
        parser.error(f"--cases: no regular expression: {fault}")
    if given.pairs < 15:
        parser.error("--pairs: 15 or more")
    if given.programs:
        given.only = {"pairs"}
    return given


def progress(text: str) -> None:
    """Shows what is being done, where somebody may be looking."""
    if sys.stderr.isatty():
        sys.stderr.write(f"\r\033[K{text[:110]}")
        sys.stderr.flush()


class Gate:
    """One run of the command."""

    def __init__(self, given: argparse.Namespace):
        self._given = given
        self._repository = Repository(ROOT)
        self._head: Tree | None = None
        self._facts: dict[str, str] = {}

    def head(self) -> Tree:
        """The files as they are, built."""
        if self._head is None:
            progress("building head")
            self._head = self._repository.head(["goffer_bench", "goffer_count"])
        return self._head

    def update(self) -> None:
        """Writes the baseline's counts."""
        found = counts.count(self.head())
        baseline.write(self._given.baseline, self.head().compiler(), found)
        print(f"{self._given.baseline}: {len(found)} counts of {self.head().compiler()}")

    def measure(self) -> list[Part]:
        """All parts that are wanted. A part that cannot be measured says so, and the others go on."""
        if not self._given.programs:
            self.head()  # first: Broken, whatever else is missing
        parts = []
        for name in PARTS:
            if name in self._given.only:
                try:
                    parts.append(getattr(self, name)())
                except Unmeasured as reason:
                    parts.append(Part(name, unmeasured=str(reason)))
        return parts

    def counts(self) -> Part:
        """Counts against the baseline."""
        progress("counting")
        return baseline.judge(baseline.read(self._given.baseline), self.head().compiler(), counts.count(self.head()))

    def ratios(self) -> Part:
        """Ratios against their bounds."""
        return ratios.judge(baseline.read(self._given.baseline), self.head().program("goffer_bench"), progress)

    def pairs(self) -> Part:
        """Head against base."""
        from . import pairs, programs  # here, so that counts and ratios go without SciPy
        both = tuple(self._given.programs) if self._given.programs else self._built()
        same = all(map(os.path.exists, both)) and filecmp.cmp(*both, shallow=False)
        remark = "Base and head are the same program, byte for byte."
        if same and self._given.skip_same:
            return Part("pairs", remarks=[remark + " Nothing was measured."])
        wanted = cases.paired(programs.cases_of(both[1]), self._given.cases)
        part = pairs.compare(both, wanted, self._given.pairs, self._given.threshold / 100, progress)
        part.remarks += [remark] if same else []
        return part

    def _built(self) -> tuple[str, str]:
        reference = self._given.base or self._repository.default_base()
        self._repository.commit(reference)
        head = self.head()
        progress("building base")
        base = self._repository.base(reference, ["goffer_bench"])
        self._facts["base"] = base.label
        return base.program("goffer_bench"), head.program("goffer_bench")

    def facts(self) -> dict[str, str]:
        """What was measured, and on what."""
        if self._head is not None:
            self._facts |= {"head": self._head.label, "compiler": self._head.compiler()}
        return self._facts | {"processor": machine.processor()}


def write(path: pathlib.Path, text: str) -> None:
    """Makes the folder as well."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def run(given: argparse.Namespace) -> int:
    """Does what is asked for; the exit code."""
    if given.chart:
        print(history.draw(given.chart))
        return 0
    gate = Gate(given)
    if given.update:
        gate.update()
        return 0
    try:
        parts = gate.measure()
    except Broken as reason:
        write(given.markdown, report.broken_markdown(str(reason)))
        write(given.json, json.dumps(report.broken_document(str(reason)), indent=2) + "\n")
        raise
    progress("")
    facts = gate.facts()
    write(given.markdown, report.markdown(parts, facts))
    write(given.json, json.dumps(report.document(parts, facts), indent=2) + "\n")
    if given.record:
        history.record(given.record, parts, facts)
    print("\n".join(report.summary(parts)))
    for part in parts:
        if part.exit_code == 2:
            reason = part.unmeasured or "too noisy: " + ", ".join(row.name for row in part.rows
                                                                  if row.verdict.name == "UNCLEAR")
            print(f"bench/gate: {part.name}: {reason}", file=sys.stderr)
    return exit_code(parts)


def main(words: list[str] | None = None) -> int:
    """bench/gate."""
    try:
        return run(parse(words))
    except (Broken, Unmeasured, OSError) as reason:
        progress("")
        print(f"bench/gate: {reason}", file=sys.stderr)
        return 1 if isinstance(reason, Broken) else 2
    except KeyboardInterrupt:
        print("\nbench/gate: interrupted", file=sys.stderr)
        return 2
    except ImportError as error:
        print(f"bench/gate: {error}: bash .ci/setup bench installs it", file=sys.stderr)
        return 2
