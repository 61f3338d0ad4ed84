#!/usr/bin/env bash
# Measures the latency of keys over SSH on slow links: a real sshd on the loopback behind a proxy
# that limits the rate and adds delay. Needs Debian's openssh-server, ssh and python3.
#
#     tests/slow-link.sh target/release/halflight [RATE...]
#
# TERM is passed by ssh, COLORTERM is not set. Prints a line for each link: the time from a `j` to
# the complete frame that answers it, with pictures at rest and while they are sent, the bytes that
# a `j` costs, and whether the final picture on the screen equals the one after a complete redraw.
set -euo pipefail

halflight=$(realpath "${1:?usage: tests/slow-link.sh path/to/halflight}")
here=$(cd "$(dirname "$0")" && pwd)
for program in ssh ssh-keygen python3; do
    command -v "$program" >/dev/null || { echo "$program is needed"; exit 1; }
done
sshd=$(command -v sshd || command -v /usr/sbin/sshd) || { echo 'sshd is needed'; exit 1; }

place=$(mktemp -d)
daemon=
finish() {
    [ -z "$daemon" ] || kill "$daemon" 2>/dev/null || true
    rm -rf "$place"
}
trap finish EXIT

ssh-keygen -q -t ed25519 -N '' -f "$place/host"
ssh-keygen -q -t ed25519 -N '' -f "$place/key"
cp "$place/key.pub" "$place/authorized"
port=$(python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')
cat >"$place/config" <<END
Port $port
ListenAddress 127.0.0.1
HostKey $place/host
AuthorizedKeysFile $place/authorized
PidFile none
StrictModes no
UsePAM no
PasswordAuthentication no
PermitRootLogin prohibit-password
AcceptEnv none
END
# Debian's sshd needs this folder when it runs as root.
[ "$(id -u)" != 0 ] || mkdir -p /run/sshd
"$sshd" -D -e -f "$place/config" 2>"$place/log" &
daemon=$!
cp "$here/../scenes/default.ray" "$place/default.ray"
HALFLIGHT=$halflight PLACE=$place PORT=$port python3 "$here/slow-link.py" "${@:2}"
