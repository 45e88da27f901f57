#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the report of a benchmark run: a table and a chart.

    report.py RESULT.json FOLDER

reads what goffer_bench --sweep --benchmark_out wrote, and writes FOLDER/report.md, FOLDER/sweep.dat and, drawn from it
with gnuplot, FOLDER/sweep.svg.
"""

import json
import os
import statistics
import subprocess
import sys

FLOATS = {"positions": 3, "positions+normals": 6}  # written per vertex, by the sweep's streams
FLOOR_FLOATS = 3  # what a vertex is in the floor/ cases
UNITS = {"ns_per_vertex": "vertex", "ns_per_instance": "instance"}


class Case:
    """The repetitions of one case."""

    def __init__(self):
        self.times = []  # ns
        self.unit = ""  # of what
        self.of_floor = []
        self.rates = []  # bytes per second

    def add(self, run):
        for counter, unit in UNITS.items():
            if counter in run:
                self.times.append(run[counter])
                self.unit = unit
        self.of_floor += [run["of_floor"]] if "of_floor" in run else []
        self.rates += [run["bytes_per_second"]] if "bytes_per_second" in run else []

    def time(self):
        return statistics.median(self.times)

    def spread(self):
        """The middle half of the repetitions, in per cent of the median."""
        if len(self.times) < 3:
            return None
        low, _, high = statistics.quantiles(self.times, n=4, method="inclusive")
        return 100 * (high - low) / self.time()


def read(path):
    """The context and the cases by name, in the order that they are registered in, whatever order they ran in."""
    with open(path, encoding="utf-8") as file:
        result = json.load(file)
    cases = {}
    for run in sorted(result["benchmarks"], key=lambda run: run["family_index"]):
        if run.get("error_occurred"):
            sys.exit(f"report.py: {run['name']}: {run.get('error_message', 'failed')}")
        if run["run_type"] == "iteration":
            cases.setdefault(run["run_name"], Case()).add(run)
    return result["context"], {name: case for name, case in cases.items() if case.times}


def by_threads(cases):
    """(name without the number of threads, threads) of every case that has one, else (name, 1)."""
    rows = {}
    for name, case in cases.items():
        head, _, tail = name.rpartition("/")
        threaded = name.split("/")[0] in ("deform", "sweep", "floor")
        row, threads = (head, int(tail)) if threaded else (name, 1)
        rows.setdefault(row, {})[threads] = case
    return rows


def naive_of(row, cases):
    """The naive case that a row is compared with: layouts of the same streams share one."""
    parts = row.split("/")
    return cases.get("naive/" + parts[1].split("-")[-1]) if parts[0] in ("deform", "sweep") else None


def cell(value, form):
    return "" if value is None else form.format(value)


def median_or_none(values):
    return statistics.median(values) if values else None


def table(cases):
    rows = by_threads(cases)
    counts = sorted({threads for row in rows.values() for threads in row})
    head = ["case", "per"]
    for threads in counts:
        head += [f"{threads} thread{'s' if threads > 1 else ''}: ns", "spread", "GB/s", "of floor"]
    head += ["naive / it"]
    lines = ["| " + " | ".join(head) + " |", "|---|---|" + "---:|" * (len(head) - 2)]
    for name, row in rows.items():
        cells = [name, next(iter(row.values())).unit]
        for threads in counts:
            case = row.get(threads)
            rate = median_or_none(case.rates) if case else None
            cells += [cell(case and case.time(), "{:.3f}"),
                      cell(case and case.spread(), "{:.1f} %"),
                      cell(rate and rate / 1e9, "{:.1f}"),
                      cell(median_or_none(case.of_floor) if case else None, "{:.2f}")]
        naive = naive_of(name, cases)
        cells += [cell(naive.time() / row[1].time() if naive and 1 in row else None, "{:.1f}")]
        lines.append("| " + " | ".join(cells) + " |")
    return lines


def report(context, cases):
    repetitions = max(len(case.times) for case in cases.values())
    caches = ", ".join(f"L{c['level']} {c['type'][0].lower()} {c['size'] // 1024} KiB" for c in context["caches"])
    load = "/".join(f"{value:.1f}" for value in context["load_avg"])
    return "\n".join([
        "# Benchmark run", "",
        f"{context['date']}, {context['num_cpus']} processors, caches {caches}, load {load} at the start; "
        f"medians of {repetitions} repetitions. How to read it: bench/README.md.", "",
        *table(cases), ""])


def sweep_series(cases):
    """(vertices, ns) by '<streams> <threads> <instances> instances', and the floors by '<streams> <threads> <fill>'."""
    series = {}
    for name, case in cases.items():
        group, *rest = name.split("/")
        if group == "sweep":
            streams, size, _, threads = rest
            instances, vertices = (int(number) for number in size.split("x"))
            series.setdefault(f"{streams} {threads} {instances} instances", []).append((vertices, case.time()))
    for streams, threads in dict.fromkeys(tuple(name.split()[:2]) for name in series):
        for fill in ("fill_nt", "fill_cache"):
            floor = cases.get(f"floor/{fill}/{threads}")
            if floor:
                value = floor.time() * FLOATS[streams] / FLOOR_FLOATS
                series[f"{streams} {threads} {fill}"] = [(200, value), (1_000_000, value)]
    return series


def data_lines(name, points):
    """Vertices, ns, and on the last point the label that it carries in the chart: the number of instances."""
    words = name.split()
    label = words[2] if words[-1] == "instances" else ""
    return [f'{x} {y:.5g} "{label if (x, y) == points[-1] else ""}"' for x, y in points]


def draw(series, folder):
    """Writes the series as data sets that gnuplot finds by their names, and has it draw them."""
    data, chart = os.path.join(folder, "sweep.dat"), os.path.join(folder, "sweep.svg")
    blocks = ["\n".join([f"# {name}", *data_lines(name, sorted(points))]) for name, points in series.items()]
    write(data, "\n\n\n".join(blocks) + "\n")
    times = [y for points in series.values() for _, y in points]
    threads = sorted({int(name.split()[1]) for name in series})
    settings = {"data": f"'{data}'", "chart": f"'{chart}'", "threads": f"'{' '.join(map(str, threads))}'",
                "low": min(times) / 1.2, "high": max(times) * 1.2}
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "chart.gp")
    subprocess.run(["gnuplot", "-e", "; ".join(f"{k}={v}" for k, v in settings.items()), script], check=True)


def write(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: report.py RESULT.json FOLDER")
    source, folder = sys.argv[1:]
    context, cases = read(source)
    if not cases:
        sys.exit(f"report.py: no measurements in {source}")
    write(os.path.join(folder, "report.md"), report(context, cases))
    series = sweep_series(cases)
    if series:
        draw(series, folder)


main()
