#!/usr/bin/env bash
# Bakes a cache with Slurm: an array of jobs, one for each share of the shards, and after them one that bakes what they
# left, writes the manifest and verifies it.
#   bash samples/farm/bake.sh SCENE.json FOLDER SHARES [words of goffer cache]..
# Every machine must see scene, folder and goffer under the same names. Prints the numbers of the two jobs.
set -euo pipefail
(($# >= 3)) || { sed -n '2,5s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2; }
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/prepare.sh"

logs=$folder.logs
mkdir -p "$logs"
pattern=${logs//%/%%} # Slurm puts numbers in the place of %a and the like
share=$(sbatch --parsable --array="1-$shares" --output="$pattern/share-%a.log" \
    "$here/bake.sbatch" "$scene" "$folder" "$shares" "${load[@]}")
finish=$(sbatch --parsable --dependency="afterany:$share" --output="$pattern/finish.log" \
    "$here/finish.sbatch" "$scene" "$folder" "${load[@]}")
echo "$share $finish"
