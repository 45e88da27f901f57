#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes projects of the lines of CMake that README.md has for games, as they stand there, and builds and runs the one that
fetches goffer. (The test `package: folder` builds goffer as a folder.)
   readme.py TOP FOLDER COMPILER [OPTION..]
FOLDER: to work in; a commit is fetched from TOP as from elsewhere. OPTION: for CMake. Exit code 77: this is no checkout."""
import pathlib
import re
import shutil
import subprocess
import sys

TOP, FOLDER, COMPILER, OPTIONS = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3], sys.argv[4:]


def configure(name, lines):
    """A project of bits.cpp and these lines, and the folder that it is to be built in."""
    project = FOLDER / name
    shutil.rmtree(project, ignore_errors=True)
    project.mkdir(parents=True)
    (project / "goffer").symlink_to(TOP)
    shutil.copy(TOP / "tests/package/bits.cpp", project)
    (project / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.25)\nproject(game LANGUAGES CXX)\n"
                                            f"add_executable(game bits.cpp)\n{lines}", encoding="utf-8")
    subprocess.run(["cmake", "-S", project, "-B", project / "build", "-DCMAKE_BUILD_TYPE=Debug",
                    f"-DCMAKE_CXX_COMPILER={COMPILER}", *OPTIONS], check=True)
    return project / "build"


commit = subprocess.run(["git", "rev-parse", "HEAD"], cwd=TOP, capture_output=True, text=True, check=False)
if commit.returncode != 0:
    print("skipped:", commit.stderr.strip())
    sys.exit(77)
blocks = re.findall(r"^```cmake\n(.*?)^```", (TOP / "README.md").read_text(encoding="utf-8"), re.M | re.S)
folder, = (block for block in blocks if "add_subdirectory(" in block)
fetched, = (block for block in blocks if "FetchContent" in block)
address, = re.findall(r"GIT_REPOSITORY (\S+)", fetched)
tag, = re.findall(r"GIT_TAG ([^\s)]+)", fetched)
configure("folder", folder)
binary = configure("fetched", fetched.replace(address, f"file://{TOP}")
                   .replace(f"GIT_TAG {tag}", f"GIT_TAG {commit.stdout.strip()}"))
subprocess.run(["cmake", "--build", binary, "--target", "game", "--parallel", "2"], check=True)
subprocess.run([binary / "game", TOP / "tests/data/cylinder_v1.goffer", "scalar"], check=True)
