#!/usr/bin/env bash
# One part of a study for every task of an array (https://it4innovations.github.io/hyperqueue):
#
#   export PROGRAM=target/release/examples/four_bar STUDY=examples/four_bar.toml OUT=target/four_bar PARTS=100
#   hq submit --env PROGRAM="$PROGRAM" --env STUDY="$STUDY" --env OUT="$OUT" --env PARTS="$PARTS" \
#     --array 0-99 --cpus 1 examples/jobs/hyperqueue.sh
#
# A task whose worker was lost is started again by HyperQueue and goes on behind the last rows that were written.
set -eu
exec "$PROGRAM" chunk "$STUDY" --out "$OUT" --resume --threads 1 \
  --index "$HQ_TASK_ID" --of "$PARTS"
