#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs one check of checks.py in a headless Blender, with settings of its own: run.py LIBGOFFER GOFFER SOURCE CHECK

Exit code 77 where Blender is not here, and 1 where GOFFER_TEST_HOSTS is `required`.
"""

import os
import shutil
import subprocess
import sys
import tempfile


def main():
    library, goffer, source, check = sys.argv[1:]
    blender = shutil.which("blender")
    if blender is None:
        required = os.environ.get("GOFFER_TEST_HOSTS") == "required"
        print(f"{'failed' if required else 'skipped'}: Blender is not here (bash .ci/setup hosts)")
        return 1 if required else 77
    # A Blender without a Python of its own takes the first on the path: that should be the one beside it.
    path = os.path.dirname(blender) + os.pathsep + os.environ.get("PATH", "")
    checks = os.path.join(os.path.dirname(os.path.abspath(__file__)), "checks.py")
    with tempfile.TemporaryDirectory() as folder:
        settings = {f"BLENDER_USER_{name}": os.path.join(folder, name.lower())
                    for name in ("CONFIG", "SCRIPTS", "DATAFILES")}
        done = subprocess.run([blender, "--background", "--factory-startup", "--python-exit-code", "1", "--python",
                               checks, "--", library, goffer, source, folder, check],
                              env={**os.environ, **settings, "PATH": path}, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False)
    print(done.stdout)
    # Blender's exit code alone would also be 0 where the script had not run.
    return 0 if done.returncode == 0 and f"passed: {check}" in done.stdout else 1


if __name__ == "__main__":
    sys.exit(main())
