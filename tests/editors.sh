#!/usr/bin/env bash
# Saves a scene with real editors while Halflight has it open, and looks whether the picture on
# screen changes. Needs tmux; editors that are not installed are skipped and named.
#
#     tests/editors.sh target/release/halflight
#
# Each save changes ambient light from black to white or back, so that the ball in the middle of
# the picture, lit by ambient light alone, appears or is gone.
set -euo pipefail

halflight=$(realpath "${1:?usage: tests/editors.sh path/to/halflight}")
command -v tmux >/dev/null || { echo 'tmux is needed'; exit 1; }

# Not in the directory for temporary files: vim saves in another way there.
place=$(mktemp -d "${PLACE:-$PWD}/editors-XXXXXX")
scene=$place/s.ray
tmux=(tmux -L "halflight-editors-$$" -f /dev/null)
failures=0

finish() {
    "${tmux[@]}" kill-server 2>/dev/null || true
    rm -rf "$place"
}
trap finish EXIT

# The scene with ambient light of $1.
scene_with() {
    printf '%s 1 1\n1 0 9 0 0 0 0\n1 sphere 0 0 0 1\n1 1 1 0 0 0 0 0 0 1 0 0 1\n' "$1"
    echo '// view: eye 0 0 4 target 0 0 0 up 0 1 0 fov 40 size 80 60'
}

# What is on the screen, with its colours.
screen() { "${tmux[@]}" capture-pane -p -e -t halflight; }

# Waits until the screen differs from $1 and has been the same twice.
changed_from() {
    local old=$1 now='' before
    for _ in {1..50}; do
        before=$now
        now=$(screen)
        [[ $now != "$old" && $now == "$before" ]] && return 0
        sleep 0.2
    done
    return 1
}

# Waits until the scene holds what it is to hold.
saved() {
    for _ in {1..50}; do
        cmp -s "$scene" "$place/next.ray" && return 0
        sleep 0.2
    done
    return 1
}

# Tries one editor: a name, the program it needs, a command that makes `s.ray` hold what
# `next.ray` holds, in the scene's directory, and the keys to press in it, if it needs any.
try() {
    local name=$1 program=$2 command=$3 red old key
    if ! command -v "$program" >/dev/null; then
        echo "skipped  $name: not installed"
        return
    fi
    for red in 0 1; do
        scene_with "$red" >"$place/next.ray"
        old=$(screen)
        "${tmux[@]}" new-session -d -s editor -x 80 -y 24 -c "$place" "$command"
        for key in "${@:4}"; do
            sleep 0.3
            "${tmux[@]}" send-keys -t editor "$key"
        done
        if ! saved; then
            echo "BROKEN   $name did not save what it was to save"
            failures=$((failures + 1))
            cp "$place/next.ray" "$scene"
        elif changed_from "$old"; then
            echo "noticed  $name"
        else
            echo "MISSED   $name"
            failures=$((failures + 1))
        fi
        "${tmux[@]}" kill-session -t editor 2>/dev/null || true
    done
}

scene_with 1 >"$scene"
"${tmux[@]}" new-session -d -s halflight -x 120 -y 40 -c "$place" "$(printf '%q s.ray' "$halflight")"
changed_from '' || { echo 'Halflight shows nothing'; exit 1; }

vim='vim -u NONE -N -n'
take='-c "%d" -c "r next.ray" -c "1d" -c "wq"'
emacs='(progn (find-file "s.ray") (erase-buffer) (insert-file-contents "next.ray") (save-buffer) (kill-emacs))'

try 'vim, backupcopy=no' vim "$vim -c 'set backup writebackup backupcopy=no' $take s.ray"
try 'vim, backupcopy=yes' vim "$vim -c 'set writebackup backupcopy=yes' $take s.ray"
try 'neovim' nvim "nvim -u NONE -n $take s.ray"
try 'nano' nano 'nano -I s.ray' M-t C-r next.ray Enter C-o Enter C-x
try 'emacs' emacs "emacs -nw -Q --eval $(printf '%q' "$emacs")"
try 'sed -i' sed 'sed -i -e "1r next.ray" -e d s.ray'
try 'mv' mv 'cp next.ray new.ray; mv new.ray s.ray'
try 'cp' cp 'cp next.ray s.ray'
try 'slow writer' sh '(head -1 next.ray; sleep 0.3; tail -n +2 next.ray) > s.ray'
try 'rm, then cp' rm 'rm s.ray; sleep 1; cp next.ray s.ray'

exit $((failures > 0))
