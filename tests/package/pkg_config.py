#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compiles a program with what pkg-config says of an installed runtime, and nothing else, and compares its bits with those
of the library that was tested.
   pkg_config.py TOP PREFIX FOLDER COMPILER LIBRARY_PROGRAM
FOLDER: to work in. LIBRARY_PROGRAM: bits.cpp, linked with the library."""
import os
import pathlib
import subprocess
import sys

TOP, PREFIX, FOLDER, COMPILER, LIBRARY = (pathlib.Path(argument).resolve() if "/" in argument else argument
                                          for argument in sys.argv[1:])


def output_of(*command):
    """What it prints."""
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


found, = PREFIX.rglob("goffer-bend.pc")
os.environ["PKG_CONFIG_PATH"] = str(found.parent)
flags = output_of("pkg-config", "--cflags", "--libs", "goffer-bend").split()
print(*flags)
assert ("-ltbb" in flags) == any(PREFIX.rglob("libgoffer_engine.a")), "static libraries need oneTBB, shared ones bring it"
FOLDER.mkdir(parents=True, exist_ok=True)
# Shared libraries are where a loader would look for them.
libraries = [flag[2:] for flag in flags if flag.startswith("-L")]
subprocess.run([COMPILER, "-std=c++20", TOP / "tests/package/bits.cpp", "-o", FOLDER / "bits", *flags,
                *(f"-Wl,-rpath,{library}" for library in libraries)], check=True)
data = TOP / "tests/data/cylinder_v1.goffer"
sums = [output_of(program, data, "scalar") for program in (FOLDER / "bits", LIBRARY)]
print(*sums)
sys.exit(sums[0] != sums[1])
