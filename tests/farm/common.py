# SPDX-License-Identifier: MIT
"""What the checks share: the scene, programs that are called, and caches that are compared."""

import filecmp
import os
import pathlib
import shutil
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
FARM = ROOT / "samples/farm"
SHARES = 12
PATH = "/usr/sbin:/usr/bin:/sbin:/bin"


class Skip(Exception):
    """Why a check cannot be made."""


class Missing(Skip):
    """A program is not here; an error where GOFFER_TEST_HOSTS says that it should be."""


def need(*programs):
    for program in programs:
        if not shutil.which(program, path=PATH):
            raise Missing(f"there is no {program}; bash .ci/setup hosts")


def until(question, what, seconds):
    """The answer, once it is one."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        answer = question()
        if answer:
            return answer
        time.sleep(0.02)
    raise AssertionError(f"{what}: not within {seconds} s")


def environment(goffer, more=None):
    return {**os.environ, "PATH": f"{goffer.parent}:{PATH}", **(more or {})}


def call(words, env, **more):
    """What a program prints; it must end well."""
    done = subprocess.run([str(word) for word in words], env=env, capture_output=True, text=True, **more)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, words))}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def make_scene(folder, env):
    """The scene of samples/farm, with its worm."""
    for name in ("crowd.json", "places.csv"):
        shutil.copy(FARM / name, folder)
    words = "goffer base --length 10 --radius 1 --columns 12 --rows 17 -o"
    call([*words.split(), folder / "worm.ply"], env)
    return folder / "crowd.json"


def files(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())


def compare(folder, wanted):
    """Two caches are the same, to the bit."""
    assert files(folder) == files(wanted), f"{files(folder)} is not {files(wanted)}"
    _, other, unread = filecmp.cmpfiles(folder, wanted, files(wanted), shallow=False)
    assert not other and not unread, f"{other + unread} differ"


def single(scene, folder, env):
    call(["goffer", "cache", scene, "-o", folder, "--shard-frames", "10"], env)
    return folder
