#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the Debian packages, reads them, and unpacks them in FOLDER/root, where they must have together what is installed.
   debs.py BUILD FOLDER PREFIX
BUILD: a build folder with everything built. PREFIX: where `cmake --install` put the same."""
import pathlib
import re
import shutil
import subprocess
import sys

BUILD, FOLDER, PREFIX = map(pathlib.Path, sys.argv[1:])
# All that maintainer scripts do, which only shared libraries have.
SCRIPT = re.compile(r"#!/bin/sh\s+set -e\s+if \[ \"\$1\" = \"(configure|remove)\" \]; then\s+ldconfig\s+fi\s*")


def output_of(*command):
    """What it prints."""
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def files_below(folder):
    """Names of files and links below it."""
    return {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_symlink() or not path.is_dir()}


def unpacked(deb):
    """Name, what it depends on, and files of a package, which is unpacked beside the others."""
    name, version, needs, maintainer = (output_of("dpkg-deb", "--field", deb, field).strip()
                                        for field in ("Package", "Version", "Depends", "Maintainer"))
    assert version and maintainer, (name, version, maintainer)
    control, data = FOLDER / f"{name}.control", FOLDER / f"{name}.data"
    subprocess.run(["dpkg-deb", "--control", deb, control], check=True)
    scripts = [control / script for script in ("preinst", "postinst", "prerm", "postrm", "config")]
    scripts = [script for script in scripts if script.exists()]
    assert all(SCRIPT.fullmatch(script.read_text()) for script in scripts), scripts
    assert bool(scripts) == bool(re.search(r"\d$", name)), "the library, and only that, tells the loader"
    for folder in (data, FOLDER / "root"):
        subprocess.run(["dpkg-deb", "--extract", deb, folder], check=True)
    print(f"{name} {version}: {len(files_below(data))} files; depends on {needs}")
    return name, {re.split(r"[ (]", need)[0] for need in needs.split(", ")}, files_below(data)


shutil.rmtree(FOLDER, ignore_errors=True)
subprocess.run(["cpack", "-G", "DEB", "-B", FOLDER.resolve(), "--config", BUILD / "CPackConfig.cmake"], check=True)
packages = {name: (needs, files) for name, needs, files in map(unpacked, sorted(FOLDER.glob("*.deb")))}
library, = (name for name in packages if re.fullmatch(r"libgoffer[\d.]+", name))
assert set(packages) == {"goffer", "libgoffer-dev", library}, set(packages)
assert {library, "libglm-dev"} <= packages["libgoffer-dev"][0], packages["libgoffer-dev"][0]
for name in ("goffer", library):
    assert "libc6" in packages[name][0], packages[name][0]  # found in its program

everything = [file for _, files in packages.values() for file in files]
twice = {file for file in everything if everything.count(file) > 1}
installed = {f"usr/{file}" for file in files_below(PREFIX)}
print("in two packages:", *sorted(twice))
print("installed, but in no package:", *sorted(installed - set(everything)))
print("in a package, but not installed:", *sorted(set(everything) - installed))
sys.exit(bool(twice or installed ^ set(everything)))
