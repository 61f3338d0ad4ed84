#!/bin/sh
# Checks and renders hostile files: how long each takes, how much memory at most, how it ends.
# The bounds are 1 s and 256 MB beside the file itself; what is beyond them is marked with `!`.
#
#     tests/hostile.sh BINARY [FOLDER]
#
# Needs python3 and 5 GB in FOLDER (a new one below the temporary directory unless named).
set -eu
binary=$(realpath "${1:?the binary to test}")
folder=${2:-$(mktemp -d)}
trap 'rm -rf "$folder/hostile"' EXIT
mkdir -p "$folder/hostile"
cd "$folder/hostile"
python3 - "$binary" <<'END'
import os, struct, subprocess, sys, time, zlib

BINARY = sys.argv[1]
MB = 1 << 20
GB = 1 << 30


def write(name, *parts):
    """Writes a file of parts: bytes, or bytes and how often they are repeated."""
    with open(name, "wb") as out:
        for part in parts:
            text, count = part if isinstance(part, tuple) else (part, 1)
            block = text * max(1, min(count, MB // max(1, len(text))))
            while count > 0:
                take = min(count, len(block) // len(text))
                out.write(block[: take * len(text)])
                count -= take
    return name


def png(profile):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    data = zlib.compress(profile, 9)
    return b"".join([
        b"\x89PNG\r\n\x1a\n",
        chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 2, 0, 0, 0)),
        chunk(b"iCCP", b"p\0\0" + data),
        chunk(b"IDAT", zlib.compress(b"\0\1\2\3")),
        chunk(b"IEND", b""),
    ])


def textured(name, picture):
    return write(name, b"texture 1 1 image 1 1 %s\nmat 1 1 1 1 1 0 1 0 1 0 0 1\n"
                 b"obj sphere 1 1 mat 1 0 0 0 1\nuse colour 1 1 mat 1\n" % picture.encode())


def laughs():
    text = b'<!DOCTYPE x [<!ENTITY a0 "ha">'
    for level in range(1, 20):
        text += b'<!ENTITY a%d "%s">' % (level, b"&a%d;" % (level - 1) * 10)
    return text + b"]><xml>&a19;</xml>"


CASES = [
    ("1 GB of zeros", write("zeros.ray", (b"\0", GB))),
    ("the same", write("zeros.dat", (b"\0", GB))),
    ("the same", write("zeros.xml", (b"\0", GB))),
    ("1 GB of zeros behind text", write("late.ray", b"0 0 0\n" * 1000, (b"\0", GB))),
    ("1 GB of one letter", write("letters.ray", (b"a", GB))),
    ("1 GB of blanks", write("blanks.ray", (b" ", GB))),
    ("1 GB of line ends", write("ends.dat", (b"\n", GB))),
    ("1 GB of `<`", write("less.xml", (b"<", GB))),
    ("100000000 objects announced", write("objects.ray", b"0 0 0 0 100000000")),
    ("100000000 lights announced", write("lights.ray", b"0 0 0 100000000")),
    ("100000000 half-spaces", write("cuts.dat", b"obj quadric 1 1 mat 1 " + b"1 " * 10 + b"100000000")),
    ("100000000 shown", write("shown.dat", b"render 100000000 1")),
    ("a number of 1000000 digits", write("digits.ray", b"0 0 0 0 1 ", (b"9", 1000000))),
    ("the same", write("digits.xml", b"<xml><camera><fov value='", (b"9", 1000000), b"'/></camera></xml>")),
    ("not UTF-8", write("bytes.ray", (b"\xff", MB))),
    ("not numbers", write("nan.ray", b"nan inf 1e999 -0 0x1 1 1")),
    ("1000000 nested elements", write("deep.xml", b"<xml><scene>", (b"<object>", 1000000), (b"</object>", 1000000), b"</scene></xml>")),
    ("1000000 that are never closed", write("open.xml", (b"<a>", 1000000))),
    ("1000000 side by side", write("wide.xml", b"<xml><scene>", (b"<object/>", 1000000), b"</scene></xml>")),
    ("a million attributes", write("attributes.xml", b"<xml ", b" ".join(b"a%d='1'" % n for n in range(1000000)), b"/>")),
    ("an attribute twice", write("twice.xml", b"<xml a='1' a='2'/>")),
    ("entities of entities", write("laughs.xml", laughs())),
    ("objects made of each other", write("cycle.dat", b"obj CSG 1 1 union 1 2 1 2\nobj CSG 2 2 union 1 1 1 1\nrender 1 1 1\n")),
    ("5000000 words", write("words.ray", b"0 0 0 0 1 ", (b"a ", 5000000))),
    ("5000000 comments", write("comments.ray", (b"//\n", 5000000))),
    ("a profile of 400 MB", (write("profile.png", png(bytes(400 * MB))), textured("profile.dat", "profile.png"))[1]),
    ("a BMP of 65535x65535", (write("large.bmp", b"BM" + struct.pack("<IHHIIiiHHIIiiII", 54, 0, 0, 54, 40, 65535, 65535, 1, 24, 0, 0, 0, 0, 0, 0)), textured("large.dat", "large.bmp"))[1]),
    ("a PPM of 500 MB", (write("long.ppm", b"P6\n8192 8192\n255\n", (b"\1\2\3", 500 * MB // 3)), textured("long.dat", "long.ppm"))[1]),
    ("an endless device as a picture", textured("device.dat", "../../../dev/zero")),
]


def size_of(scene):
    size = os.stat(scene).st_size
    return size + (os.stat("long.ppm").st_size if scene == "long.dat" else 0)


print(f"{'':34}{'file':>9}{'s':>8}{'MB beside':>11}  exit")
for what, scene in CASES:
    # Read before: what is measured is the program, not the disk.
    open(scene, "rb").read(64 * MB)
    begun = time.monotonic()
    child = subprocess.Popen([BINARY, "check", scene], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    said = child.stderr.read().decode(errors="replace")
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = status
    took = time.monotonic() - begun
    beside = max(0, used.ru_maxrss * 1024 - size_of(scene)) / 1e6
    code = os.waitstatus_to_exitcode(status)
    mark = "!" if 1 < took or 256 < beside or code < 0 or code == 101 else " "
    first = said.strip().split("\n")[0][:70]
    print(f"{mark} {what:32}{os.stat(scene).st_size / 1e6:9.1f}{took:8.2f}{beside:11.0f}  {code:4}  {first}", flush=True)
END
