# SPDX-License-Identifier: MIT
"""Runs goffer_bench, and reads what it measured."""

from __future__ import annotations

import dataclasses
import json
import os
import subprocess
import tempfile
from collections.abc import Iterable

from .outcome import Unmeasured

MOST_SECONDS = 300  # of one run; a case takes a second or less


def pattern(cases: Iterable[str]) -> str:
    """Google Benchmark's filter for exactly these cases."""
    return "^(" + "|".join(case.replace("+", "[+]").replace(".", "[.]") for case in cases) + ")$"


def cases_of(program: str) -> list[str]:
    """The names of all cases that a program has, the sweep's included."""
    command = [program, "--sweep", "--benchmark_list_tests"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=MOST_SECONDS, check=True)
    except (OSError, subprocess.SubprocessError) as error:
        raise Unmeasured(f"{program} does not list its cases: {error}") from error
    return done.stdout.split()


@dataclasses.dataclass
class Run:
    """A program that runs some cases, from its making on."""

    program: str
    cases: list[str]
    seconds: float  # the least that each is timed for

    def __post_init__(self) -> None:
        handle, self._path = tempfile.mkstemp(suffix=".json")
        os.close(handle)
        command = [self.program, "--sweep", f"--benchmark_filter={pattern(self.cases)}",
                   f"--benchmark_min_time={self.seconds}", f"--benchmark_out={self._path}",
                   "--benchmark_out_format=json"]
        try:
            self._process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        except OSError as error:
            os.unlink(self._path)
            raise Unmeasured(f"{self.program} does not start: {error}") from error

    def counters(self) -> dict[str, dict[str, float]]:
        """Waits for its end. By case, the counters that goffer_bench sets (bench/README.md), and the wall clock's time."""
        try:
            try:
                complaint = self._process.communicate(timeout=MOST_SECONDS)[1]
            except subprocess.TimeoutExpired:
                raise Unmeasured(f"{self.program} ran for more than {MOST_SECONDS} s") from None
            if self._process.returncode != 0:
                lines = complaint.decode(errors="replace").strip().splitlines()
                raise Unmeasured(f"{self.program} failed ({self._process.returncode}): {lines[-1] if lines else ''}")
            with open(self._path, encoding="utf-8") as file:
                return dict(map(_counters, json.load(file)["benchmarks"]))
        except (ValueError, KeyError) as error:
            raise Unmeasured(f"{self.program} wrote no readable result: {error!r}") from error
        finally:
            self.stop()

    def stop(self) -> None:
        """Ends it if it still runs, and removes its file."""
        if self._process.poll() is None:
            self._process.kill()
            self._process.wait()
        self._process.stderr.close()
        if os.path.exists(self._path):
            os.unlink(self._path)


def _counters(run: dict) -> tuple[str, dict[str, float]]:
    if run.get("error_occurred"):
        raise Unmeasured(f"{run['name']}: {run.get('error_message', 'failed')}")
    return run["name"], {key: value for key, value in run.items()
                         if key in ("ns_per_vertex", "ns_per_instance", "of_floor", "real_time")}


def time_of(counters: dict[str, float]) -> float:
    """Nanoseconds per vertex, or per instance."""
    return counters["ns_per_vertex"] if "ns_per_vertex" in counters else counters["ns_per_instance"]
