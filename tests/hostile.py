#!/usr/bin/env python3
"""Gives the program hostile files, and measures time, peak memory and exit code.

    tests/hostile.py BINARY [FOLDER [FILE...]]

The first error of a scene must appear within 1 s in addition to the time that the machine takes to read
the scene into memory, and take at most 256 MB in addition to the scene's text, which is kept for
messages, and the pixels of its pictures. Scenes with an error at the end may take as long as reading
them, and five times their length. Parts, tracks, lists of frames, configurations
and scripts of keys must be refused or read within 1 s and 256 MB in all. Violations are marked with `!` and make
the exit code 1. Needs 6 GB in FOLDER (default: a new one in the temporary directory). FILE limits the
run to files of these names.
"""

import os
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import zlib

MB = 1 << 20
GB = 1 << 30

SECONDS = 1
BESIDE = 256e6
TIMES_THE_TEXT = 5

HEAD = b"0 0 0 1 0 0 0 1 1 1 "
SPHERE = b"sphere 0.5 0.25 -3 1 0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n"
# Names of the files that are tested; none: all.
SELECTED = sys.argv[3:]

NUMBERS = b"0.25 1 -3.5 12.125 7 0.5\n"


def write(name, *parts):
    """Writes a selected file from parts: bytes, or pairs of bytes and a repeat count."""
    if SELECTED and name not in SELECTED:
        return name
    with open(name, "wb") as out:
        for part in parts:
            text, count = part if isinstance(part, tuple) else (part, 1)
            block = text * max(1, min(count, MB // max(1, len(text))))
            while count > 0:
                take = min(count, len(block) // len(text))
                out.write(block[: take * len(text)])
                count -= take
    return name


def filled(name, *parts):
    """Like write, with counts in bytes."""
    return write(name, *((p[0], p[1] // len(p[0])) if isinstance(p, tuple) else p for p in parts))


def in_child(make):
    """Creates or reads a large file in a child process: the peak memory reported for a process includes that
    of its parent when it was started."""
    child = os.fork()
    if child == 0:
        make()
        os._exit(0)
    if os.waitpid(child, 0)[1] != 0:
        sys.exit("a file cannot be created or read")


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(*chunks):
    return b"".join([
        b"\x89PNG\r\n\x1a\n",
        chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 2, 0, 0, 0)),
        *chunks,
        chunk(b"IDAT", zlib.compress(b"\0\1\2\3")),
        chunk(b"IEND", b""),
    ])


def stored(size):
    """A deflate stream of uncompressed zeros."""
    blocks = [b"\x78\x01"]
    for left in range(size, 0, -65535):
        length = min(left, 65535)
        blocks.append(struct.pack("<BHH", left <= 65535, length, 65535 - length) + bytes(length))
    return b"".join(blocks) + struct.pack(">I", (size % 65521) << 16 | 1)


def bmp(side):
    return b"BM" + struct.pack("<IHHIIiiHHIIiiII", 54, 0, 0, 54, 40, side, side, 1, 24, 0, 0, 0, 0, 0, 0)


def textured(name, picture):
    """Writes a scene that uses one picture."""
    return write(name, b"mat ID 1 1 1 1 1 0 1 0 1 0 0 1\nobj sphere ID 1 mat ID 1 0 0 0 1\n"
                 b"texture ID 1 image 1 1 %s\nuse colour ID 1 mat ID 1\n" % picture.encode())


def laughs():
    text = b'<!DOCTYPE x [<!ENTITY a0 "ha">'
    for level in range(1, 20):
        text += b'<!ENTITY a%d "%s">' % (level, b"&a%d;" % (level - 1) * 10)
    return text + b"]><xml>&a19;</xml>"


def texts():
    """Malformed scenes: descriptions and file names."""
    yield "1 GB of zeros", write("zeros.ray", (b"\0", GB))
    yield "the same", write("zeros.dat", (b"\0", GB))
    yield "the same", write("zeros.xml", (b"\0", GB))
    yield "1 GB of zeros after text", write("late-zeros.ray", b"0 0 0\n" * 1000, (b"\0", GB))
    for end in ("ray", "dat", "xml"):
        yield "400 MB of `a`", filled("letters." + end, (b"a", 400 * MB))
        yield "400 MB of line ends", filled("ends." + end, (b"\n", 400 * MB))
    yield "1 GB of blanks", write("blanks.ray", (b" ", GB))
    yield "1 GB of `<`", write("less.xml", (b"<", GB))
    yield "420 MB of numbers", filled("numbers.ray", (NUMBERS, 420 * MB))
    yield "the same", filled("numbers.dat", (NUMBERS, 420 * MB))
    yield "the same in one line", filled("line.dat", (b"1 ", 420 * MB))
    yield "420 MB of numbers after a head", filled("surplus.ray", HEAD + b"1 ", (b"1 ", 420 * MB))
    yield "400 MB of words", filled("words.ray", HEAD + b"1 ", (b"a ", 400 * MB))
    yield "400 MB of comments", filled("comments.ray", (b"//\n", 400 * MB))
    yield "10000000 bad objects", write("bad.ray", HEAD + b"10000000\n", (b"spher 0 0 0 1 1\n", 10000000))
    yield "10000000 bad records", write("bad.dat", (b"obj spere 1 2 3\n", 10000000))
    yield "1000000, few enough to read all", write("few.ray", HEAD + b"1000000\n", (b"spher 0 0 0 1 1\n", 1000000))
    yield "the same", write("few.dat", (b"obj spere 1 2 3\n", 1000000))
    yield "500000 undefined materials", write("names.dat", (b"obj sphere ID 1 mat ID 7 0 0 0 1\n", 500000))
    yield "8000000 spheres, 1 announced", write("spheres.ray", HEAD + b"1\n", (SPHERE, 8000000))
    yield "100000000 objects announced", write("objects.ray", HEAD + b"100000000")
    yield "100000000 lights announced", write("lights.ray", b"0 0 0 100000000")
    yield "100000000 half-spaces announced", write("cuts.dat", b"mat ID 1 1 1 1 1 1 0 1 0 0 1\nobj quadric ID 1 mat ID 1 " + b"1 " * 10 + b"100000000")
    yield "100000000 IDs announced", write("shown.dat", b"render 100000000 ID 1")
    yield "a number of 1000000 digits", write("digits.ray", b"0 0 ", (b"9", 1000000))
    yield "the same", write("digits.xml", b"<xml><scene/><camera><fov value='", (b"9", 1000000), b"'/></camera></xml>")
    yield "not UTF-8", write("bytes.ray", (b"\xff", MB))
    yield "400 MB of invalid UTF-8", write("late-bytes.ray", b"0 ", (b"\xff", 400 * MB))
    yield "not numbers", write("nan.ray", b"nan inf 1e999 -0 0x1 1 1")
    yield "1000000 nested elements", write("deep.xml", b"<xml><scene>", (b"<object>", 1000000), (b"</object>", 1000000), b"</scene></xml>")
    yield "1000000 unclosed elements", write("open.xml", (b"<a>", 1000000))
    yield "a million attributes", write("attributes.xml", b"<xml ", (b"a='1' ", 1000000), b"/>")
    yield "an attribute twice", write("twice.xml", b"<xml a='1' a='2'/>")
    yield "entities of entities", write("laughs.xml", laughs())
    yield "objects that contain each other", write("cycle.dat", b"obj CSG ID 1 union ID 2 ID 2\nobj CSG ID 2 union ID 1 ID 1\nrender 1 ID 1\n")


def pictures():
    """Scenes with a hostile picture, with the size of its pixels in bytes."""
    def case(what, name, content, pixels=0):
        in_child(content)
        scene = os.path.splitext(name)[0] + "-picture.dat"
        return what, textured(scene, name), pixels

    yield case("a PNG with a profile of 400 MB", "deflated.png", lambda: write("deflated.png", png(chunk(b"iCCP", b"p\0\0" + zlib.compress(bytes(400 * MB), 9)))))
    yield case("the same, uncompressed", "stored.png", lambda: write("stored.png", png(chunk(b"iCCP", b"p\0\0" + stored(400 * MB)))))
    yield case("a PNG with a text of 400 MB", "text.png", lambda: write("text.png", png(chunk(b"tEXt", b"k\0" + b"t" * (400 * MB)))))
    comment = b"\xff\xfe\xff\xff" + b"c" * 65533
    yield case("a JPEG of 393 MB of comments", "comments.jpg", lambda: write("comments.jpg", b"\xff\xd8", (comment, 6000), b"\xff\xd9"))
    frame = b"\xff\xd8\xff\xc0\0\x0b\x08\0\x10\0\x10\1\1\x11\0\xff\xda\0\x08\1\1\0\0\x3f\0"
    yield case("a JPEG of 400 MB for 16x16", "long.jpg", lambda: write("long.jpg", frame, (b"\1", 400 * MB)))
    yield case("a BMP of 65535x65535", "large.bmp", lambda: write("large.bmp", bmp(65535)))
    yield case("a PPM of 500 MB", "long.ppm", lambda: write("long.ppm", b"P6\n8192 8192\n255\n", (b"\1\2\3", 500 * MB // 3)), 3 << 26)
    yield "an endless device as a picture", textured("device.dat", "../../../dev/zero"), 0


def late():
    """Scenes with an error at the end."""
    yield "420 MB of spheres, then a word", write("late.ray", HEAD + b"8600000\n", (SPHERE, 8600000), b"sphere x")
    yield "420 MB of lights, no objects", filled("late-lights.ray", b"0 0 0 36700000 ", (b"1 2 3 1 1 1\n", 420 * MB))
    yield "200 MB of records, then a word", write("late.dat", b"mat ID 1 1 1 1 1 1 0 1 0 0 1\n", (b"// obj\n", 30000000), b"obj x")


def part(size, shard="0/1"):
    """The header of a part, without blocks."""
    header = (f"halflight part 2\nversion 0.1.0\nscene {'0' * 64}\nview own\nlayers none\nsize {size}\n"
              "region none\ndepth 8\nseed 0\naov none\nintegrator whitted\nfilter box\ntransfer linear\n"
              f"exposure 0\nfalloff none\ngloss none\nshard {shard}\n").encode()
    return header + b"crc %08x\n" % zlib.crc32(header)


def small_texts():
    """Texts that are too long for what people write by hand, or just short enough."""
    yield "60 MB of line ends", (b"\n", 60 * MB)
    yield "1 MB of line ends", (b"\n", MB)
    yield "1 MB of `[`", (b"[", MB)
    yield "1 MB of `a.`", (b"a.", MB // 2)
    yield "1 MB of one word", (b"a", MB)
    # The last is no key: a script that can be read would be played, for as long as its keys take.
    yield "1 MB of words", (b"a ", MB // 2 - 2), b"word"
    yield "1 MB of quotes", (b'"\n', MB // 2)
    yield "1 MB of keys", b"".join(b"k%d = %d\n" % (number, number) for number in range(55000))
    yield "1 MB of tables", b"".join(b"[k%d]\n" % number for number in range(100000))
    yield "1 MB of empty tracks", (b"[[track]]\n", 100000)
    yield "1 MB of keys of one track", b"frames = 9\n[[track]]\nthing = 'light 1'\nfield = 'position'\nkeys = [" + (
        b"{frame = 0, value = 1}," * 43000) + b"]\n"
    yield "1 MB of numbers", b"frames = 9\nx = [" + b"1," * (MB // 2 - 20) + b"]\n"


def inputs():
    """Other files than scenes: descriptions, file names and command lines."""
    merge = ["merge", "big.part", "-o", "out.ppm"]
    for size, shard in [("16384x16384", "0/1"), ("16384x16384", "3/7"), ("268435456x1", "0/1"),
                        ("268435456x1", "0/2"), ("4294967295x4294967295", "0/1")]:
        yield f"a part of {size}, shard {shard}", write("big.part", part(size, shard)), merge
        yield "the same, what is missing", write("big.part", part(size, shard)), ["merge", "big.part", "--missing"]
    frames = ["--size", "4x3", "--spp", "1"]
    for what, *content in small_texts():
        track = write("track.toml", *content)
        yield f"track: {what}", track, ["render", "ball.ray", "--track", track, "-o", "t.%d.ppm", *frames]
    for what, *content in small_texts():
        config = write("config.toml", *content)
        yield f"configuration: {what}", config, ["--config", config, "--print-config"]
    for what, *content in small_texts():
        keys = write("script.keys", *content)
        yield f"keys: {what}", keys, ["ball.ray", "--keys", keys, "--screen", "80x24", "--dump-frame", "out.txt"]
    line = b"%s %s u.0.ppm\n" % (b"0" * 64, b"1" * 64)
    for what, content in [("a line of 300 MB", (b"a", 300 * MB)), ("300 MB of line ends", (b"\n", 300 * MB)),
                          ("300 MB of one frame", (line, 300 * MB // len(line))),
                          ("300 MB of words", (b"a b c\n", 50 * MB))]:
        listed = write("u.frames", b"halflight frames 1\n", content)
        yield f"list: {what}", listed, ["render", "ball.ray", "--turntable", "2", "-o", "u.%d.ppm", *frames]
    yield "4294967295 frames", write("none", b"x"), ["render", "ball.ray", "--turntable", "4294967295", "-o", "v.%d.ppm"]


def measured(arguments):
    """Runs a program; returns seconds, CPU seconds, peak resident bytes, exit code and first message."""
    begun = time.monotonic()
    child = subprocess.Popen(arguments, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    output = child.stderr.read().decode(errors="replace")
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    errors = [line for line in output.split("\n") if line.startswith(("error", "warning"))]
    first = (errors or output.split("\n"))[0]
    spent = used.ru_utime + used.ru_stime
    return time.monotonic() - begun, spent, used.ru_maxrss * 1024, child.returncode, first


def main():
    binary = os.path.realpath(sys.argv[1])
    folder = tempfile.mkdtemp(dir=sys.argv[2] if 2 < len(sys.argv) else None)
    os.chdir(folder)
    beyond = []
    print(f"{'':34}{'':8}{'file':>9}{'s':>8}{'CPU s':>8}{'MB beside':>11}  exit")

    def test(what, scene, pixels=0, is_late=False):
        if not os.path.exists(scene):
            return
        size = os.stat(scene).st_size
        # Cached beforehand, to measure the program and not the disk.
        with open(scene, "rb") as text:
            while text.read(MB):
                pass
        begun = time.monotonic()
        in_child(lambda: open(scene, "rb").read())
        reading = time.monotonic() - begun
        for command in (["check", scene], ["render", scene, "-o", "out.ppm", "--size", "4x3", "--spp", "1"]):
            took, spent, resident, code, first = measured([binary, *command])
            beside = max(0, resident - size - pixels)
            wrong = []
            if code not in (0, 65):
                wrong.append(f"exit {code}")
            if reading + SECONDS < took and not is_late:
                wrong.append(f"{took:.2f} s, {reading:.2f} s of reading")
            if (TIMES_THE_TEXT * size if is_late else BESIDE) < beside:
                wrong.append(f"{beside / 1e6:.0f} MB")
            mark = "!" if wrong else " "
            print(f"{mark} {what:32}{command[0]:8}{size / 1e6:9.1f}{took:8.2f}{spent:8.2f}{beside / 1e6:11.0f}  {code:4}  {first[:70]}", flush=True)
            beyond.extend(f"{command[0]} {scene}: {what}: {', '.join(wrong)}" for _ in wrong[:1])
        os.remove(scene)

    def test_input(what, name, command):
        if not os.path.exists(name):
            return
        size = os.stat(name).st_size
        took, spent, resident, code, first = measured([binary, *command])
        wrong = []
        if code not in (0, 2, 3, 65, 66):
            wrong.append(f"exit {code}")
        if SECONDS < took:
            wrong.append(f"{took:.2f} s")
        if BESIDE < resident:
            wrong.append(f"{resident / 1e6:.0f} MB")
        mark = "!" if wrong else " "
        print(f"{mark} {what:40}{size / 1e6:11.1f}{took:8.2f}{spent:8.2f}{resident / 1e6:11.0f}  {code:4}  {first[:70]}", flush=True)
        beyond.extend(f"{' '.join(command)}: {what}: {', '.join(wrong)}" for _ in wrong[:1])
        os.remove(name)

    try:
        write("ball.ray", HEAD + b"1 " + SPHERE)
        for what, name, command in inputs():
            test_input(what, name, command)
        for what, scene in texts():
            test(what, scene)
        for what, scene, pixels in pictures():
            test(what, scene, pixels)
        for what, scene in late():
            test(what, scene, is_late=True)
    finally:
        shutil.rmtree(folder)
    for line in beyond:
        print(f"exceeded: {line}", file=sys.stderr)
    return 1 if beyond else 0


if __name__ == "__main__":
    sys.exit(main())
