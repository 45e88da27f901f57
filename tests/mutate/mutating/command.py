# SPDX-License-Identifier: MIT
"""The command line of tests/mutate/run."""

from __future__ import annotations

import argparse
import collections
import concurrent.futures
import dataclasses
import json
import pathlib
import queue
import subprocess
import sys
from collections.abc import Iterator

from . import report, survivors
from .groups import GROUPS, candidates, counts
from .report import Result
from .sites import Mutant
from .trees import Broken, Tree, files_of

ROOT = pathlib.Path(__file__).resolve().parents[3]
FOLDER = ROOT / "build/mutants"
SURVIVORS = ROOT / "tests/mutate/survivors.md"
EPILOG = """
Exit code 0: every mutant was caught, or is explained in tests/mutate/survivors.md; 1: some were not; 2: nothing could be
tried, and one line says why. The report is left in build/mutants.
"""


def parse(words: list[str] | None) -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(prog="tests/mutate/run", epilog=EPILOG,
                                     description="Changes one line of the sources at a time, in a copy, and says which "
                                                 "changes the tests do not see.")
    add = parser.add_argument
    add("--count", metavar="N", type=int, default=200, help="how many mutants; default %(default)s")
    add("--seed", metavar="N", type=int, default=1, help="which ones; default %(default)s")
    add("--only", metavar="GROUP", action="append", choices=sorted(GROUPS), help="one of %(choices)s; may be repeated")
    add("--again", action="store_true", help="try those again that survived last time and are not explained, "
        "and bring the report up to date")
    add("--jobs", metavar="N", type=int, default=2, help="in so many copies at a time; default %(default)s")
    add("--json", metavar="FILE", type=pathlib.Path, default=FOLDER / "report.json",
        help="default build/mutants/report.json; what people read stands beside it")
    given = parser.parse_args(words)
    if given.count < 1 or given.jobs < 1:
        parser.error("--count, --jobs: 1 or more")
    return given


def progress(text: str) -> None:
    """Shows how far it is."""
    print(text, file=sys.stderr, flush=True)


def spread(counts: dict[str, int]) -> list[str]:
    """Each name as often as it counts, and evenly, so that what is interrupted has seen of each its share."""
    return [name for _, name in sorted(((i + 0.5) / count, name) for name, count in counts.items() for i in range(count))]


class Run:
    """Mutants on their way through the trees."""

    def __init__(self, trees: list[Tree]):
        self._free: queue.SimpleQueue[Tree] = queue.SimpleQueue()
        for tree in trees:
            self._free.put(tree)
        self._jobs = len(trees)
        self._reasons = survivors.read(SURVIVORS)

    def _try(self, group: str, mutant: Mutant) -> Result:
        tree = self._free.get()
        try:
            outcome = tree.try_out(mutant, group)
        finally:
            self._free.put(tree)
        reason = self._reasons.get(mutant.key, "") if outcome.verdict == "survived" else ""
        progress(f"{outcome.seconds:6.1f} s  {outcome.verdict:11} {mutant.file}:{mutant.line}: {mutant.new.strip()}")
        return Result(group, mutant, outcome, reason)

    def all(self, wanted: dict[str, tuple[list[Mutant], int]]) -> Iterator[Result]:
        """Tries the mutants of each group until so many count, or all are tried. Yields results as they come, those that do
        not count too."""
        left = {group: collections.deque(mutants) for group, (mutants, _) in wanted.items()}
        with concurrent.futures.ThreadPoolExecutor(self._jobs) as pool:
            def submit(group):
                return {pool.submit(self._try, group, left[group].popleft())} if left[group] else set()
            running = set()
            for group in spread({group: count for group, (_, count) in wanted.items()}):
                running |= submit(group)
            while running:
                done, running = concurrent.futures.wait(running, return_when=concurrent.futures.FIRST_COMPLETED)
                for one in (future.result() for future in done):
                    yield one
                    if not one.counts:
                        running |= submit(one.group)


def again(given: argparse.Namespace) -> tuple[list[Result], dict[str, tuple[list[Mutant], int]]]:
    """Last time's results less what survived without a reason, and that: on the lines where it is now, if it is there."""
    reasons = survivors.read(SURVIVORS)
    kept: list[Result] = []
    wanted: dict[str, tuple[list[Mutant], int]] = {}
    for one in report.from_document(json.loads(given.json.read_text(encoding="utf-8"))):
        reason = reasons.get(one.mutant.key, "")
        if one.outcome.verdict != "survived" or reason:
            kept.append(dataclasses.replace(one, reason=reason))
            continue
        file = ROOT / one.mutant.file
        lines = file.read_text(encoding="utf-8").split("\n") if file.is_file() else []
        places = [i for i, line in enumerate(lines, 1) if line == one.mutant.old]
        if not places:
            progress(f"{one.mutant.file} has no line '{one.mutant.old.strip()}' any more: left out")
            continue
        line = min(places, key=lambda place: abs(place - one.mutant.line))
        mutants, count = wanted.get(one.group, ([], 0))
        wanted[one.group] = ([*mutants, dataclasses.replace(one.mutant, line=line)], count + 1)
    return kept, wanted


def write(given: argparse.Namespace, results: list[Result]) -> str:
    """Leaves the report, for machines and people; the latter."""
    given.json.parent.mkdir(parents=True, exist_ok=True)
    given.json.write_text(json.dumps(report.document(results, given.seed), indent=2) + "\n", encoding="utf-8")
    text = report.markdown(results)
    given.json.with_suffix(".md").write_text(text, encoding="utf-8")
    return text


def run(given: argparse.Namespace) -> int:
    """Does what is asked for; the exit code."""
    if given.again:
        kept, wanted = again(given)
    else:
        names = [name for name in GROUPS if not given.only or name in given.only]
        kept, files = [], files_of(ROOT)
        wanted = {name: (candidates(ROOT, files, name, given.seed), count)
                  for name, count in counts(given.count, names).items()}
    trees = [Tree(ROOT, FOLDER / str(i)) for i in range(given.jobs)]
    for tree in trees:  # one after the other: with ccache, the first compiles for all
        tree.build(list(wanted))
    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        list(pool.map(lambda tree: tree.time_tests(list(wanted)), trees))
    results = kept
    for one in Run(trees).all(wanted):
        results = sorted([*results, one], key=lambda one: (one.group, one.mutant))
        write(given, results)  # each time: it takes an hour, and may be interrupted
    print(write(given, results), end="")
    return 1 if report.tally(results)["all"][3] else 0


def main(words: list[str] | None = None) -> int:
    """tests/mutate/run."""
    try:
        return run(parse(words))
    except (Broken, OSError, subprocess.CalledProcessError) as reason:
        print(f"tests/mutate/run: {reason}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("\ntests/mutate/run: interrupted", file=sys.stderr)
        return 2
