#!/usr/bin/env bash
# Runs all tests of robustness, one after the other, and prints a table of the cases tried and of those
# with a bad outcome. Takes less than three hours on two cores.
#
#     tests/robustness.sh BINARY [FOLDER]
#
# FOLDER (default: a new temporary one) receives the log of each row and needs 6 GB for hostile files.
# ROWS selects rows, such as ROWS="fuzzing soak"; MINUTES sets the minutes of fuzzing for each target
# (default 5), SOAK those of the soak (default 20). Needs Rust's toolchain, python3, strace, tmux and the
# editors to be tried. Exits with 1 if any outcome was bad.
set -uo pipefail

binary=$(realpath "${1:?usage: tests/robustness.sh BINARY [FOLDER]}")
folder=${2:-$(mktemp -d)}
mkdir -p "$folder"
folder=$(realpath "$folder")
cd "$(dirname "$0")/.." || exit

bad_rows=0

# Prints a row: its name, what it tries, the number of cases and of bad ones, and the seconds it took.
print() { printf '%-10s %-52s %9s %5s %6s\n' "$@"; }

is_wanted() { [[ -z ${ROWS:-} || " $ROWS " == *" $1 "* ]]; }

# The number of lines of a log that match, or the sum of the runs or executions that they count.
count() {
    grep -E "$1" "$2" | awk '{ for (i = 2; i <= NF; i++) if ($i ~ /^(runs|executions)$/) sum += $(i - 1) }
        END { print sum ? sum : NR }'
}

# Runs the command of a row: its name, what it tries, a pattern of the log's lines that stand for cases,
# one of those that stand for a bad outcome, and the command. A failure without such a line is bad too.
row() {
    local name=$1 what=$2 case=$3 wrong=$4 log=$folder/$1.log begun=$SECONDS code cases bad
    is_wanted "$name" || return 0
    shift 4
    "$@" >"$log" 2>&1 </dev/null
    code=$?
    cases=$(count "$case" "$log")
    bad=$(grep -Ec "$wrong" "$log")
    [ $code -eq 0 ] || [ "$bad" -gt 0 ] || bad=1
    print "$name" "$what" "$cases" "$bad" $((SECONDS - begun))
    [ "$bad" -eq 0 ] || bad_rows=$((bad_rows + 1))
}

# Prints a row of the tests that ran already: its name, what they try, and a pattern of their names.
named() {
    local name=$1 what=$2 pattern="^test ($3)[^ ]* " log=$folder/tests.log cases bad
    is_wanted tests || return 0
    cases=$(grep -Ec "$pattern.*\.\.\. ok" "$log")
    bad=$(grep -Ec "$pattern.*\.\.\. FAILED" "$log")
    # A row without tests is no evidence.
    [ "$cases" -gt 0 ] || bad=1
    print "$name" "$what" "$cases" "$bad" ''
    [ "$bad" -eq 0 ] || bad_rows=$((bad_rows + 1))
}

# Fuzzes each target for some minutes of one core.
fuzz() {
    local targets cores
    cores=$(getconf _NPROCESSORS_ONLN)
    targets=$(find fuzz/corpus -mindepth 1 -maxdepth 1 -type d | wc -l)
    cd fuzz || return
    cargo build --release --no-default-features --bin drive || return
    cargo run --release --no-default-features --bin drive -- --out "$folder/findings" \
        --seconds $((${MINUTES:-5} * 60 * targets / cores))
}

print row what cases bad s
row tests "every test of the project" '^test .* \.\.\. ' '^test .*FAILED|^error' cargo test --no-fail-fast
named R1-R3 "kills, failing calls and metadata, in process" 'file::tests|ui::recovery'
named R5 "changes on disk against unsaved edits" 'document::.*merge|ui::app::tests::(reload|disk|merg|saving)|editing'
named R6 "endings: the terminal as it was, edits kept" 'endings|journals|ui::terminal'
named R7 "closed and full outputs" 'streams'
named R9 "sizes and limits" 'limits|memory::|part::'
named R10 "what scenes may open" 'textures|assets::'
named R12 "trees of rays" 'render::.*(budget|branches|depth)'
row faults "R1 R2 R14: a fault in every call of a write" ' runs .*torn' ' [1-9][0-9]* (torn|lost|left)' \
    tests/faults.sh "$binary" "$folder"
row editors "R4: editors, and names that they might execute" '^(noticed|opened|MISSED|RAN|BROKEN)' '^(MISSED|RAN|BROKEN)' \
    tests/editors.sh "$binary"
row hostile "R8 R9 R10: hostile files, one against each limit" 'check|render|merge|exit' '^!' tests/hostile.py "$binary" "$folder"
row fuzzing "R13: fuzz targets, executions in the log" ' executions$' '^findings: [1-9]' fuzz
row soak "R11 R15: a soak of all kinds of work" '^soak:' '^failed' tests/soak.sh "$binary" "${SOAK:-20}" "$folder"
print '' "rows with a bad outcome" '' $bad_rows ''
exit $((bad_rows > 0))
