#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures what the table in samples/farm/README.md is made from, on this machine: measure.py FOLDER

How fast a run bakes each format into memory and onto the disk of FOLDER, and how fast that disk takes as many zeros from dd
with fsync. Medians of five; processor time is of all threads and of the system, without what a run takes to begin.
"""

import json
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time

RUNS = 5
VERTICES = 10_000


def write_scene(folder, grid, frames):
    body = {"file": "worm.ply", "refine": "off", "amplitude": "paper"}
    crowd = {"body": "worm", "motion": "sway", "grid": grid, "spacing": [4, 4], "scatter": 4}
    motion = {"swing": {"from": -60, "to": 60}, "seconds": 4}
    scene = {"version": 1, "fps": 24, "frames": frames, "bodies": {"worm": body}, "motions": {"sway": motion}}
    (folder / "scene.json").write_text(json.dumps(scene | {"instances": [crowd]}))


def processor_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def goffer(*words):
    """Its processor seconds."""
    before = processor_seconds()
    subprocess.run(["goffer", *map(str, words)], check=True, stdout=subprocess.DEVNULL)
    return processor_seconds() - before


def bake(scene, into, form, threads):
    reports, busy = [], []
    for _ in range(RUNS):
        with tempfile.TemporaryDirectory(dir=into) as cache:
            words = ["cache", scene, "-o", cache, "--threads", threads]
            begin = goffer(*words, "--format", form, "--prepare")
            report = pathlib.Path(cache).with_suffix(".json")
            busy.append(goffer(*words, "--json", report) - begin)
            reports.append(json.loads(report.read_text()))
            report.unlink()
    seconds = statistics.median(report["seconds"] for report in reports)
    instances = reports[0]["instances"] * reports[0]["frames"]
    return instances / seconds, reports[0]["bytes"] / seconds, instances / statistics.median(busy), reports[0]


def zeros(folder):
    """Bytes per second of dd."""
    rates = []
    for _ in range(RUNS):
        start = time.monotonic()
        words = ["dd", "if=/dev/zero", f"of={folder}/zeros", "bs=1M", "count=960", "conv=fsync", "status=none"]
        subprocess.run(words, check=True)
        rates.append((960 << 20) / (time.monotonic() - start))
    return statistics.median(rates)


def main(place):
    with tempfile.TemporaryDirectory(dir=place) as disk, tempfile.TemporaryDirectory(dir="/dev/shm") as memory:
        folder = pathlib.Path(disk)
        goffer(*"base --length 40 --radius 1 --columns 50 --rows 200 -o".split(), folder / "worm.ply")
        for form in ("positions", "packed", "poses"):
            write_scene(folder, *(([100, 100], 200) if form == "poses" else ([10, 10], 80)))
            for threads in (1, 2):
                for name, into in (("memory", memory), ("disk", disk)):
                    rate, written, busy, report = bake(folder / "scene.json", into, form, threads)
                    print(f"{form:10}{threads} thread(s), {name:7}{rate * VERTICES:8.3g} vertices/s, "
                          f"{rate / report['instances']:6.4g} frames/s, {written / 1e6:5.0f} MB/s; "
                          f"{busy * VERTICES:8.3g} vertices per processor second", flush=True)
        print(f"dd with fsync, disk: {zeros(disk) / 1e6:.0f} MB/s")


main(*sys.argv[1:])
