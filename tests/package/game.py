#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Builds and installs the preset `game` as a game would, from nothing, and fails where its stripped libraries, goffer_engine
and goffer_bend, take too many bytes together, or the build too much processor time.
   game.py TOP FOLDER COMPILER BYTES SECONDS
FOLDER: for the build, and for what is installed, in `prefix`."""
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import time

TOP, FOLDER, COMPILER = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3]
BYTES, SECONDS = int(sys.argv[4]), float(sys.argv[5])
# What a cache compiles costs nothing.
os.environ.pop("CMAKE_CXX_COMPILER_LAUNCHER", None)


def processor_time():
    """Seconds, of all programs that were run."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


shutil.rmtree(FOLDER, ignore_errors=True)
started = time.monotonic()
for command in (["cmake", "--preset", "game", "-S", TOP, "-B", FOLDER, f"-DCMAKE_CXX_COMPILER={COMPILER}"],
                ["cmake", "--build", FOLDER]):
    subprocess.run(command, cwd=TOP, check=True)
wall, processor = time.monotonic() - started, processor_time()
subprocess.run(["cmake", "--install", FOLDER, "--strip", "--prefix", FOLDER / "prefix"], check=True)

sizes = {}
for name in ("goffer_engine", "goffer_bend", "goffer_gpu"):
    file, = (file for file in (FOLDER / "prefix").rglob(f"lib{name}.so.*") if not file.is_symlink())
    sizes[name] = file.stat().st_size
    print(f"lib{name}: {sizes[name]:,} bytes")
together = sizes["goffer_engine"] + sizes["goffer_bend"]
print(f"engine and bend together: {together:,} of {BYTES:,}")
print(f"built in {wall:.1f} s, {processor:.1f} s of processor time of {SECONDS:g}")
sys.exit(together > BYTES or processor > SECONDS)
