# SPDX-License-Identifier: MIT
"""The history: a line per case and run in a CSV, and its chart over the commits."""

from __future__ import annotations

import csv
import datetime
import pathlib
import re
import shutil
import statistics
import subprocess

from .outcome import Part, Unmeasured

COLUMNS = ["commit", "date", "compiler", "cpu", "case", "value"]
# What a chart has a panel for, and the unit.
CHARTED = ((re.compile(r"^pairs/setup/"), "ns per instance"), (re.compile(r"^pairs/"), "ns per vertex"),
           (re.compile(r"^counts/instructions_per_vertex/avx2/"), "instructions per vertex"),
           (re.compile(r"^counts/instructions_per_instance/avx2/(positions|packed)$"), "instructions per instance"),
           (re.compile(r"^counts/text_bytes/goffer_bend$"), "bytes"))
PANEL_COLUMNS = 4
SCRIPT = pathlib.Path(__file__).resolve().parents[1] / "history.gp"

Series = dict[str, dict[str, list[float]]]  # by case, by commit


def record(path: pathlib.Path, parts: list[Part], facts: dict[str, str]) -> None:
    """Appends what was measured of head; what it was compared with is not recorded."""
    date = datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds")
    where = [facts.get("head", "unknown"), date, facts.get("compiler", "unknown"), facts["processor"]]
    path.parent.mkdir(parents=True, exist_ok=True)
    new = not path.exists()
    with open(path, "a", encoding="utf-8", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        if new:
            rows.writerow(COLUMNS)
        for part in parts:
            for row in part.rows:
                value = row.extra.get("median_of_head", row.head)
                if value is not None:
                    rows.writerow([*where, f"{part.name}/{row.name}", f"{value:.6g}"])


def read(path: pathlib.Path) -> tuple[list[str], Series]:
    """The commits in the order that they were first recorded in, and the values. Takes only the lines that
    have the processor and the compiler of the last one: others' values are not to be compared with its."""
    try:
        with open(path, encoding="utf-8", newline="") as file:
            lines = list(csv.DictReader(file))
        last = lines[-1]
        lines = [line for line in lines if (line["cpu"], line["compiler"]) == (last["cpu"], last["compiler"])]
        series: Series = {}
        for line in lines:
            series.setdefault(line["case"], {}).setdefault(line["commit"], []).append(float(line["value"]))
        return list(dict.fromkeys(line["commit"] for line in lines)), series
    except (OSError, ValueError, KeyError, IndexError) as error:
        raise Unmeasured(f"{path} is no history: {error!r}") from error


def unit_of(case: str) -> str:
    """The unit of a case that is charted, else nothing."""
    return next((unit for pattern, unit in CHARTED if pattern.search(case)), "")


def draw(path: pathlib.Path) -> pathlib.Path:
    """Draws a history beside it; the chart's path."""
    commits, series = read(path)
    panels = {case: of_case for case, of_case in series.items() if unit_of(case)}
    if not panels:
        raise Unmeasured(f"{path} has nothing that is charted")
    if shutil.which("gnuplot") is None:
        raise Unmeasured("gnuplot is not here: bash .ci/setup build installs it")
    data, chart = path.with_suffix(".dat"), path.with_suffix(".svg")
    blocks = ["\n".join(f"{commits.index(commit)} {statistics.median(values):.6g} {min(values):.6g} {max(values):.6g}"
                        for commit, values in of_case.items()) for of_case in panels.values()]
    data.write_text("\n\n\n".join(blocks) + "\n", encoding="utf-8")
    medians = [[statistics.median(values) for values in of_case.values()] for of_case in panels.values()]
    settings = {"data": data, "chart": chart, "columns": PANEL_COLUMNS,
                "titles": " ".join(case.split("/", 1)[1] for case in panels),
                "units": " ".join(unit_of(case).replace(" ", "_") for case in panels),
                "commits": " ".join(commit[:8] for commit in commits),
                "lows": " ".join(f"{0.9 * min(values):.6g}" for values in medians),
                "highs": " ".join(f"{1.1 * max(values) + 1e-9:.6g}" for values in medians)}
    words = "; ".join(f"{key}='{value}'" for key, value in settings.items())
    done = subprocess.run(["gnuplot", "-e", words, str(SCRIPT)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise Unmeasured(f"gnuplot failed: {done.stderr.strip()}")
    return chart
