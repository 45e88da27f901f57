# SPDX-License-Identifier: MIT
"""Ratios of times of one run, against bounds that are wide enough for any machine: what no machine should fall below.

A bound is a case's that is judged by the best of several tries. Two threads tell nothing while others keep the machine
busy, or where two processors are not worth two: what two programs reach that run beside each other and share nothing is
then held against them.
"""

from __future__ import annotations

import contextlib
import os
import statistics
from collections.abc import Callable

from . import cases
from .machine import Others
from .outcome import Part, Row, Unmeasured, Verdict
from .programs import Run, cases_of, time_of

TRIES = 4
SECONDS = 0.05  # that a case is timed for in each try, at least
SECONDS_TOGETHER = 0.3  # the same where two programs run at once, and start in the same moment or nearly
BUSY = 0.1  # processors that others keep busy, from which on threads are not judged
OF_TWO_PROGRAMS = 0.85  # of what two programs reach, two threads should

Counters = dict[str, dict[str, float]]


def naive_of(case: str) -> str:
    """The naive case of the same streams."""
    return "naive/" + case.split("/")[1].split("-")[-1]


def of_floor(case: str, seen: Counters) -> float:
    """The floor's time over the case's."""
    return seen[case]["of_floor"]


def over_naive(case: str, seen: Counters) -> float:
    """The naive code's time over the case's."""
    return time_of(seen[naive_of(case)]) / time_of(seen[case])


def two_threads(case: str, seen: Counters) -> float:
    """One thread's time over that of two."""
    return time_of(seen[f"{case}/1"]) / time_of(seen[f"{case}/2"])


# By the name in the baseline: how it is computed, and of which cases.
KINDS: dict[str, tuple[Callable[[str, Counters], float], Callable[[str], list[str]]]] = {
    "of_floor": (of_floor, lambda case: [case]),
    "over_naive": (over_naive, lambda case: [case, naive_of(case)]),
    "two_threads": (two_threads, lambda case: [f"{case}/1", f"{case}/2"]),
}


def two_programs(program: str, case: str) -> float:
    """How many times as much of a case of one thread two processes do at once, by the wall clock, as one that is alone."""
    def run() -> Run:
        return Run(program, [case], SECONDS_TOGETHER)

    alone = run().counters()[case]["real_time"]
    with contextlib.ExitStack() as at_end:
        both = []
        for _ in range(2):
            both.append(run())
            at_end.callback(both[-1].stop)
        return 2 * alone / statistics.mean(one.counters()[case]["real_time"] for one in both)


class Bound:
    """One ratio, and what was seen of it."""

    def __init__(self, kind: str, case: str, at_least: float, impossible: bool):
        """`impossible`: the machine lacks the instruction set, or a second processor."""
        self.name = f"{kind} {case}"
        self.at_least = at_least
        self.threads = kind == "two_threads"
        self.impossible = impossible
        self.best: float | None = None
        self.busy = 0.0  # processors that others kept busy in the quietest try
        self.reached = 0.0  # the most that two programs did
        self._case = case
        self._ratio, needs = KINDS[kind]
        self.needs = needs(case)

    def look(self, seen: Counters, busy: float) -> None:
        """Takes in a try."""
        self.busy = busy if self.best is None else min(self.busy, busy)
        self.best = max(self.best or 0, self._ratio(self._case, seen))

    def try_two_programs(self, program: str) -> None:
        """Takes in what two programs reach where two threads reach too little."""
        self.reached = max(self.reached, two_programs(program, f"{self._case}/1"))

    def is_met(self) -> bool:
        """Whether a try was good enough."""
        return self.best is not None and self.best >= self.at_least

    def row(self) -> Row:
        """Returns its row of the report."""
        row = Row(self.name, Verdict.PASS, self.at_least, self.best)
        if self.best is None and self.impossible:
            row.verdict, row.remark = Verdict.NOTE, "not on this machine"
        elif self.best is None:
            row.verdict, row.remark = Verdict.REGRESSION, "the program has no such case"
        elif not self.is_met() and self.threads and self.busy >= BUSY:
            row.verdict, row.remark = Verdict.NOTE, f"the machine is busy: others kept {self.busy:.1f} processors"
        elif not self.is_met() and self.threads and self.best >= OF_TWO_PROGRAMS * self.reached:
            row.verdict, row.remark = Verdict.NOTE, f"two programs beside each other reach no more than {self.reached:.2f}"
        elif not self.is_met():
            row.verdict, row.remark = Verdict.REGRESSION, f"below its bound in each of {TRIES} tries"
        return row


def bounds_of(baseline: dict, names: list[str]) -> list[Bound]:
    """The bounds in a baseline, given the cases that the program has."""
    found, isa, one = cases.isas_of(names), cases.widest(names), (os.cpu_count() or 1) < 2
    bounds = []
    for kind, of_kind in baseline.get("ratios", {}).items():
        if kind not in KINDS:
            raise Unmeasured(f"the baseline has bounds of the kind '{kind}'; there are {', '.join(KINDS)}")
        for pattern, at_least in of_kind.items():
            case = cases.resolve(pattern, isa)
            impossible = not cases.isas_of([case]) <= found or (one and kind == "two_threads")
            bounds.append(Bound(kind, case, at_least, impossible))
    return bounds


def judge(baseline: dict, program: str, progress: Callable[[str], None]) -> Part:
    """The part of the report."""
    part = Part("ratios", facts={"tries": TRIES})
    try:
        names = set(cases_of(program))
        bounds = bounds_of(baseline, list(names))
        if not bounds:
            raise Unmeasured("the baseline has no bounds")
        for number in range(TRIES):
            left = [bound for bound in bounds if not bound.is_met() and names.issuperset(bound.needs)]
            _try(left, program, lambda text, number=number: progress(f"try {number + 1}: {text}"))
        part.rows = [bound.row() for bound in bounds]
    except Unmeasured as reason:
        part.unmeasured = str(reason)
    if (os.cpu_count() or 1) < 2:
        part.remarks.append("This machine has one processor: nothing is said of two threads.")
    return part


def _try(bounds: list[Bound], program: str, progress: Callable[[str], None]) -> None:
    """Measures what these bounds need: those of one thread in one run, those of more each in one of their own."""
    groups = [[bound for bound in bounds if not bound.threads], *([bound] for bound in bounds if bound.threads)]
    for group in groups:
        needs = sorted({case for bound in group for case in bound.needs})
        if not needs:
            continue
        progress(", ".join(needs))
        others = Others()
        seen = Run(program, needs, SECONDS).counters()
        busy = others.processors()
        for bound in group:
            bound.look(seen, busy)
            if bound.threads and not bound.is_met():
                progress(f"{bound.name}: two programs")
                bound.try_two_programs(program)
