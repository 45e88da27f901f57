# SPDX-License-Identifier: MIT
"""The machine that it runs on: which processor, and how busy others keep it."""

from __future__ import annotations

import contextlib
import os
import re
import resource
import time
from collections.abc import Iterator


def processor() -> str:
    """The processor's name, as the system has it."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            found = re.search(r"^model name\s*:\s*(.+)$", file.read(), re.MULTILINE)
    except OSError:
        found = None
    return found.group(1).strip() if found else os.uname().machine


@contextlib.contextmanager
def one_core() -> Iterator[int]:
    """Within it this process, and those that it starts, stay on one core; yields which."""
    allowed = os.sched_getaffinity(0)
    core = max(allowed)
    os.sched_setaffinity(0, {core})
    try:
        yield core
    finally:
        os.sched_setaffinity(0, allowed)


def _all_seconds() -> float:
    """Processor time that the whole machine has spent, by anyone, guests and stolen time included."""
    with open("/proc/stat", encoding="utf-8") as file:
        user, nice, system, _idle, _iowait, irq, soft, steal = map(int, file.readline().split()[1:9])
    return (user + nice + system + irq + soft + steal) / os.sysconf("SC_CLK_TCK")


def _own_seconds() -> float:
    return sum(usage.ru_utime + usage.ru_stime
               for usage in map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)))


class Others:
    """How busy others were from its making on, children of this process that have ended not counted."""

    def __init__(self) -> None:
        self._start = time.monotonic(), _all_seconds(), _own_seconds()

    def processors(self) -> float:
        """How many processors they kept busy, on average."""
        now = time.monotonic(), _all_seconds(), _own_seconds()
        wall, everyone, own = (after - before for after, before in zip(now, self._start))
        return max(0.0, everyone - own) / max(wall, 1e-3)
