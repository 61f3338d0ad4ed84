#!/usr/bin/env bash
# Renders a picture in shards with GNU parallel: on this machine, or on those named in HOSTS, such as
# HOSTS=4/one,4/two for four at a time on each. They need halflight and rsync, and no shared folder.
# Run again after an interruption, it goes on with the shards that are not complete.
#   [HOSTS=HOST,...] [JOBS=N] parallel.sh SCENE PICTURE SHARDS [OPTION of render]...
# Files that the scene names are taken along if ASSETS lists them, separated by spaces.
set -euo pipefail
scene=$1 picture=$2 shards=$3
shift 3
stem=${picture%.*}

far=()
if [ -n "${HOSTS:-}" ]; then
    far=(--sshlogin "$HOSTS" --workdir ... --transferfile "$scene" --cleanup --return "$stem.{}-$shards.part")
    for asset in ${ASSETS:-}; do
        far+=(--transferfile "$asset")
    done
fi
parallel --jobs "${JOBS:-100%}" --joblog "$stem.joblog" --resume-failed --retries 3 "${far[@]}" \
    halflight render "$scene" -o "$picture" --shard "{}/$shards" --resume --threads 1 "$@" \
    ::: $(seq 0 $((shards - 1)))
halflight merge "$stem".*-"$shards".part -o "$picture"
