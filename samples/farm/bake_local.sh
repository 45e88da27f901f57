#!/usr/bin/env bash
# Bakes a cache on this machine without Slurm: GNU parallel, or xargs, runs the shares, and what they left is baked at the
# end, with the manifest. The same files come out.
#   bash samples/farm/bake_local.sh SCENE.json FOLDER SHARES [words of goffer cache]..
# JOBS: shares at a time (default: one for each processor). RUNNER: parallel or xargs (default: GNU parallel if it is here).
set -euo pipefail
(($# >= 3)) || { sed -n '2,6s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2; }
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

# There is another `parallel`, of moreutils, whose words are others.
is_gnu() { [[ $(parallel --version 2>/dev/null </dev/null || true) == "GNU parallel"* ]]; }

jobs=${JOBS:-$(nproc)}
runner=${RUNNER:-$(is_gnu && echo parallel || echo xargs)}
case $runner in
    parallel) is_gnu || { echo "RUNNER is parallel, but GNU parallel is not here; give RUNNER=xargs" >&2; exit 2; }
              run=(parallel --will-cite --jobs "$jobs" --retries 3 --quote) ;;
    xargs) run=(xargs -P "$jobs" -n 1) ;;
    *) echo "RUNNER is $runner; give parallel or xargs" >&2; exit 2 ;;
esac
source "$here/prepare.sh"

# By the environment, since the runners replace what looks like {} in words. The last word is the share's number.
export scene folder shares
bake_share='exec goffer cache "$scene" -o "$folder" --threads 1 --shard "${*: -1}/$shares" "${@:1:$#-1}"'
code=0
seq "$shares" | "${run[@]}" bash -c "$bake_share" bake_share "${load[@]}" || code=$?
((code == 0)) || echo "bake_local.sh: shares failed (exit code $code of $runner); the last run bakes what is missing" >&2
goffer cache "$scene" -o "$folder" "${load[@]}"
goffer cache --verify "$folder"
