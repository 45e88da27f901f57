#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compiles each public header of goffer alone, and fails where one takes more processor time than allowed.
   headers.py COMPILER TOP LIMIT FOLDER..
LIMIT: seconds. FOLDER: where the compiler looks for headers; those below TOP are goffer's. A header that takes more is tried
again, up to twelve times; its time is the best of them. On a machine that takes longer for a yardstick, <vector> and GLM's
vectors and matrices, than the one that the limit was set on, it is longer in proportion."""
import os
import pathlib
import subprocess
import sys
import tempfile

COMPILER, TOP, LIMIT, FOLDERS = sys.argv[1], pathlib.Path(sys.argv[2]), float(sys.argv[3]), sys.argv[4:]
YARDSTICK = ["vector", "glm/vec3.hpp", "glm/vec4.hpp", "glm/mat3x3.hpp", "glm/mat4x3.hpp"]
YARDSTICK_SECONDS = 0.3


def seconds(headers):
    """What the compiler takes for a file that includes these."""
    with tempfile.NamedTemporaryFile("w", suffix=".cpp") as file:
        file.writelines(f"#include <{header}>\n" for header in headers)
        file.flush()
        command = [COMPILER, "-std=c++20", "-O2", "-fsyntax-only", *(f"-I{folder}" for folder in FOLDERS), file.name]
        with subprocess.Popen(command) as compiler:
            _, status, usage = os.wait4(compiler.pid, 0)
            compiler.returncode = os.waitstatus_to_exitcode(status)
    if compiler.returncode != 0:
        sys.exit(f"{headers} does not compile alone")
    return usage.ru_utime + usage.ru_stime


headers = sorted(str(header.relative_to(folder)) for folder in map(pathlib.Path, FOLDERS) if TOP in folder.parents
                 for header in folder.rglob("*.hpp"))
assert headers, FOLDERS
best = {header: float("inf") for header in headers}
yardstick = min(seconds(YARDSTICK) for _ in range(3))
for turn in range(12):
    yardstick = min(yardstick, seconds(YARDSTICK))
    limit = LIMIT * max(1, yardstick / YARDSTICK_SECONDS)
    beyond = [header for header in headers if best[header] > limit]
    if not beyond:
        break
    for header in beyond:
        best[header] = min(best[header], seconds([header]))
for header, time in sorted(best.items(), key=lambda row: -row[1]):
    print(f"{time:.3f} s  {header}")
print(f"yardstick: {yardstick:.3f} s; limit: {limit:.3f} s")
sys.exit(max(best.values()) > limit)
