#!/usr/bin/env bash
# How long a chain of four-bar loops, geared in series, takes to compile in release as a user gets it: a crate with the
# mechanism and a `main` that evaluates it and runs position analysis, macro included, dependencies built before.
#
#   benches/compile_time.sh [LOOPS] [ROUNDS]
#
# Crates are compiled in turns – an empty one, the chain written with a range, the chain written out – and medians are
# printed, as wall time and as processor time, and beyond the empty crate.
set -euo pipefail
loops=${1:-100}
rounds=${2:-7}
root=$(cd "$(dirname "$0")/.." && pwd)
work=${CARGO_TARGET_DIR:-$root/target}/compile_time
mkdir -p "$work"
export CARGO_TARGET_DIR=$work/target

crate() {
    mkdir -p "$work/$1/src"
    cat > "$work/$1/Cargo.toml" <<EOF
[package]
name = "$1"
version = "0.0.0"
edition = "2024"

[dependencies]
kin-runtime = { path = "$root/kin-runtime" }

[workspace]
EOF
    cat > "$work/$1/src/main.rs"
}

use_of() {
    cat <<'EOF'
use kin_runtime::{Instant, Kinematics, Mechanism, Subset, mechanism};

fn main() {
    let (chain, at) = (Chain::default(), Instant::at(0.1));
    let q: Vec<f64> = (0..Chain::COORDINATES).map(|k| (k as f64 * 0.7).sin()).collect();
    let mut workspace = Chain::workspace::<f64>();
    chain.evaluate(Subset::ALL, &at, &q, &q, &mut workspace).expect("as many coordinates");
    println!("{}", workspace.gamma().iter().sum::<f64>());
    println!("{:?}", chain.position_analysis(&at, &q).map(|q| q[0]).ok());
}
EOF
}

fields() {
    for field in 'l1 0.1' 'l2 0.4' 'l3 0.3' 'd1 0.4' 'd2 0.1'; do
        set -- $field
        echo "    #[param($2)] $1: [f64; $loops],"
    done
    echo '    #[param(0.1)] r: f64, #[param(0.7)] phi0: f64, #[param(1.0)] omega: f64,'
}

ranged() {
    use_of
    cat <<EOF
#[mechanism]
#[bodies(crank[$loops], coupler[$loops], rocker[$loops])]
#[revolute(C[i in 0..$loops]: ground @ (0, 0), crank[i] @ (-l1[i]/2, 0))]
#[revolute(A[i in 0..$loops]: crank[i] @ (l1[i]/2, 0), coupler[i] @ (-l2[i]/2, 0))]
#[revolute(B[i in 0..$loops]: coupler[i] @ (l2[i]/2, 0), rocker[i] @ (-l3[i]/2, 0))]
#[revolute(D[i in 0..$loops]: rocker[i] @ (l3[i]/2, 0), ground @ (d1[i], d2[i]))]
#[gear(mesh[i in 1..$loops]: rocker[i - 1], crank[i], radii = (r, r))]
#[driver(drive: crank[0].phi = phi0 + omega * t)]
pub struct Chain {
$(fields)
}
EOF
}

written_out() {
    use_of
    echo '#[mechanism]'
    for ((k = 0; k < loops; k++)); do
        echo "#[bodies(crank$k, coupler$k, rocker$k)]"
    done
    for ((k = 0; k < loops; k++)); do
        echo "#[revolute(C$k: ground @ (0, 0), crank$k @ (-l1[$k]/2, 0))]"
        echo "#[revolute(A$k: crank$k @ (l1[$k]/2, 0), coupler$k @ (-l2[$k]/2, 0))]"
        echo "#[revolute(B$k: coupler$k @ (l2[$k]/2, 0), rocker$k @ (-l3[$k]/2, 0))]"
        echo "#[revolute(D$k: rocker$k @ (l3[$k]/2, 0), ground @ (d1[$k], d2[$k]))]"
        if ((k == 0)); then
            echo "#[driver(drive: crank0.phi = phi0 + omega * t)]"
        else
            echo "#[gear(mesh$k: rocker$((k - 1)), crank$k, radii = (r, r))]"
        fi
    done
    echo 'pub struct Chain {'
    fields
    echo '}'
}

echo 'fn main() { println!("nothing"); }' | crate empty
ranged | crate ranged
written_out | crate written_out

names=(empty ranged written_out)
build() {
    # Always anew, but nothing else: whatever cargo itself takes is in all three.
    touch "$work/$1/src/main.rs"
    (cd "$work/$1" && cargo build --release --quiet --offline)
}
for name in "${names[@]}"; do
    (cd "$work/$name" && { [ -e Cargo.lock ] || cp "$root/Cargo.lock" . ; cargo build --release --quiet; })
done
rm -f "$work"/*.times
for ((round = 0; round < rounds; round++)); do
    for name in "${names[@]}"; do
        TIMEFORMAT='%R %U %S'
        { time build "$name"; } 2>> "$work/$name.times"
    done
done
# Medians of wall time and of processor time.
median() { sort -g | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }
echo "$loops loops, medians of $rounds rounds, seconds"
printf '%12s %8s %8s %14s %14s\n' '' wall cpu 'wall − empty' 'cpu − empty'
for name in "${names[@]}"; do
    wall=$(awk '{ print $1 }' "$work/$name.times" | median)
    cpu=$(awk '{ print $2 + $3 }' "$work/$name.times" | median)
    [ "$name" = empty ] && empty_wall=$wall && empty_cpu=$cpu
    awk -v n="$name" -v w="$wall" -v c="$cpu" -v ew="$empty_wall" -v ec="$empty_cpu" \
        'BEGIN { printf "%12s %8.2f %8.2f %14.2f %14.2f\n", n, w, c, w - ew, c - ec }'
done
