#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares what `goffer SUBCOMMAND --json -` writes with the tables of modules/cli/README.md: reports.py GOFFER

Every section of the page has its runs, below. Exit code 0: nothing wrong; 1: one line for each field that a report has and
the page does not, that is not what the page says, or that no run writes.
"""

import contextlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = "modules/cli/README.md"
MODELS = ("blub_open.obj", "chain_v2.goffer", "fuze.ply", "insect_leg.glb", "track.txt", "wine_bottle.glb")
SHARED = "Shared parts"


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def is_whole(value):
    return is_number(value) and value == int(value)


# What the second column of a table may say, or several of it.
KINDS = {
    "text": lambda value: isinstance(value, str),
    "true/false": lambda value: isinstance(value, bool),
    "null": lambda value: value is None,
    "share": lambda value: is_number(value) and 0 <= value <= 1,
    **dict.fromkeys(("bytes", "count", "index", "pixels"), is_whole),
    **dict.fromkeys(("1/s", "GB/s", "MB/s", "area", "change", "degrees", "length", "ms", "ns", "number", "radii", "seconds",
                     "us"), is_number),
}

SCENE = """{"version": 1, "fps": 24, "frames": 6, "bodies": {"worm": {"file": "worm.obj", "refine": "off"}},
"motions": {"sway": {"swing": 60, "seconds": 0.5}}, "instances": [{"body": "worm", "motion": "sway", "grid": [3, 2],
"spacing": [3, 3]}]}"""


class Section:
    """A part of the page: its fields, each with its line and what it may be, and the shared parts that it names."""

    def __init__(self):
        self.fields = {}
        self.links = set()


def kinds_of(cell):
    return re.split(r", | or ", cell.replace("true or false", "true/false"))


def sections_of(text):
    """The sections by their headings, and the shared parts by what links call them."""
    sections, parts, section, tables = {}, {}, Section(), []
    for number, line in enumerate(text.splitlines(), 1):
        if heading := re.match(r"(##+) (.*)", line):
            name = heading[2].replace("`", "")
            if heading[1] == "##":
                sections[name] = section = Section()
            else:
                parts[name.lower().replace(" ", "-")] = section = Section()
        section.links.update(re.findall(r"\]\(#([\w-]+)\)", line))
        if not line.startswith("|"):
            continue
        first, kinds = [cell.strip() for cell in line.split("|")][1:3]
        if kinds == "unit or type":
            ending = " summary" if "summary of" in first else ""
            tables = [f"{figure}{ending}: " for figure in re.findall(r"`(\w+)`", first)] or [""]
        elif not kinds.startswith("---"):
            for table in tables:
                section.fields.update({table + field: (number, kinds_of(kinds)) for field in re.findall(r"`([^`]+)`", first)})
    sections.pop(SHARED)
    return sections, parts


def leaves(value, path=""):
    """Every field of a report with its value; an empty array as one whose element nobody knows."""
    if isinstance(value, dict):
        for name, member in value.items():
            yield from leaves(member, f"{path}.{name}" if path else name)
    elif isinstance(value, list):
        for element in value:
            yield from leaves(element, path + "[]")
        if not value:
            yield path + "[]", ...
    else:
        yield path, value


def cells(report):
    """Every cell of the tables of `goffer figures`."""
    for figure in report.get("figures", ()):
        name = re.sub(r"^model_\d$", "model_N", figure["name"])
        for table, ending in ((figure["table"], ""), (figure["summary"], " summary")):
            for row in table["rows"] if table else ():
                yield from ((f"{name}{ending}: {column}", cell) for column, cell in zip(table["columns"], row, strict=True))


def painted(text):
    """An OBJ whose vertices have colors: red in the lower half."""
    return re.sub(r"^v (\S+ \S+) (\S+)$", lambda v: f"{v[0]} {float(float(v[2]) < 5)} 1 1", text, flags=re.M)


def runs(folder):
    """Each run: the section of its report, the words, and the exit code where it is not 0."""
    yield "goffer base", "base --columns 12 --rows 33 -o worm.obj"
    (folder / "painted.obj").write_text(painted((folder / "worm.obj").read_text()))

    for model in "wine_bottle.glb", "insect_leg.glb":
        yield "goffer inspect, of a model", f"inspect {model}"
    yield "goffer refine", "refine wine_bottle.glb -o refined.glb"
    yield "goffer bake", "bake wine_bottle.glb --lod wine_bottle.glb --socket cork=0,1,0 --regions 0.5,0.5 -o bottle.goffer"
    yield "goffer refine", "refine insect_leg.glb -o refined.glb"
    yield "goffer bake", "bake insect_leg.glb -o leg.goffer"
    yield "goffer inspect, of a body file", "inspect bottle.goffer"
    yield "goffer inspect, of a body file", "inspect chain_v2.goffer"

    yield "goffer bend", "bend blub_open.obj --amplitude paper --angle 30 -o bent.obj"
    yield "goffer bend", "bend wine_bottle.glb --angle 60 --png bent.png --size 64x48 --show area -o bent.glb"
    yield "goffer bend", "bend insect_leg.glb --by 20 --refine off -o bent.glb"
    yield "goffer bend", "bend worm.obj --paper --angle max --refine off -o bent.obj"
    yield "goffer bend", "bend worm.obj --regions 0.5,0.5 --angles 900,-30 --joints apart -o bent.obj"
    yield "goffer bend", "bend painted.obj --wrinkle-mask COLOR_0.r --wrinkle-range 0.2,0.8 -o bent.obj"
    yield "goffer bend", "bend worm.obj --path track.txt --path-scale 0.5 -o bent.obj"
    yield "goffer bend", "bend bottle.goffer --level 1 --angle 45 -o bent.obj"

    yield "goffer animate", "animate worm.obj --swing 90 --frames 4 --refine on -o swing.glb"
    yield "goffer animate", "animate fuze.ply --swing 900 --frames 4 -o swing.mdd"
    yield "goffer animate", "animate worm.obj --path track.txt --frames 4 --refine off -o walk.json"
    yield "goffer animate", "animate bottle.goffer --swing 45 --frames 2 -o swing_%04d.obj"

    yield "goffer crowd", "crowd worm.obj fuze.ply --refine --instances 4 --frames 3"
    yield "goffer crowd", "crowd worm.obj --regions 0.5,0.5 --angles=max,-30 --streams packed --instances 2 --frames 3"

    (folder / "scene.json").write_text(SCENE)
    yield "goffer cache", "cache scene.json --prepare -o cache"
    yield "goffer cache", "cache scene.json --shard-frames 3 -o cache"
    yield "goffer cache --verify", "cache --verify cache"
    yield "goffer cache --extract", "cache --extract 3,1 -o instance.obj cache"
    shard = next((folder / "cache").glob("shard-*"))
    shard.write_bytes(shard.read_bytes()[:-4] + b"\0\1\2\3")
    yield "goffer cache --verify", "cache --verify cache", 1

    yield "goffer figures", "figures worm.obj insect_leg.glb wine_bottle.glb --quick --no-charts --size 64x48 -o page"

    yield "goffer view", "view worm.obj --crowd 2 --frames 2 --size 320x240"
    yield "goffer view", "view worm.obj --shader --frames 2 --size 320x240"


@contextlib.contextmanager
def screen():
    """The environment of programs on an X server of their own; None where there is none."""
    if not shutil.which("Xvfb"):
        yield None
        return
    read, write = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "640x480x24"], pass_fds=[write],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(write)
    with os.fdopen(read) as number:
        display = number.readline().strip()
    elsewhere = ("WAYLAND_DISPLAY", "WAYLAND_SOCKET", "XDG_SESSION_TYPE", "XDG_RUNTIME_DIR")
    own = {name: value for name, value in os.environ.items() if name not in elsewhere}
    try:
        yield own | {"DISPLAY": f":{display}"} if display else None
    finally:
        server.terminate()
        server.wait()


class Comparison:
    """What is wrong between the page and what runs write."""

    def __init__(self, page):
        self.sections, parts = sections_of(page)
        self.parts = {section: [parts[link].fields for link in sorted(self.sections[section].links & parts.keys())]
                      for section in self.sections}
        self.written = {}  # fields by section, once it has had a run
        self.faults = {}  # by what is at fault, so that each is told once
        named = {link for section in self.sections.values() for link in section.links}
        for part in sorted(parts.keys() - named):
            self.faults[part] = f"{PAGE}: no section has the shared part #{part}"

    def listed(self, section):
        own = self.sections[section].fields
        return {field: place for fields in (*self.parts[section], own) for field, place in fields.items()}

    def take(self, section, words, report):
        """Compares a report with its section."""
        if section not in self.sections:
            self.faults[section] = f"{PAGE}: there is no section \"{section}\""
            return
        fields, seen = self.listed(section), self.written.setdefault(section, set())
        for field, value in (*leaves(report), *cells(report)):
            seen.add(field)
            if field not in fields:
                fault = f"{PAGE}: {section}: there is no {field}, which 'goffer {words}' writes"
                self.faults.setdefault((section, field), fault)
                continue
            line, kinds = fields[field]
            if value is not ... and not any(KINDS.get(kind, lambda _: False)(value) for kind in kinds):
                fault = f"{PAGE}:{line}: {section}: {field} is {value!r} of 'goffer {words}', not: {' or '.join(kinds)}"
                self.faults.setdefault((section, field), fault)

    def all_faults(self, without):
        """Yields the faults of all runs, and of the sections that had none, unless for a reason."""
        for section in self.sections:
            if section not in self.written and section not in without:
                yield f"{PAGE}: {section}: no run is of this section"
        for section, seen in self.written.items():
            for field, (line, _) in self.listed(section).items():
                if field not in seen:
                    yield f"{PAGE}:{line}: {section}: no run writes {field}"
        yield from self.faults.values()


def subcommands(goffer):
    """Returns the subcommands that have reports."""
    def help_of(*words):
        return subprocess.run([goffer, *words, "--help"], capture_output=True, text=True, check=True).stdout
    names = re.findall(r"^  (\w+) ", help_of().partition("Subcommands:")[2], re.M)
    return [name for name in names if "--json" in help_of(name)]


def main():
    goffer = str(pathlib.Path(sys.argv[1]).resolve())
    comparison = Comparison((ROOT / PAGE).read_text(encoding="utf-8"))
    reporting, without = subcommands(goffer), []
    for name in reporting:
        if not any(re.match(rf"goffer {name}\b", section) for section in comparison.sections):
            comparison.faults[name] = f"{PAGE}: there is no section on goffer {name}"
    with tempfile.TemporaryDirectory(prefix="goffer-reports-") as name, screen() as environment:
        folder = pathlib.Path(name)
        for model in MODELS:
            shutil.copy(ROOT / "tests/data" / model, folder)
        for section, words, *code in runs(folder):
            if section == "goffer view" and (environment is None or "view" not in reporting):
                without = [section]
                continue
            done = subprocess.run([goffer, *words.split(), "--json", "-"], cwd=folder, env=environment, capture_output=True,
                                  text=True, check=False)
            if done.returncode != (code or [0])[0]:
                print(f"goffer {words}: exit code {done.returncode}: {done.stderr.strip()}")
                return 1
            comparison.take(section, words, json.loads(done.stdout))
    faults = list(comparison.all_faults(without))
    fields = sum(len(seen) for seen in comparison.written.values())
    print("\n".join(faults + [f"not compared: {section}: there is no display, or this goffer has no viewer"
                              for section in without] + [f"{fields} fields of reports, {len(faults)} faults"]))
    return 1 if faults else 0


sys.exit(main())
