#!/usr/bin/env bash
# Builds goffer, makes the bundled caterpillar, bends it and a crowd of it, and leaves everything in out/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash .ci/setup build
cmake --preset release --log-level=WARNING >/dev/null
cmake --build --preset release --target goffer goffer_caterpillar goffer_crowd_sample

run() {
    printf '\n$ %s\n' "$*"
    PATH=build/release/bin:$PATH "$@"
}
mkdir -p out
run goffer_caterpillar out/caterpillar.glb
run goffer inspect out/caterpillar.glb
run goffer bend out/caterpillar.glb --angle 90 --direction 90 --wrinkle-range 0,0.72 -o out/bent.glb --png out/bent.png --ghost
run goffer_crowd_sample out/caterpillar.glb out

cat <<END

In $PWD/out:
  caterpillar.glb         the bundled model at rest
  bent.glb, bent.png      bent by 90 degrees, its face kept smooth; in the picture the rest shape
                          stands behind it
  crowd.glb, crowd.png    a crowd of it: one body, many poses
END
