#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the runtime's two files, compiles them alone, and compares bits with the library's.
   amalgamated.py TOP FOLDER COMPILER LIBRARY_PROGRAM FLAGS ISA=FLAGS..
TOP: goffer's sources. FOLDER: to work in. LIBRARY_PROGRAM: bits.cpp, linked with the library. FLAGS: those of the library's
kernels. ISA: one that the library has kernels for; the last that runs here is tried."""
import pathlib
import subprocess
import sys


def output_of(command):
    """What a command prints, or None where it fails."""
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    return ran.stdout.strip() if ran.returncode == 0 else None


def main():
    top, folder, compiler, library = map(pathlib.Path, sys.argv[1:5])
    data = top / "tests/data/cylinder_v1.goffer"
    flags = dict(argument.split("=", 1) for argument in ["scalar=", *sys.argv[6:]])
    sums = {isa: output_of([library, data, isa]) for isa in flags}
    isa = [isa for isa, bits in sums.items() if bits][-1]
    subprocess.run([top / "engine/packaging/amalgamate", folder], check=True)
    program = folder / "bits"
    subprocess.run([compiler, "-std=c++20", "-O1", "-Wall", "-Wextra", "-Werror", *sys.argv[5].split(),
                    *flags[isa].split(), "-I", folder, top / "tests/package/bits.cpp",
                    folder / "goffer.cpp", "-o", program], check=True)
    failed = False
    for name in {"scalar", isa}:
        bits = output_of([program, data, name])
        print(f"{name}: {bits} in two files, {sums[name]} in the library")
        failed |= bits is None or bits != sums[name]
    return int(failed)


sys.exit(main())
