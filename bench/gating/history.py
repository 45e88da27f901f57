# SPDX-License-Identifier: MIT
"""The history: a line per case and run in a CSV, and its chart over the commits."""

from __future__ import annotations

import pathlib

from .outcome import Part, Unmeasured


def record(path: pathlib.Path, parts: list[Part], facts: dict[str, str]) -> None:
    raise Unmeasured("not yet")


def draw(path: pathlib.Path) -> pathlib.Path:
    raise Unmeasured("not yet")
