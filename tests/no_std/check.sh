#!/usr/bin/env bash
# Builds the proof that evaluation needs neither std nor an allocator; either, creeping in, stops the build.
set -euo pipefail
cd "$(dirname "$0")"
cargo fmt --check
cargo build --locked --target-dir ../../target/no_std
cargo build --locked --release --target-dir ../../target/no_std
