# SPDX-License-Identifier: MIT
"""Base and head side by side.

The two programs of a pair run one case at the same time, on the same core: the system's scheduler gives them turns of
some milliseconds, base, head, base, head, and each is timed by its own processor time. A slow spell of the machine, a
change of frequency, another process: they hit both alike. Which of the two is started first alternates from pair to pair.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable

from .judgment import Estimate, estimates
from .machine import Others, one_core
from .outcome import Part, Row, Unmeasured, Verdict
from .programs import Run, cases_of, time_of

SECONDS = 0.03  # that a case is timed for in each run, at least
MINUTES = 5  # after which nothing is measured again
ROUNDS = 3  # of measuring a case that is too noisy: so many pairs, as many again, twice as many again

Pair = tuple[float, float]  # base's time, head's time
Pairs = dict[str, list[Pair]]


def measure_pair(programs: tuple[str, str], case: str, swapped: bool) -> Pair:
    """One pair of a case."""
    runs: dict[bool, Run] = {}
    try:
        for is_head in (swapped, not swapped):
            runs[is_head] = Run(programs[is_head], [case], SECONDS)
        times = []
        for is_head in (False, True):
            counters = runs[is_head].counters()
            if case not in counters:
                raise Unmeasured(f"{programs[is_head]} did not run {case}")
            times.append(time_of(counters[case]))
        return times[0], times[1]
    finally:
        for run in runs.values():
            run.stop()


class Comparison:
    """Two programs, and the pairs that were measured of them."""

    def __init__(self, programs: tuple[str, str], count: int, threshold: float,
                 progress: Callable[[str], None] = lambda text: None):
        self._programs = programs
        self._count = count
        self._threshold = threshold
        self._progress = progress
        self._measured = 0
        self._until = time.monotonic() + 60 * MINUTES

    def judge(self, cases: list[str]) -> list[Row]:
        """A row for each case. Those that seem slower are measured once more, from the start."""
        with one_core():
            for case in cases:
                measure_pair(self._programs, case, False)  # a first run loads the program, and counts for nothing
            first = self._until_clear(cases)
            found = estimates(first)
            suspects = [case for case, one in found.items() if one.slower() and one.change > self._threshold]
            again = self._until_clear(suspects) if suspects else {}
        confirmed = estimates(again) if again else {}
        return [self._row(case, first[case], again.get(case, []), found[case], confirmed.get(case)) for case in cases]

    def _until_clear(self, cases: list[str]) -> Pairs:
        """Pairs of all cases, and more of those that are too noisy."""
        pairs: Pairs = {case: [] for case in cases}
        left, count = cases, self._count
        for _ in range(ROUNDS):
            self._add(pairs, left, count)
            count = len(pairs[left[0]])
            found = estimates(pairs)
            left = [case for case in cases if found[case].unclear(self._threshold)]
            if not left or time.monotonic() > self._until:
                break
        return pairs

    def _add(self, pairs: Pairs, cases: list[str], count: int) -> None:
        for i in range(count):
            for case in cases:
                self._progress(f"pair {i + 1} of {count}: {case}")
                pairs[case].append(measure_pair(self._programs, case, swapped=self._measured % 2 == 1))
            self._measured += 1

    def _row(self, case: str, first: list[Pair], again: list[Pair], one: Estimate, two: Estimate | None) -> Row:
        # A suspect's change is that of all its pairs: those that roused the suspicion exaggerate it.
        shown = one if two is None else estimates({case: first + again})[case]
        verdict, remark = self._verdict(one, two, shown)
        base, head = (statistics.median(times) for times in zip(*first, *again))
        return Row(case, verdict, base, base * (1 + shown.change), remark,
                   {"median_of_head": head, "low": shown.low, "high": shown.high, "p": (two or one).p,
                    "pairs": shown.pairs})

    def _verdict(self, one: Estimate, two: Estimate | None, both: Estimate) -> tuple[Verdict, str]:
        if two is not None and two.unclear(self._threshold):
            return Verdict.UNCLEAR, "seemed slower at first; too noisy to be confirmed"
        if two is not None:
            if two.slower() and both.change > self._threshold:
                return Verdict.REGRESSION, "seen in two sets of pairs"
            return Verdict.PASS, "seemed slower at first; not confirmed by a second set of pairs"
        if one.unclear(self._threshold):
            return Verdict.UNCLEAR, "no change and one above the threshold are both in the interval"
        if one.faster() and one.change < -self._threshold:
            return Verdict.GAIN, ""
        return Verdict.PASS, "slower, by less than the threshold" if one.slower() else ""


def common_cases(programs: tuple[str, str], wanted: list[str]) -> tuple[list[str], list[str]]:
    """Returns the wanted cases that both programs have, and a remark on each that only one has."""
    base, head = (set(cases_of(program)) for program in programs)
    remarks = [f"`{case}` is not in the base: not compared" for case in wanted if case in head - base]
    remarks += [f"`{case}` is in the base alone: not compared" for case in wanted if case in base - head]
    return [case for case in wanted if case in base and case in head], remarks


def compare(programs: tuple[str, str], wanted: list[str], count: int, threshold: float,
            progress: Callable[[str], None]) -> Part:
    """The part of the report."""
    part = Part("pairs")
    try:
        if not wanted:
            raise Unmeasured("--cases fits the name of no pair")
        cases, part.remarks = common_cases(programs, wanted)
        if not cases:
            raise Unmeasured("base and head have no case in common")
        others = Others()
        part.rows = Comparison(programs, count, threshold, progress).judge(cases)
        part.facts = {"threshold": threshold, "others": round(others.processors(), 2)}
        part.remarks.append(f"Meanwhile others kept {others.processors():.1f} processors busy.")
    except Unmeasured as reason:
        part.unmeasured = str(reason)
    return part
