#!/usr/bin/env bash
# The ratios of the README: every bench of this package, on AVX2 and on baseline x86-64, each in its own target directory.
#
#   benches/table.sh [BENCH…]        all of them unless some are named: evaluation batch solution groups chain large orders sweep
set -euo pipefail
cd "$(dirname "$0")/.."
benches=("$@")
[ ${#benches[@]} -gt 0 ] || benches=(evaluation batch solution groups chain large orders sweep)
arguments=()
for bench in "${benches[@]}"; do arguments+=(--bench "$bench"); done
for level in ${LEVELS:-x86-64-v3 x86-64}; do
    echo "== $level"
    RUSTFLAGS="-C target-cpu=$level" cargo bench --quiet -p kin-benches --target-dir "target/benches/$level" "${arguments[@]}"
done
