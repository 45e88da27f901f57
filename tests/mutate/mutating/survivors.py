# SPDX-License-Identifier: MIT
"""survivors.md: changes that no test sees, and why none need."""

from __future__ import annotations

import pathlib
import re

# Under the heading of a file: the line as it is and as it would be, and the reason.
HEADING = re.compile(r"^## `(.+)`$")
ENTRY = re.compile(r"```diff\n- (.*)\n\+ (.*)\n```\n+((?:(?!```|## ).+\n?)+)", re.M)


def read(path: pathlib.Path) -> dict[tuple[str, str, str], str]:
    """The reasons, by file, line as it is, and line as it would be."""
    reasons = {}
    for part in re.split(r"^(?=## )", path.read_text(encoding="utf-8"), flags=re.M):
        heading = HEADING.match(part.split("\n", 1)[0])
        for entry in ENTRY.finditer(part) if heading else ():
            reasons[heading[1], entry[1].strip(), entry[2].strip()] = " ".join(entry[3].split())
    return reasons
