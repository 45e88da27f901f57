#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fails where the stripped shared libraries of the runtime, goffer_engine and goffer_bend, take too many bytes together.
   size.py STRIP FOLDER LIMIT"""
import pathlib
import subprocess
import sys
import tempfile

STRIP, FOLDER, LIMIT = sys.argv[1], pathlib.Path(sys.argv[2]), int(sys.argv[3])

total = 0
for name in ("goffer_engine", "goffer_bend"):
    files = [file for file in FOLDER.rglob(f"lib{name}.so.*") if not file.is_symlink()]
    if len(files) != 1:
        sys.exit(f"{FOLDER}: {len(files)} files of lib{name}, not one")
    with tempfile.TemporaryDirectory() as folder:
        stripped = pathlib.Path(folder) / "stripped"
        subprocess.run([STRIP, "-o", stripped, files[0]], check=True)
        print(f"lib{name}: {stripped.stat().st_size:,} bytes")
        total += stripped.stat().st_size
print(f"together: {total:,} of {LIMIT:,}")
sys.exit(total > LIMIT)
