#!/usr/bin/env bash
# Renders a picture in shards, one after the other. Run again after an interruption, it goes on.
#   loop.sh SCENE PICTURE SHARDS [OPTION of render]...
set -euo pipefail
scene=${1:?SCENE is missing} picture=${2:?PICTURE is missing} shards=${3:?SHARDS is missing}
shift 3
# Arithmetic would run commands in what is not a number.
[[ $shards =~ ^([2-9]|[1-9][0-9]{1,5})$ ]] || { echo "SHARDS must be a whole number of at least 2: $shards" >&2; exit 2; }
# A dot in the name of a folder begins no extension.
[[ ${picture##*/} == ?*.* ]] || { echo "PICTURE has no extension: $picture" >&2; exit 2; }
stem=${picture%.*}

parts=()
for ((k = 0; k < shards; k++)); do
    halflight render "$scene" -o "$picture" --shard "$k/$shards" --resume "$@"
    parts+=("$stem.$k-$shards.part")
done
halflight merge -o "$picture" -- "${parts[@]}"
