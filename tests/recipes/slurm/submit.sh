#!/usr/bin/env bash
# Submits a picture to Slurm: an array job of shards, and a job that merges them once all have ended,
# and submits again those that are missing, three times at most.
#   submit.sh SCENE PICTURE SHARDS [OPTION of render]...
# SBATCH_* variables set further options, such as SBATCH_PARTITION.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
picture=${2:?PICTURE is missing} shards=${3:?SHARDS is missing}
# Arithmetic would run commands in what is not a number.
[[ $shards =~ ^([2-9]|[1-9][0-9]{1,5})$ ]] || { echo "SHARDS must be a whole number of at least 2: $shards" >&2; exit 2; }
# A dot in the name of a folder begins no extension.
[[ ${picture##*/} == ?*.* ]] || { echo "PICTURE has no extension: $picture" >&2; exit 2; }

job=$(sbatch --parsable --array="${MISSING:-0-$((shards - 1))}" "$here/render.sbatch" "$@")
sbatch --parsable --dependency="afterany:$job" "$here/merge.sbatch" "$here" "$@"
