#!/usr/bin/env bash
# Renders a picture in shards with GNU parallel: on this machine, or on those named in HOSTS, such as
# HOSTS=4/one,4/two for four at a time on each. They need halflight and rsync, and no shared folder.
# Run again after an interruption, it goes on from the part files that are there.
#   [HOSTS=HOST,...] [JOBS=N] parallel.sh SCENE PICTURE SHARDS [OPTION of render]...
# Files that the scene names are taken along if ASSETS lists them, separated by spaces.
set -euo pipefail
scene=${1:?SCENE is missing} picture=${2:?PICTURE is missing} shards=${3:?SHARDS is missing}
shift 3
# Arithmetic would run commands in what is not a number.
[[ $shards =~ ^([2-9]|[1-9][0-9]{1,5})$ ]] || { echo "SHARDS must be a whole number of at least 2: $shards" >&2; exit 2; }
# A dot in the name of a folder begins no extension.
[[ ${picture##*/} == ?*.* ]] || { echo "PICTURE has no extension: $picture" >&2; exit 2; }
stem=${picture%.*}
# GNU parallel replaces braces, and evaluates some of what is in them.
[[ "$scene $picture ${ASSETS:-} $*" != *'{'* ]] || { echo "names and options must not contain {" >&2; exit 2; }

parts=()
for ((k = 0; k < shards; k++)); do
    parts+=("$stem.$k-$shards.part")
done
far=()
if [ -n "${HOSTS:-}" ]; then
    part="$stem.{}-$shards.part"
    far=(--sshlogin "$HOSTS" --workdir ... --transferfile "$scene" --transferfile "$part" --return "$part" --cleanup)
    for part in "${parts[@]}"; do
        # What is sent must exist; an empty part is begun.
        : >>"$part"
    done
    for asset in ${ASSETS:-}; do
        far+=(--transferfile "$asset")
    done
fi
parallel --quote --jobs "${JOBS:-100%}" --retries 3 "${far[@]}" \
    halflight render "$scene" -o "$picture" --shard "{}/$shards" --resume --threads 1 "$@" \
    ::: $(seq 0 $((shards - 1)))
halflight merge -o "$picture" -- "${parts[@]}"
