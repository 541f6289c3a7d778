#!/usr/bin/env bash
# The ratios of benches/README.md: every bench of this package for every instruction set that the processor has, each in its own
# target directory.
#
#   benches/table.sh [BENCH…]        all of them unless some are named: evaluation batch solution groups chain large orders sweep calls
#
# In the profile `bench` every contender is optimised across crates. The benches that call functions of another crate are
# measured in the profile `plain` once more, which is cargo's own for releases. LEVELS and PROFILES choose among them.
set -euo pipefail
cd "$(dirname "$0")/.."
benches=("$@")
[ ${#benches[@]} -gt 0 ] || benches=(evaluation batch solution groups chain large orders sweep calls)
# Benches that also call functions of another crate.
across='^(evaluation|batch|chain)$'
flags=$(grep -m1 '^flags' /proc/cpuinfo 2> /dev/null || true)
available() {
    # What the processor says it has; without that, every level is tried.
    local flag
    case $1 in
        x86-64-v3) set -- avx2 fma bmi2 ;;
        x86-64-v4) set -- avx512f avx512bw avx512cd avx512dq avx512vl ;;
        *) set -- ;;
    esac
    [ -z "$flags" ] && return
    for flag in "$@"; do [[ " $flags " == *" $flag "* ]] || return; done
}
for level in ${LEVELS:-x86-64-v3 x86-64-v4 native x86-64}; do
    if ! available "$level"; then
        echo "== $level: not on this processor"
        continue
    fi
    for profile in ${PROFILES:-bench plain}; do
        arguments=()
        for bench in "${benches[@]}"; do
            [ "$profile" = plain ] && ! [[ $bench =~ $across ]] || arguments+=(--bench "$bench")
        done
        [ ${#arguments[@]} -gt 0 ] || continue
        echo "== $level, profile $profile"
        RUSTFLAGS="-C target-cpu=$level" cargo bench --quiet -p kin-benches --profile "$profile" \
            --target-dir "${CARGO_TARGET_DIR:-target}/benches/$level" "${arguments[@]}"
    done
done
