#!/usr/bin/env bash
# Builds goffer and runs its tests; arguments go to ctest:
#   bash tests/run.sh [-R REGEX]
# PRESET names another preset than `release`; CXX, at the first time, another compiler than g++.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${PRESET:-release}

bash .ci/setup build test
cmake --preset "$preset" -DGOFFER_TESTS=ON  # it may have been configured without them
cmake --build --preset "$preset"
# One more than there are processors: some tests wait most of their time, for a window, a browser or Slurm.
exec ctest --preset "$preset" --parallel "$(($(nproc) + 1))" "$@"
