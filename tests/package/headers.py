#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compiles each public header of goffer alone, and fails where one gives the compiler more to read than allowed.
   headers.py COMPILER TOP LIMIT FOLDER..
LIMIT: how much a header may give, itself and all that it includes, as a multiple of what <vector> and GLM's vectors and
matrices do. FOLDER: where the compiler looks for headers; those below TOP are goffer's. What is counted are the bytes that the
preprocessor leaves, which are the same on each run; seconds follow them, and are printed, but differ with the machine."""
import os
import pathlib
import subprocess
import sys
import tempfile

COMPILER, TOP, LIMIT, FOLDERS = sys.argv[1], pathlib.Path(sys.argv[2]), float(sys.argv[3]), sys.argv[4:]
YARDSTICK = ["vector", "glm/vec3.hpp", "glm/vec4.hpp", "glm/mat3x3.hpp", "glm/mat4x3.hpp"]


def measure(headers):
    """The bytes that the preprocessor leaves of a file that includes these, and the seconds that compiling it takes."""
    with tempfile.NamedTemporaryFile("w", suffix=".cpp") as file:
        file.writelines(f"#include <{header}>\n" for header in headers)
        file.flush()
        command = [COMPILER, "-std=c++20", "-O2", *(f"-I{folder}" for folder in FOLDERS), file.name]
        preprocessed = subprocess.run([*command, "-E", "-P"], stdout=subprocess.PIPE, check=True).stdout
        with subprocess.Popen([*command, "-fsyntax-only"]) as compiler:
            _, status, usage = os.wait4(compiler.pid, 0)
            compiler.returncode = os.waitstatus_to_exitcode(status)
    if compiler.returncode != 0:
        sys.exit(f"{headers} does not compile alone")
    return len(preprocessed), usage.ru_utime + usage.ru_stime


headers = sorted(str(header.relative_to(folder)) for folder in map(pathlib.Path, FOLDERS) if TOP in folder.parents
                 for header in folder.rglob("*.hpp"))
assert headers, FOLDERS
yardstick, yardstick_seconds = measure(YARDSTICK)
rows = sorted(((header, *measure([header])) for header in headers), key=lambda row: -row[1])
for header, size, seconds in rows:
    print(f"{size / yardstick:6.2f}  {seconds:6.3f} s  {header}{'  TOO MUCH' if size > LIMIT * yardstick else ''}")
print(f"limit: {LIMIT}; 1.00 is {yardstick} bytes, {yardstick_seconds:.3f} s")
sys.exit(rows[0][1] > LIMIT * yardstick)
