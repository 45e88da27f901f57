# SPDX-License-Identifier: MIT
"""What every part of the gate hands to the report: rows with a verdict each."""

from __future__ import annotations

import dataclasses
import enum
from typing import Any


class Unmeasured(Exception):
    """Nothing can be said; the text is the reason, in one line."""


class Broken(Exception):
    """The files as they are do not build; the text says what failed, in one line."""


class Verdict(enum.Enum):
    """The judgment on a row or on a part. The value is the word in reports."""

    PASS = "ok"
    GAIN = "better"
    NOTE = "not judged"
    UNCLEAR = "too noisy"
    REGRESSION = "REGRESSION"


@dataclasses.dataclass
class Row:
    """One case, count or ratio: what was seen beside what it is held against, and what follows."""

    name: str
    verdict: Verdict
    base: float | None = None  # before: the base's, the baseline's, or a bound
    head: float | None = None
    remark: str = ""
    extra: dict[str, Any] = dataclasses.field(default_factory=dict)  # further figures

    @property
    def change(self) -> float | None:
        """head / base - 1, where there is one."""
        if self.base is None or self.head is None or self.base == 0:
            return None
        return self.head / self.base - 1


@dataclasses.dataclass
class Part:
    """Pairs, counts or ratios: its rows, and remarks that concern all of them."""

    name: str
    rows: list[Row] = dataclasses.field(default_factory=list)
    remarks: list[str] = dataclasses.field(default_factory=list)
    unmeasured: str = ""  # why there is nothing to judge
    facts: dict[str, Any] = dataclasses.field(default_factory=dict)  # how it was measured

    def having(self, verdict: Verdict) -> list[Row]:
        """The rows of that verdict."""
        return [row for row in self.rows if row.verdict is verdict]

    @property
    def exit_code(self) -> int:
        """0 pass, 1 regression, 2 not measured."""
        if self.having(Verdict.REGRESSION):
            return 1
        return 2 if self.unmeasured or self.having(Verdict.UNCLEAR) else 0


def exit_code(parts: list[Part]) -> int:
    """A regression in one part counts for more than another that could not be measured."""
    codes = {part.exit_code for part in parts}
    return 1 if 1 in codes else 2 if 2 in codes else 0
