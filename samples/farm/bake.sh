#!/usr/bin/env bash
# Bakes a cache with Slurm: an array of jobs, one for each share of the shards, and after them one that bakes what they
# left, writes the manifest and verifies it.
#   bash samples/farm/bake.sh SCENE.json FOLDER SHARES [words of goffer cache]..
# Every machine must see scene, folder and goffer under the same names. Prints the numbers of the two jobs.
set -euo pipefail
(($# >= 3)) || { sed -n '2,5s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2; }
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scene=$(realpath "$1") folder=$(realpath "$2") shares=$3
shift 3

# What is wrong with the scene shows here rather than in every job, and all machines get the same bodies and kernels.
goffer cache "$scene" -o "$folder" --prepare "$@" >&2

logs=$folder.logs
mkdir -p "$logs"
share=$(sbatch --parsable --array="1-$shares" --output="$logs/share-%a.log" "$here/bake.sbatch" "$scene" "$folder" "$shares")
finish=$(sbatch --parsable --dependency="afterany:$share" --output="$logs/finish.log" "$here/finish.sbatch" "$scene" "$folder")
echo "$share $finish"
