#!/usr/bin/env bash
# Submits a picture to Slurm: an array job of shards, and a job that merges them once all have ended,
# and submits again those that are missing, three times at most.
#   submit.sh SCENE PICTURE SHARDS [OPTION of render]...
# SBATCH_* variables set further options, such as SBATCH_PARTITION.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
shards=$3

job=$(sbatch --parsable --array="${MISSING:-0-$((shards - 1))}" "$here/render.sbatch" "$@")
sbatch --parsable --dependency="afterany:$job" "$here/merge.sbatch" "$here" "$@"
