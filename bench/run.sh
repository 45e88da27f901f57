#!/usr/bin/env bash
# Builds goffer, runs its benchmarks and writes the report into build/bench/:
#   bash bench/run.sh [--quick] [OPTION OF goffer_bench]...
#   --quick   few samples of the widest instruction sets: two minutes or so instead of a quarter of an hour, and noisier
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

options=(--benchmark_min_time=0.1 --benchmark_repetitions=7)
if [[ ${1-} == --quick ]]; then
    options=(--benchmark_min_time=0.01 --benchmark_repetitions=3 '--benchmark_filter=-/(scalar|sse4.2)/')
    shift
fi

bash .ci/setup build bench
cmake --preset release --log-level=WARNING >/dev/null
cmake --build --preset release --target goffer_bench

out=build/bench
mkdir -p "$out"
echo "running; what it prints goes to $out/run.log"
build/release/bin/goffer_bench --sweep --benchmark_enable_random_interleaving=true "${options[@]}" "$@" \
    --benchmark_out="$out/run.json" --benchmark_out_format=json >"$out/run.log"
python3 bench/report.py "$out/run.json" "$out"

cat <<END

In $PWD/$out:
  report.md    every case: ns, spread, bytes per second, fraction of the floor
  sweep.svg    ns per vertex against vertices per instance, instances and threads
  run.json     the run as Google Benchmark writes it
END
