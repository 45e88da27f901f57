# SPDX-License-Identifier: MIT
"""The report: Markdown for people, JSON for programs, a few lines for the terminal."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

from .outcome import Part, Row, Verdict, exit_code

TITLES = {"pairs": "Pairs: head against base", "counts": "Counts: against bench/baseline.json",
          "ratios": "Ratios: against their bounds"}
WORDS = {0: "pass", 1: "REGRESSION", 2: "could not measure"}


def figure(value: float | None) -> str:
    """With four digits or so."""
    if value is None:
        return ""
    return f"{value:.0f}" if abs(value) >= 1000 or value == int(value) else f"{value:.4g}"


def percent(change: float | None) -> str:
    """With its sign."""
    return "" if change is None or not math.isfinite(change) else f"{100 * change:+.1f} %"


def change_of(row: Row) -> str:
    """As per cent where it can be said so."""
    if row.base == 0 and row.head:
        return f"from 0 to {figure(row.head)}"
    return percent(row.change)


def table(heads: list[str], rows: list[list[str]]) -> list[str]:
    """A Markdown table."""
    lines = ["| " + " | ".join(heads) + " |", "|---|" + "---:|" * (len(heads) - 2) + "---|"]
    return lines + ["| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in rows]


def word(row: Row) -> str:
    """The verdict, with its remark."""
    verdict = f"**{row.verdict.value}**" if row.verdict is Verdict.REGRESSION else row.verdict.value
    return f"{verdict}: {row.remark}" if row.remark else verdict


def pair_table(rows: list[Row]) -> list[str]:
    """Makes the table of pairs."""
    return table(["case", "base, ns", "head, ns", "change", "interval", "p", "pairs", "verdict"],
                 [[f"`{row.name}`", figure(row.base), figure(row.head), percent(row.change),
                   f"{percent(row.extra['low'])} .. {percent(row.extra['high'])}", f"{row.extra['p']:.2g}",
                   str(row.extra["pairs"]), word(row)] for row in rows])


def count_table(rows: list[Row]) -> list[str]:
    """Makes the table of counts: what moved in sight, the rest folded away."""
    cells = {row.name: [f"`{row.name}`", figure(row.base), figure(row.head), change_of(row), word(row)] for row in rows}
    heads = ["count", "baseline", "head", "change", "verdict"]
    moved = [cells[row.name] for row in rows if row.verdict is not Verdict.PASS]
    rest = [cells[row.name] for row in rows if row.verdict is Verdict.PASS]
    lines = table(heads, moved) if moved else []
    if rest:
        lines += ["", f"<details><summary>{len(rest)} counts within the tolerance</summary>", "", *table(heads, rest),
                  "", "</details>"]
    return lines


def ratio_table(rows: list[Row]) -> list[str]:
    """Makes the table of ratios."""
    return table(["ratio", "bound", "best", "verdict"],
                 [[f"`{row.name}`", figure(row.base), figure(row.head), word(row)] for row in rows])


TABLES = {"pairs": pair_table, "counts": count_table, "ratios": ratio_table}


def part_lines(part: Part) -> list[str]:
    """A section of the report."""
    lines = ["", f"## {TITLES[part.name]}", ""]
    if part.unmeasured:
        lines += [f"**Could not measure:** {part.unmeasured}", ""]
    if part.rows:
        lines += [*TABLES[part.name](part.rows), ""]
    return lines + [line for remark in part.remarks for line in (remark, "")][:-1]


def markdown(parts: list[Part], facts: dict[str, Any]) -> str:
    """The whole report. `facts`: what the first line says."""
    said = ", ".join(f"{key} {value}" for key, value in facts.items() if value)
    lines = [f"# Benchmark gate: {WORDS[exit_code(parts)]}", "", f"{said}. How to read it: bench/README.md."]
    for part in parts:
        lines += part_lines(part)
    return "\n".join(lines).rstrip() + "\n"


def broken_markdown(reason: str) -> str:
    """The whole report where head does not build."""
    return f"# Benchmark gate: does not build\n\n{reason}\n"


def broken_document(reason: str) -> dict[str, Any]:
    """The same for programs."""
    return {"exit_code": 1, "broken": reason, "parts": []}


def document(parts: list[Part], facts: dict[str, Any]) -> dict[str, Any]:
    """The same for programs."""
    def plain(row: Row) -> dict[str, Any]:
        return {"name": row.name, "verdict": row.verdict.name.lower(), "base": row.base, "head": row.head,
                "change": row.change, "remark": row.remark, **row.extra}
    return {"exit_code": exit_code(parts), **facts,
            "parts": [{**dataclasses.asdict(part), "exit_code": part.exit_code,
                       "rows": [plain(row) for row in part.rows]} for part in parts]}


def summary(parts: list[Part]) -> list[str]:
    """A line for each part, and one for each row that is to be looked at."""
    lines = []
    for part in parts:
        tally = ", ".join(f"{len(part.having(verdict))} {verdict.value}" for verdict in Verdict if part.having(verdict))
        lines.append(f"{part.name + ':':8}{WORDS[part.exit_code]} ({part.unmeasured or tally or part.remarks[0]})")
        lines += [f"  {row.name}: {change_of(row) or figure(row.head)} {row.verdict.value}"
                  for row in part.rows if row.verdict in (Verdict.REGRESSION, Verdict.UNCLEAR, Verdict.GAIN)]
    return lines
