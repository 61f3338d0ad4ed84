#!/bin/sh
# Writes files while each system call of a write in turn kills the process or fails.
#
#     tests/faults.sh BINARY [FOLDER]
#
# Needs strace, tmux and a folder on the file system to test (default: the temporary folder;
# /dev/shm is a different file system nearly everywhere). Headless: a new picture, one over an
# existing picture, one over a hard link. Interface: a save over an existing scene, a save through a
# hard link, a picture exported over an existing one, and an edit that is not saved before the
# terminal hangs up ("kept": it must be in the journal). In each case the fault is injected into the
# k-th call of each kind, for every k until none is hit. strace cannot really shorten a write: short
# writes are tested in src/file/tests/faults.rs.
#
# Afterwards the target must hold its old or its new bytes (otherwise it is "torn", or "lost" if it
# does not exist); after a write through a hard link the old bytes may be in a backup copy instead.
# An edit that is not in a journal is "lost" unless the process was killed. After one more write
# nothing else may be left in the folder or among the journals (otherwise it is "left behind").
# KINDS selects the cases, OUTCOMES the faults, LIMIT the greatest k.
#
# Prints a line for each case; exits with 1 if anything was torn, lost or left behind.

set -u
binary=$(realpath "${1:?usage: tests/faults.sh BINARY [FOLDER]}")
folder=$(mktemp -d "${2:-${TMPDIR:-/tmp}}/faults.XXXXXX")
trap 'rm -rf "$folder"' EXIT
export XDG_STATE_HOME="$folder/state" TMPDIR="$folder/temporary"
mkdir "$TMPDIR"

calls="write fsync rename,renameat,renameat2 link,linkat unlink,unlinkat fchmod,fchown ftruncate openat"
outcomes=${OUTCOMES:-signal=KILL error=ENOSPC error=EIO error=EDQUOT error=EINTR}
bad=0

scene() {
    printf '%s\n' '1 1 1' '1 0 9 0 0 0 0' "1 sphere 0 0 0 $1  1 1 1 0 0 0 0 0 0 1 0 0 1" \
        '// view: eye 0 0 5 target 0 0 0 up 0 1 0 fov 40 size 64 48'
}

# Creates the folder of one run: the scene, and the target with its old content.
prepare() {
    rm -rf "$work" "$XDG_STATE_HOME"
    mkdir "$work"
    scene 1 >"$work/a.ray"
    case $1 in
    new) ;;
    replaced | exported) cp "$folder/old" "$work/t.png" ;;
    linked) cp "$folder/old" "$work/t.png" && ln "$work/t.png" "$work/other.png" ;;
    saved | kept) ;;
    saved-linked) ln "$work/a.ray" "$work/other.ray" ;;
    esac
}

# Renders, saves, exports or edits under strace with the options given.
run() {
    kind=$1
    shift
    case $kind in
    saved* | exported | kept)
        tmux -L "faults$$" new-session -d -x 100 -y 30 \
            "cd '$work' && echo \$\$ >'$folder/pid' &&
            exec strace -f -qq -o '$folder/trace' $* '$binary' --color 24 a.ray"
        case $kind in
        saved*)
            keys '' Enter
            keys 'j2' Enter
            keys 'w' ''
            keys ':q!' Enter
            ;;
        exported)
            keys ':export! t.png 1' Enter
            sleep "${PAUSE:-0.5}"
            keys ':q!' Enter
            ;;
        kept)
            keys '' Enter
            keys 'j2' Enter
            # Edits are written to the journal a second later, and again at the end.
            sleep 1.5
            tmux -L "faults$$" kill-server 2>/dev/null
            ;;
        esac
        patience=50
        while kill -0 "$(cat "$folder/pid")" 2>/dev/null && [ $patience -gt 0 ]; do
            sleep 0.1
            patience=$((patience - 1))
        done
        tmux -L "faults$$" kill-server 2>/dev/null
        ;;
    *)
        (cd "$work" && strace -f -qq -o "$folder/trace" "$@" \
            "$binary" render a.ray -o t.png --spp 1 --threads 1; true) >"$folder/log" 2>&1
        ;;
    esac
}

keys() {
    sleep "${PAUSE:-0.5}"
    [ -n "$1" ] && tmux -L "faults$$" send-keys -l "$1" 2>/dev/null
    [ -n "$2" ] && tmux -L "faults$$" send-keys "$2" 2>/dev/null
    sleep 0.2
}

# Checks the state after a run.
judge() {
    kind=$1
    journals=$XDG_STATE_HOME/halflight/recovery
    case $kind in
    kept)
        # The scene itself does not change.
        target=$work/a.ray old=$folder/a.old new=$folder/a.old
        case $outcome in
        *KILL*) ;;
        *) grep -aqs '^edit ' "$journals"/*.ray || lost=$((lost + 1)) ;;
        esac
        ;;
    saved*) target=$work/a.ray old=$folder/a.old new=$folder/a.new ;;
    *) target=$work/t.png old=$folder/old new=$folder/new ;;
    esac
    if [ ! -e "$target" ]; then
        [ "$kind" = new ] || lost=$((lost + 1))
    elif ! cmp -s "$target" "$new" && ! cmp -s "$target" "$old"; then
        is_kept=no
        for copy in "$work"/.halflight-backup-* "$TMPDIR"/.halflight-backup-*; do
            cmp -s "$copy" "$old" && is_kept=yes
        done
        if [ $is_kept = yes ]; then copied=$((copied + 1)); else torn=$((torn + 1)); fi
    fi
    # One more write in the folder.
    (cd "$work" && "$binary" render a.ray -o last.png --spp 1 --threads 1) >/dev/null 2>&1
    [ -e "$work/last.png" ] || (cd "$work" && cp a.ray b.ray && scene 1 >b.ray &&
        "$binary" render b.ray -o last.png --spp 1 --threads 1 && rm b.ray) >/dev/null 2>&1
    if find "$work" -name '.halflight-*' ! -name '.halflight-backup-*' | grep -q .; then
        left=$((left + 1))
    fi
    if [ "$kind" = kept ]; then
        # The next run offers the journal; discarding it must remove it.
        tmux -L "faults$$" new-session -d -x 100 -y 30 \
            "cd '$work' && echo \$\$ >'$folder/pid' && exec '$binary' --color 24 a.ray"
        keys 'd' ''
        keys ':q!' Enter
        tmux -L "faults$$" kill-server 2>/dev/null
        if find "$journals" -type f 2>/dev/null | grep -q .; then left=$((left + 1)); fi
    fi
}

# Injects every fault into every call of one case.
check() {
    kind=$1
    for outcome in $outcomes; do
        runs=0 torn=0 lost=0 left=0 copied=0
        # Without write and openat, which the interface uses mostly for its terminal and for reading.
        case $kind in
        saved* | exported | kept) some="fsync rename,renameat,renameat2 link,linkat unlink,unlinkat fchmod,fchown ftruncate" ;;
        *) some=$calls ;;
        esac
        for call in $some; do
            k=1
            while [ $k -le "${LIMIT:-400}" ]; do
                prepare "$kind"
                : >"$folder/trace"
                run "$kind" -e "trace=$call" -e "inject=$call:$outcome:when=$k"
                runs=$((runs + 1))
                judge "$kind"
                if ! grep -q 'INJECTED\|killed by SIGKILL' "$folder/trace"; then
                    # No call was hit: the write must be complete.
                    cmp -s "$target" "$new" || lost=$((lost + 1))
                    break
                fi
                k=$((k + 1))
            done
        done
        printf '%-14s %-14s %6d runs  %3d torn  %3d lost  %3d left behind  %3d in a copy\n' \
            "$kind" "$outcome" $runs $torn $lost $left $copied
        bad=$((bad + torn + lost + left))
    done
}

work=$folder/work
mkdir "$work"
scene 1 >"$work/a.ray"
"$binary" render "$work/a.ray" -o "$folder/new.png" --spp 1 --threads 1 &&
    mv "$folder/new.png" "$folder/new" && printf 'an old picture' >"$folder/old"
for kind in ${KINDS:-new replaced linked saved saved-linked exported kept}; do
    scene 1 >"$folder/a.old"
    scene 2 >"$folder/a.new"
    check "$kind"
done
[ $bad -eq 0 ]
