#!/usr/bin/env bash
# Renders a picture by tests/recipes/slurm on a running Slurm cluster, and disturbs it: a task is killed,
# one is warned of the end of its time, one preempted, the node drained and resumed, a part damaged. The
# picture must be that of a single render. Needs sbatch, two partitions of which HIGH preempts LOW, root
# for draining, and halflight on the path or in HALFLIGHT; takes a few minutes.
#   [HALFLIGHT=FILE] [LOW=low] [HIGH=high] slurm.sh [FOLDER]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
scene=$here/../scenes/default.ray
folder=${1:-$(mktemp -d)}
export SBATCH_PARTITION=${LOW:-low}
[ -z "${HALFLIGHT:-}" ] || PATH=$(cd "$(dirname "$HALFLIGHT")" && pwd):$PATH
options=(--size 1600x1200 --spp 96)
mkdir -p "$folder"
cd "$folder"
rm -f ./*.part out.png ./*.log

say() { echo "$(date +%T) $*"; }
await() { # DESCRIPTION COMMAND...
    local what=$1 queued
    shift
    for _ in $(seq 600); do
        if "$@" > /dev/null 2>&1; then return; fi
        # A job that was queued again waits two minutes otherwise.
        for queued in $(squeue -h -t PD -o %F_%K 2> /dev/null | sed '/\[/d'); do
            scontrol update "JobId=$queued" StartTime=now > /dev/null 2>&1 || true
        done
        sleep 0.5
    done
    say "gave up waiting: $what"
    squeue
    exit 1
}
running() { [ -n "$(squeue -h -j "$1" -t R -o %i)" ]; }
ended() { [ -z "$(squeue -h -j "$1" -o %i)" ]; }
first_running() { squeue -h -j "$job" -t R -o %F_%K | sed -n 1p; }
grown() { [ "$(stat -c %s "$1" 2> /dev/null || echo 0)" -gt "${2:-100000}" ]; }

say "a single render"
halflight render "$scene" -o whole.png "${options[@]}"

merge=$("$here/recipes/slurm/submit.sh" "$scene" out.png 8 "${options[@]}")
job=$((merge - 1))
say "array $job of 8 shards, merge $merge"

await "a task" running "$job"
task=$(first_running)
await "its part" grown "out.${task#*_}-8.part"
say "kill task $task"
pkill -KILL -f -- "--shard ${task#*_}/8" || true

another() { other=$(first_running) && [ -n "$other" ] && [ "$other" != "$task" ]; }
await "another task" another
await "its part" grown "out.${other#*_}-8.part"
say "warn task $other, as before the end of its time"
# It waits for an answer that a job queued again does not give.
timeout 5 scancel --batch --signal=USR1 "$other" || true
await "its exit with 75" grep -q "stopped by SIGUSR1" "halflight-${other#*_}.log"
grep -h "stopped by" "halflight-${other#*_}.log"

await "a task to preempt" running "$job"
preempted=$(first_running)
await "its part" grown "out.${preempted#*_}-8.part"
say "preempt task $preempted"
high=$(sbatch --parsable --partition="${HIGH:-high}" --exclusive --output=/dev/null --wrap "sleep 2")
await "the other job" running "$high"
squeue
await "its end" ended "$high"

node=$(scontrol show hostnames "$(sinfo -h -o %N)" | head -1)
say "drain $node"
scontrol update "NodeName=$node" State=DRAIN Reason=test
sleep 3
sinfo
scontrol update "NodeName=$node" State=RESUME
say "resumed"

whole() { [[ $(halflight merge --missing out.0-8.part) != 0* ]]; }
await "a whole part" whole
say "damage out.0-8.part"
printf X | dd of=out.0-8.part bs=1 seek=200000 conv=notrunc status=none

await "the picture" test -e out.png
cmp whole.png out.png
say "the picture is that of a single render"
cat halflight-merge.log
