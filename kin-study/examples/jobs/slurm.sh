#!/usr/bin/env bash
# One part of a study for every job of an array (https://slurm.schedmd.com/job_array.html):
#
#   export PROGRAM=target/release/examples/four_bar STUDY=examples/four_bar.toml OUT=target/four_bar PARTS=100
#   sbatch --array=0-99 examples/jobs/slurm.sh
#
# Jobs that failed are started again by what is missing:
#
#   sbatch --array="$("$PROGRAM" missing "$STUDY" --out "$OUT" --of "$PARTS")" examples/jobs/slurm.sh
#
#SBATCH --job-name=kin-study
#SBATCH --cpus-per-task=4
#SBATCH --time=01:00:00
#SBATCH --requeue
set -eu
exec "$PROGRAM" chunk "$STUDY" --out "$OUT" --resume --threads "$SLURM_CPUS_PER_TASK" \
  --index "$SLURM_ARRAY_TASK_ID" --of "$PARTS"
