#!/usr/bin/env bash
# Bakes a cache on this machine without Slurm: GNU parallel, or xargs, runs the shares, and what they left is baked at the
# end, with the manifest. The same files come out.
#   bash samples/farm/bake_local.sh SCENE.json FOLDER SHARES [words of goffer cache]..
# JOBS: shares at a time (default: one for each processor). RUNNER: parallel or xargs (default: parallel if it is here).
set -euo pipefail
(($# >= 3)) || { sed -n '2,6s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2; }
scene=$1 folder=$2 shares=$3
shift 3
jobs=${JOBS:-$(nproc)}
runner=${RUNNER:-$(command -v parallel >/dev/null && echo parallel || echo xargs)}

goffer cache "$scene" -o "$folder" --prepare "$@"
share=(goffer cache "$scene" -o "$folder" --threads 1 --shard "{}/$shares")
case $runner in
    parallel) seq "$shares" | parallel --will-cite --jobs "$jobs" --retries 3 --quote "${share[@]}" || true ;;
    xargs) seq "$shares" | xargs -P "$jobs" -I '{}' "${share[@]}" || true ;;
    *) echo "RUNNER is $runner; give parallel or xargs" >&2; exit 2 ;;
esac
goffer cache "$scene" -o "$folder"
goffer cache --verify "$folder"
