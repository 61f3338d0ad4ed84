#!/usr/bin/env bash
# Saves a scene with real editors while Halflight has it open, and checks that the picture on
# screen changes; then opens the editors from Halflight on scenes whose names they could
# misinterpret. Needs tmux; editors that are not installed are reported and skipped.
#
#     tests/editors.sh target/release/halflight
#
# Each save switches the ambient light between black and white, so that the ball in the middle of
# the picture, lit only by it, appears or disappears.
set -euo pipefail

halflight=$(realpath "${1:?usage: tests/editors.sh path/to/halflight}")
command -v tmux >/dev/null || { echo 'tmux is needed'; exit 1; }

# Not in the system's temporary directory, where vim saves differently.
place=$(mktemp -d "${PLACE:-$PWD}/editors-XXXXXX")
scene=$place/s.ray
tmux=(tmux -L "halflight-editors-$$" -f /dev/null)
failures=0

# Keep the server running while there is no session.
"${tmux[@]}" start-server ';' set-option -g exit-empty off

finish() {
    "${tmux[@]}" kill-server 2>/dev/null || true
    rm -rf "$place"
}
trap finish EXIT

# Prints the scene with a red ambient light of $1.
scene_with() {
    printf '%s 1 1\n1 0 9 0 0 0 0\n1 sphere 0 0 0 1\n1 1 1 0 0 0 0 0 0 1 0 0 1\n' "$1"
    echo '// view: eye 0 0 4 target 0 0 0 up 0 1 0 fov 40 size 80 60'
}

# Prints the content of the screen with its colours.
screen() { "${tmux[@]}" capture-pane -p -e -t halflight; }

# Waits until the screen differs from $1 and is stable.
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

# Waits until the scene has the content of next.ray.
saved() {
    for _ in {1..50}; do
        cmp -s "$scene" "$place/next.ray" && return 0
        sleep 0.2
    done
    return 1
}

# Tests one editor: a name, the program it needs, a command that copies the content of `next.ray`
# to `s.ray` in the scene's directory, and the keys to press in it, if any.
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
            echo "BROKEN   $name did not save the expected content"
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

"${tmux[@]}" kill-session -t halflight

# Names that editors might execute, or take for options, positions, hosts, patterns or lines.
names=(
    '+sil !touch canary.ray' '+12.ray' '-c !touch canary.ray' '--cmd=!touch canary.ray'
    ':!touch canary.ray' '!touch canary.ray' '@a.ray' '|touch canary.ray' '~.ray' '~root.ray'
    '#1.ray' '%.ray' 'two words.ray' "it's \"quoted\".ray" ';touch canary;.ray'
    '$(touch canary).ray' '`touch canary`.ray' '$HOME.ray' '*.ray' '{a,b}.ray' 'a:12.ray'
    'a:12:3:b.ray' 'ssh:localhost:a.ray' $'line\nbreak.ray' 'back\slash.ray'
)

# Waits until the interface is on the screen.
shown() {
    for _ in {1..100}; do
        [[ $(screen) == *SELECT* ]] && return 0
        sleep 0.1
    done
    return 1
}

# Waits until the interface has left the screen.
gone() {
    for _ in {1..100}; do
        [[ $(screen) != *SELECT* ]] && return 0
        sleep 0.1
    done
    return 1
}

# Opens an editor on each of the names: its name, the program it needs, the value of $EDITOR, and
# the keys that insert a line `// seen` above the cursor, save and quit.
open_names() {
    local name=$1 program=$2 editor=$3 file key passed=0
    if ! command -v "$program" >/dev/null; then
        echo "skipped  $name: not installed"
        return
    fi
    for file in "${names[@]}"; do
        rm -rf "$place/names"
        mkdir "$place/names"
        scene_with 1 >"$place/names/$file"
        "${tmux[@]}" new-session -d -s halflight -x 120 -y 40 -c "$place/names" \
            "$(printf 'HOME=%q EDITOR=%q VISUAL= exec %q -- %q' \
                "$place" "$editor" "$halflight" "$file")"
        shown || true
        "${tmux[@]}" send-keys -t halflight E
        gone || true
        sleep 0.5
        for key in "${@:4}"; do
            "${tmux[@]}" send-keys -t halflight "$key"
            sleep 0.2
        done
        shown || true
        if [[ -n $(find "$place" -name 'canary*') ]]; then
            printf 'RAN      %s: %q\n' "$name" "$file"
            failures=$((failures + 1))
        elif ! grep -q '^// seen' "$place/names/$file"; then
            printf 'MISSED   %s: %q was not edited\n' "$name" "$file"
            failures=$((failures + 1))
        else
            passed=$((passed + 1))
        fi
        "${tmux[@]}" kill-session -t halflight 2>/dev/null || true
    done
    echo "opened   $name: $passed of ${#names[@]} names"
}

vi_keys=('O// seen' Escape ':wq!' Enter)
open_names 'vi' vi 'vi -u NONE -N -n' "${vi_keys[@]}"
open_names 'vim' vim 'vim -u NONE -N -n' "${vi_keys[@]}"
open_names 'view' view 'view -u NONE -N -n' "${vi_keys[@]}"
open_names 'neovim' nvim 'nvim -u NONE -n' "${vi_keys[@]}"
open_names 'kakoune' kak 'kak -n' 'O// seen' Escape ':wq' Enter
open_names 'nano' nano 'nano -I' '// seen' Enter C-o Enter C-x
open_names 'micro' micro 'micro' '// seen' Enter C-s C-q
open_names 'emacs' emacs 'emacs -nw -Q' '// seen' Enter C-x C-s C-x C-c

exit $((failures > 0))
