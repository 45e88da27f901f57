# SPDX-License-Identifier: MIT
"""bench/baseline.json: what counts should be, with the compiler that made them so, and the bounds of ratios."""

from __future__ import annotations

import json
import pathlib

from . import cases
from .outcome import Part, Row, Unmeasured, Verdict

TOLERANCE = 0.02


def read(path: pathlib.Path) -> dict:
    """The file's document."""
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise Unmeasured(f"{path} cannot be read: {error}") from error


def write(path: pathlib.Path, compiler: str, counts: dict[str, float]) -> None:
    """Sets the counts; bounds stay. A line for each count, in order, so that a diff shows what moved."""
    document = read(path) if path.exists() else {}
    document |= {"compiler": compiler, "counts": dict(sorted(counts.items()))}
    path.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")


def compare(name: str, was: float | None, now: float | None, isas: set[str]) -> Row:
    """One count. More is worse. `isas`: those that are counted here."""
    if was is None:
        return Row(name, Verdict.NOTE, None, now, "not in the baseline: `bench/gate --update` adds it")
    if now is None:
        if not cases.isas_of([name]) <= isas:
            return Row(name, Verdict.NOTE, was, None, "of an instruction set that is not counted here")
        return Row(name, Verdict.REGRESSION, was, None, "no longer counted; `bench/gate --update` drops it")
    row = Row(name, Verdict.PASS, was, now)
    if now - was > TOLERANCE * was:
        row.verdict = Verdict.REGRESSION
        row.remark = "if it is meant to be so, `bench/gate --update`"
    elif was - now > TOLERANCE * was:
        row.verdict, row.remark = Verdict.GAIN, "`bench/gate --update` keeps it so"
    return row


def judge(baseline: dict, compiler: str, counts: dict[str, float]) -> Part:
    """The part of the report."""
    part = Part("counts", facts={"compiler": compiler, "tolerance": TOLERANCE})
    expected = baseline.get("counts", {})
    if baseline.get("compiler") != compiler:
        part.remarks.append(f"Counts are of {compiler}, the baseline is of {baseline.get('compiler', 'no compiler')}: "
                            "reported, not compared.")
        part.rows = [Row(name, Verdict.NOTE, expected.get(name), value) for name, value in counts.items()]
        return part
    isas = cases.isas_of(counts)
    part.rows = [compare(name, expected.get(name), counts.get(name), isas) for name in sorted({*expected, *counts})]
    return part
