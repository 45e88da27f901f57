#!/usr/bin/env bash
# Builds goffer and runs its tests; arguments go to ctest:
#   bash tests/run.sh [-R REGEX]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash .ci/setup build test
cmake --preset release
cmake --build --preset release
exec ctest --preset release --parallel "$(nproc)" "$@"
