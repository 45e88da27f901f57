# SPDX-License-Identifier: MIT
"""What became of the mutants, for machines and people."""

from __future__ import annotations

import dataclasses

from .sites import Mutant
from .trees import Outcome


@dataclasses.dataclass(frozen=True)
class Result:
    """A mutant that was tried."""

    group: str
    mutant: Mutant
    outcome: Outcome
    reason: str = ""  # why it is no matter that it survived

    @property
    def counts(self) -> bool:
        """Whether it was a change of the program at all."""
        return self.outcome.verdict in ("caught", "survived")


def document(results: list[Result], seed: int) -> dict:
    """The results as JSON."""
    return {"seed": seed, "mutants": [{"group": one.group, **dataclasses.asdict(one.mutant),
                                       **dataclasses.asdict(one.outcome), "reason": one.reason} for one in results]}


def from_document(found: dict) -> list[Result]:
    """The results that a document tells of."""
    def part(kind, entry):
        return kind(**{field.name: entry[field.name] for field in dataclasses.fields(kind)})
    return [Result(entry["group"], part(Mutant, entry), part(Outcome, entry), entry["reason"]) for entry in found["mutants"]]


def tally(results: list[Result]) -> dict[str, list[int]]:
    """Counts for each group and for all: mutants, caught, survived and explained, survived and not explained."""
    rows: dict[str, list[int]] = {}
    for one in results:
        if one.counts:
            column = 1 if one.outcome.verdict == "caught" else 2 if one.reason else 3
            for name in (one.group, "all"):
                row = rows.setdefault(name, [0, 0, 0, 0])
                row[0] += 1
                row[column] += 1
    rows["all"] = rows.pop("all", [0, 0, 0, 0])  # last
    return rows


def listed(results: list[Result]) -> list[str]:
    """Where, the change, and the reason if there is one."""
    lines = []
    for one in sorted(results, key=lambda one: one.mutant):
        mutant = one.mutant
        lines += [f"`{mutant.file}:{mutant.line}` ({mutant.kind})", "", "```diff", f"- {mutant.old.strip()}",
                  f"+ {mutant.new.strip()}", "```", "", *([one.reason, ""] if one.reason else [])]
    return lines


def markdown(results: list[Result]) -> str:
    """The report."""
    rows = tally(results)
    lines = ["# Mutants", "", "| group | mutants | caught | | explained | not explained |", "|---|---|---|---|---|---|"]
    for name, (count, caught, explained, left) in rows.items():
        lines.append(f"| {name} | {count} | {caught} | {100 * caught / max(count, 1):.0f} % | {explained} | {left} |")
    survived = [one for one in results if one.outcome.verdict == "survived"]
    for title, explained in ("Not explained", False), ("Explained", True):
        if found := [one for one in survived if bool(one.reason) == explained]:
            lines += ["", f"## {title}", "", *listed(found)[:-1]]
    timed = [one.outcome.seconds for one in results if one.counts]
    others = len(results) - len(timed)
    lines += ["", f"{sum(timed) / max(len(timed), 1):.1f} s a mutant. {others} more did not count: they were not compiled, or "
              "into the same program, or they got stuck."]
    return "\n".join(lines) + "\n"
