# SPDX-License-Identifier: MIT
"""The scripts without a Slurm: by xargs and GNU parallel, with words, with mistakes, and beside programs that are none."""

import json
import re
import shutil
import subprocess

from common import FARM, SHARES, call, compare, environment, make_scene, need, single


# A folder in whose name runners find what they replace, and shells what they split.
TRICKY = "cache {}{#}%j'$x"


def baked(printed):
    """How many shards each run of goffer baked, in the order in which they said so."""
    return [int(count) for count in re.findall(r"^shards +\d+ kept, (\d+) baked", printed, re.MULTILINE)]


def local(goffer, folder, runner):
    need(runner)
    env = environment(goffer, {"RUNNER": runner, "JOBS": "2"})
    scene = make_scene(folder, env)
    wanted = single(scene, folder / "single", env)
    words = ["bash", FARM / "bake_local.sh", scene, folder / TRICKY, SHARES, "--shard-frames", "10"]
    runs = baked(call(words, env))
    assert len(runs) == SHARES + 1 and sum(runs) == 24, f"{runs} shards were baked"
    assert runs[-1] == 0, f"the last run baked {runs[-1]} shards, which the shares should have"
    compare(folder / TRICKY, wanted)


def xargs(goffer, folder):
    """Shares run by xargs."""
    local(goffer, folder, "xargs")


def parallel(goffer, folder):
    """Shares run by GNU parallel."""
    local(goffer, folder, "parallel")


def make_small(folder, env):
    """One instance, two frames, and a body outside the scene's folder, which is only read where that is allowed."""
    call(["goffer", "base", "--columns", 8, "--rows", 9, "-o", folder / "worm.ply"], env)
    place = folder / "scene"
    place.mkdir()
    bodies = {"worm": {"file": str(folder / "worm.ply"), "refine": "off", "amplitude": "paper"}}
    scene = {"version": 1, "fps": 24, "frames": 2, "bodies": bodies, "instances": [{"body": "worm"}]}
    (place / "scene.json").write_text(json.dumps(scene))
    return place / "scene.json"


def standing_in(folder, name, text):
    """A program of this name that is to be found before the system's; the folder that it is in."""
    place = folder / "programs"
    place.mkdir(exist_ok=True)
    (place / name).write_text(f"#!/usr/bin/env bash\n{text}\n")
    (place / name).chmod(0o755)
    return place


def before(place, env):
    return {**env, "PATH": f"{place}:{env['PATH']}"}


def broken(goffer, folder):
    """A runner that runs no share: that is said, and the last run bakes all."""
    env = environment(goffer, {"RUNNER": "xargs"})
    scene = make_small(folder, env)
    words = ["bash", FARM / "bake_local.sh", scene, folder / "cache", "2", "--allow-outside", "--shard-frames", "1"]
    done = subprocess.run([*map(str, words)], env=before(standing_in(folder, "xargs", "exit 3"), env),
                          capture_output=True, text=True)
    assert done.returncode == 0 and baked(done.stdout) == [2], f"{done.returncode}: {done.stdout}{done.stderr}"
    assert "shares failed (exit code 3 of xargs)" in done.stderr, done.stderr


# Runs the jobs where sbatch would queue them.
SBATCH = """
tasks=1-1
for word; do
    case $word in
        --array=*) tasks=${word#--array=} ;;
        --*) ;;
        *) break ;;
    esac
    shift
done
for ((task = 1; task <= ${tasks#1-}; ++task)); do SLURM_ARRAY_TASK_ID=$task bash "$@" >>"$JOBS_LOG" 2>&1; done
echo 7"""


def words(goffer, folder):
    """Words that every run needs reach every run, and those of the plan none but the first."""
    log = folder / "jobs.log"
    env = environment(goffer, {"RUNNER": "xargs", "JOBS": "1", "JOBS_LOG": str(log)})
    scene = make_small(folder, env)
    env = before(standing_in(folder, "sbatch", SBATCH), env)
    given = ["--allow-outside", "--max-memory", "1G", "--shard-frames", "1", "--isa", "scalar"]
    printed = call(["bash", FARM / "bake_local.sh", scene, folder / "local", 2, *given], env)
    assert baked(printed) == [1, 1, 0], printed
    call(["bash", FARM / "bake.sh", scene, folder / "slurm", 2, *given], env)
    assert baked(log.read_text()) == [1, 1, 0], log.read_text()
    call(["goffer", "cache", scene, "-o", folder / "single", *given], env)
    for cache in ("local", "slurm"):
        compare(folder / cache, folder / "single")
    standing_in(folder, "goffer", f'echo "$*" >>"$CALLS"; exec {goffer} "$@"')
    for script in ("bake.sh", "bake_local.sh"):
        calls = folder / f"{script}.calls"
        given = ["--isa", "auto", "--max-memory=1G", "--allow-outside"]
        call(["bash", FARM / script, scene, folder / f"{script}.cache", 2, *given], {**env, "CALLS": str(calls)})
        first, *others, last = calls.read_text().splitlines()
        assert first.endswith("--prepare --isa auto --max-memory=1G --allow-outside"), first
        assert len(others) == 3 and last.startswith("cache --verify"), calls.read_text()
        assert all(run.endswith(" --max-memory=1G --allow-outside") and "--isa" not in run for run in others), others


def refusals(goffer, folder):
    """What is wrong is said in a line, before anything is made."""
    env = environment(goffer, {"RUNNER": "xargs"})
    scene, cache = make_small(folder, env), folder / "cache"
    mistakes = [([folder / "none.json", cache, 2], 1, "none.json: there is no such scene"),
                ([folder / "no/none.json", cache, 2], 1, "none.json: there is no such scene"),
                ([scene, folder / "no/cache", 2], 1, "no/cache: the folder that it is to be in does not exist")]
    mistakes += [([scene, cache, shares], 2, f"SHARES is '{shares}'") for shares in ("two", "0", "-1", "", "1/2", "1000000")]
    for script in ("bake.sh", "bake_local.sh"):
        for given, code, text in mistakes:
            done = subprocess.run(["bash", str(FARM / script), *map(str, given)], env=env, capture_output=True, text=True)
            said = f"{script} {given}: {done.returncode}: {done.stdout}{done.stderr}"
            assert done.returncode == code and text in done.stderr and done.stderr.count("\n") == 1, said
            assert not done.stdout and not cache.exists(), said


def moreutils(goffer, folder):
    """The other `parallel` is not taken for GNU's."""
    env = environment(goffer, {"JOBS": "1"})
    scene = make_small(folder, env)
    env = before(standing_in(folder, "parallel", "echo 'parallel [OPTIONS] command -- arguments' >&2; exit 1"), env)
    given = ["bash", FARM / "bake_local.sh", scene, folder / "cache", 2, "--allow-outside", "--shard-frames", 1]
    assert baked(call(given, env)) == [1, 1, 0]
    shutil.rmtree(folder / "cache")
    done = subprocess.run([*map(str, given)], env={**env, "RUNNER": "parallel"}, capture_output=True, text=True)
    assert done.returncode == 2 and "GNU parallel is not here" in done.stderr, done.stderr
    assert not (folder / "cache").exists()
