#!/usr/bin/env bash
# Measures what the table in samples/farm/README.md is made from, on this machine: how fast one processor bakes each format,
# into memory and onto the disk of FOLDER, and how fast that disk takes a file of zeros of the same size.
#   bash samples/farm/measure.sh FOLDER
set -euo pipefail
(($# == 1)) || { sed -n '2,4s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2; }
folder=$(mktemp -d -p "$1" goffer-measure-XXXXXX)
memory=$(mktemp -d -p /dev/shm goffer-measure-XXXXXX)
trap 'rm -rf "$folder" "$memory"' EXIT

goffer base --length 40 --radius 1 --columns 50 --rows 200 -o "$folder/worm.ply" >/dev/null # 10,000 vertices
scene() { # INSTANCES ROWS FRAMES
    cat <<END >"$folder/scene.json"
{"version": 1, "fps": 24, "frames": $3,
 "bodies": {"worm": {"file": "worm.ply", "refine": "off", "amplitude": "paper"}},
 "motions": {"sway": {"swing": {"from": -60, "to": 60}, "seconds": 4}},
 "instances": [{"body": "worm", "motion": "sway", "grid": [$1, $2], "spacing": [4, 4], "scatter": 4}]}
END
}
bake() { # FORMAT INTO THREADS
    rm -rf "$2/cache"
    goffer cache "$folder/scene.json" -o "$2/cache" --format "$1" --threads "$3" --json "$folder/report.json" >/dev/null
    python3 - "$folder/report.json" <<'END'
import json, sys
report = json.load(open(sys.argv[1]))
seconds, instances = report["seconds"], report["instances"] * report["frames"]
print(f"{instances / seconds:.4g} instances/s, {instances * 1e4 / seconds:.3g} vertices/s, "
      f"{report['frames_per_second']:.4g} frames/s, {report['mb_per_second']:.0f} MB/s, "
      f"{report['bytes'] / instances:.0f} bytes per instance and frame")
END
    rm -rf "$2/cache"
}
for format in positions packed poses; do
    if [[ $format == poses ]]; then scene 100 100 500; else scene 10 10 80; fi
    for threads in 1 2; do
        printf '%-10s %s thread(s), memory: ' "$format" "$threads"
        bake "$format" "$memory" "$threads"
        printf '%-10s %s thread(s), disk:   ' "$format" "$threads"
        bake "$format" "$folder" "$threads"
    done
done
printf 'disk, dd with fsync: '
dd if=/dev/zero of="$folder/zeros" bs=1M count=960 conv=fsync 2>&1 | tail -n 1
