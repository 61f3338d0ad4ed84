#!/usr/bin/env bash
# Renders a picture in shards, one after the other. Run again after an interruption, it goes on.
#   loop.sh SCENE PICTURE SHARDS [OPTION of render]...
set -euo pipefail
scene=${1:?SCENE is missing} picture=${2:?PICTURE is missing} shards=${3:?SHARDS is missing}
shift 3

for ((k = 0; k < shards; k++)); do
    halflight render "$scene" -o "$picture" --shard "$k/$shards" --resume "$@"
done
halflight merge "${picture%.*}".*-"$shards".part -o "$picture"
