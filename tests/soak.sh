#!/bin/sh
# Drives the interface on a pseudo-terminal for an hour and measures the resources it uses.
#
#     tests/soak.sh BINARY [MINUTES] [FOLDER]
#
# Keys, edits, undo and redo, orbits, resizes, full-size traces, exports, saves from the interface,
# and saves by other programs: in place, by rename, and by removing and recreating the file. Every
# two seconds resident memory, descriptors and threads are recorded in soak.tsv in FOLDER (default:
# the current one), and at the end plotted to soak.svg. Other files are in a temporary folder.
#
# Fails if resident memory grows by 5 MB an hour or more after the warm-up, a third of the time (a
# line fitted to the medians of each minute); if there are more descriptors or threads at the end
# than after the warm-up; or if the program ends by itself or fails to quit. Needs Linux and python3.
exec python3 - "$@" <<'PYTHON'
import fcntl, os, pty, random, select, shutil, signal, statistics, struct, sys, tempfile, termios, time

MOST_MB_AN_HOUR = 5.0
SAMPLE_EVERY = 2.0
KEY_EVERY = 0.04
SIZES = [(80, 24), (120, 40), (200, 60), (40, 12), (100, 30)]
SCENE = """\
.15 .15 .2 // view: eye 0 0 9 fov 40
2 5 5 5 .7 .7 .7 -4 3 6 .4 .3 .2
4
sphere 0 0 0 1 .8 .2 .2 .2 .2 .2 .8 .8 .8 30 .1 0 1
sphere 2 0 -1 1 .2 .8 .2 .2 .2 .2 .8 .8 .8 30 .3 0 1
sphere -2 0 1 .7 .2 .2 .8 .2 .2 .2 .8 .8 .8 30 .1 0 1
sphere 0 -101 0 100 .5 .5 .5 .2 .2 .2 0 0 0 1 0 0 1
"""


def main(arguments):
    if len(arguments) not in (1, 2, 3):
        sys.exit("usage: tests/soak.sh BINARY [MINUTES] [FOLDER]")
    binary = os.path.abspath(arguments[0])
    minutes = float(arguments[1]) if 1 < len(arguments) else 60.0
    output = os.path.abspath(arguments[2]) if 2 < len(arguments) else os.getcwd()
    os.makedirs(output, exist_ok=True)
    place = tempfile.mkdtemp(prefix="halflight-soak-")
    try:
        with open(os.path.join(output, "soak.tsv"), "w") as table:
            samples, failures = Soak(binary, place, table).run(60 * minutes)
    finally:
        shutil.rmtree(place, ignore_errors=True)
    plot(samples, os.path.join(output, "soak.svg"))
    sys.exit(verdict(samples, failures))


class Soak:
    def __init__(self, binary, place, table):
        self.random = random.Random(1)
        self.place, self.table = place, table
        self.scene = os.path.join(place, "scene.ray")
        self.restore()
        # The allocator can be configured from outside, e.g. with MALLOC_ARENA_MAX=1.
        environment = {name: value for name, value in os.environ.items() if name.startswith("MALLOC_")}
        environment |= {
            "TERM": "xterm-256color",
            "COLORTERM": "truecolor",
            "HOME": place,
            "PATH": os.environ.get("PATH", "/usr/bin:/bin"),
        }
        self.pid, self.terminal = pty.fork()
        if self.pid == 0:
            os.chdir(place)
            os.execve(binary, [binary, "scene.ray"], environment)
        self.resize(*SIZES[0])
        self.samples, self.failures = [], []
        self.ended = False

    def run(self, seconds):
        self.table.write("seconds\trss_kb\tanon_kb\tdescriptors\tthreads\tsteps\n")
        begin = time.monotonic()
        next_sample, steps = begin, 0
        try:
            # A program that starts slowly would take the first keys for answers of the terminal.
            self.rest(1.0)
            while time.monotonic() < begin + seconds and not self.ended:
                self.step()
                steps += 1
                if next_sample <= time.monotonic() and not self.ended:
                    self.sample(time.monotonic() - begin, steps)
                    next_sample += SAMPLE_EVERY
            if self.ended:
                self.failures.append("the program ended by itself")
            else:
                self.quit()
        finally:
            self.kill()
        return self.samples, self.failures

    def step(self):
        self.random.choices(
            [
                self.edit, self.type_value, self.undo, self.look, self.move, self.save,
                self.write_in_place, self.write_by_rename, self.write_after_removing, self.change_size,
                self.trace, self.export, self.pages, self.restore_both,
            ],
            [30, 5, 20, 12, 12, 5, 2, 3, 1, 3, 1, 1, 4, 1],
        )[0]()

    # Actions of the user.

    def edit(self):
        self.keys("\x1b", "\x1b", *("\t" * self.random.randint(1, 3)), "\r")
        nudges = self.random.choice(["l", "h", "L", "H", ",", ".", "\t"])
        self.keys(*(nudges * self.random.randint(1, 12)), "\x1b")

    def type_value(self):
        self.keys("\x1b", "\x1b", "\t", "\r", *"0.%d" % self.random.randint(1, 99), "\r", "\x1b")

    def undo(self):
        count = self.random.randint(1, 20)
        self.keys("\x1b", *("u" * count), *("\x12" * self.random.randint(0, count)))

    def look(self):
        self.keys("\x1b", "\x1b", "v", *self.random.choices("hjklHJKL+-[]f", k=12), "0", "\x1b")

    def move(self):
        self.keys("\x1b", *self.random.choices(["j", "k", "\t", "o", "z", "P"], k=6), "2", "1")

    def save(self):
        self.keys("\x1b", "\x1b", "w")

    def trace(self):
        self.keys("\x1b", "\x1b[15~")
        self.rest(0.5)
        self.keys("x", "\x1b")

    def export(self):
        self.keys("\x1b", *":export! shot.png 160x120 4\r")
        self.rest(0.5)

    def pages(self):
        self.keys("?", *"jjj", "/", *"save", "\r", "\x1b", "\x1b", "!", "\x1b", *":e\r")

    def change_size(self):
        self.resize(*self.random.choice(SIZES))

    # Actions of other programs.

    def restore(self):
        with open(self.scene, "w") as file:
            file.write(SCENE)

    def changed(self):
        """The file's text with one number changed."""
        try:
            with open(self.scene) as file:
                lines = file.read().splitlines()
        except OSError:
            return SCENE
        row = self.random.randrange(len(lines))
        words = lines[row].split(" ")
        for at, word in enumerate(words):
            if word == "30":
                words[at] = "31"
            elif word == "31":
                words[at] = "30"
        lines[row] = " ".join(words)
        return "\n".join(lines) + "\n"

    def write_in_place(self):
        text = self.changed()
        with open(self.scene, "w") as file:
            file.write(text)
        self.decide()

    def write_by_rename(self):
        text = self.changed()
        written = self.scene + ".new"
        with open(written, "w") as file:
            file.write(text)
        os.replace(written, self.scene)
        self.decide()

    def write_after_removing(self):
        text = self.changed()
        try:
            os.unlink(self.scene)
        except FileNotFoundError:
            pass
        self.rest(0.05)
        with open(self.scene, "w") as file:
            file.write(text)
        self.decide()

    def restore_both(self):
        """Restores the original text of the scene, for the interface too."""
        self.restore()
        self.decide()

    def decide(self):
        """Takes the file's version if the interface asks."""
        self.rest(0.4)
        self.keys("T", "\r", "\x1b")

    # The terminal.

    def keys(self, *keys):
        for key in keys:
            if self.ended:
                return
            try:
                os.write(self.terminal, key.encode())
            except OSError:
                self.ended = True
            # An escape counts as a key only if nothing follows it immediately.
            self.rest(KEY_EVERY * (2 if key == "\x1b" else 1))

    def rest(self, seconds):
        deadline = time.monotonic() + seconds
        while not self.ended:
            left = deadline - time.monotonic()
            if left <= 0:
                return
            if select.select([self.terminal], [], [], left)[0]:
                try:
                    self.ended = not os.read(self.terminal, 1 << 16)
                except OSError:
                    self.ended = True

    def resize(self, columns, rows):
        size = struct.pack("HHHH", rows, columns, 0, 0)
        fcntl.ioctl(self.terminal, termios.TIOCSWINSZ, size)
        self.rest(0.1) if hasattr(self, "ended") else None

    def quit(self):
        self.keys("\x1b", "\x1b", *":q!\r")
        deadline = time.monotonic() + 5
        while not self.ended and time.monotonic() < deadline:
            self.rest(0.1)
        if not self.ended:
            self.failures.append("it did not quit within 5 s of :q!")
            return
        pid, status = os.waitpid(self.pid, 0)
        self.pid = None
        if status != 0:
            self.failures.append(f"it ended with status {status}")
        left = sorted(set(os.listdir(self.place)) - {"scene.ray", "shot.png", ".local"})
        if left:
            self.failures.append("files were left behind: " + ", ".join(left))

    def kill(self):
        os.close(self.terminal)
        if self.pid is not None:
            os.kill(self.pid, signal.SIGKILL)
            os.waitpid(self.pid, 0)

    def sample(self, seconds, steps):
        fields = {}
        with open(f"/proc/{self.pid}/status") as status:
            for line in status:
                name, value = line.split(":", 1)
                fields[name] = value.split()[0] if value.split() else ""
        sample = (
            seconds, int(fields["VmRSS"]), int(fields["RssAnon"]),
            len(os.listdir(f"/proc/{self.pid}/fd")), int(fields["Threads"]),
        )
        self.samples.append(sample)
        self.table.write("%.1f\t%d\t%d\t%d\t%d\t%d\n" % (*sample, steps))
        self.table.flush()


def after_warm_up(samples):
    return [sample for sample in samples if samples[-1][0] / 3 <= sample[0]]


def slope(samples):
    """Growth in MB per hour."""
    minutes = {}
    for seconds, rss, *_ in samples:
        minutes.setdefault(int(seconds // 60), []).append(rss / 1024)
    points = [(minute / 60, statistics.median(rss)) for minute, rss in minutes.items()]
    if len(points) < 2:
        return 0.0
    hours = statistics.mean(hour for hour, _ in points)
    level = statistics.mean(rss for _, rss in points)
    spread = sum((hour - hours) ** 2 for hour, _ in points)
    return sum((hour - hours) * (rss - level) for hour, rss in points) / spread


def verdict(samples, failures):
    failures = list(failures)
    if len(samples) < 6:
        print("soak: too short for a verdict", *failures, sep="\n  ")
        return 1
    rest = after_warm_up(samples)
    growth = slope(rest)
    if MOST_MB_AN_HOUR <= growth:
        failures.append(f"it grows by {growth:.1f} MB an hour")
    for at, name in [(3, "descriptors"), (4, "threads")]:
        third = max(1, len(rest) // 3)
        # The minimum over a while: an export or a trace uses more temporarily.
        before, after = (min(sample[at] for sample in part) for part in (rest[:third], rest[-third:]))
        if before < after:
            failures.append(f"{before} {name} after the warm-up, {after} at the end")
    first, last = rest[0], rest[-1]
    print(
        "soak: %.0f min, warm-up %.0f min; resident %.1f MB after it, %.1f MB at the end, "
        "%.1f MB at most: %+.1f MB an hour; %d descriptors, %d threads at the end"
        % (
            last[0] / 60, first[0] / 60, first[1] / 1024, last[1] / 1024,
            max(sample[1] for sample in samples) / 1024, growth, last[3], last[4],
        )
    )
    for failure in failures:
        print("  " + failure)
    print("failed" if failures else "passed")
    return 1 if failures else 0


def plot(samples, path):
    if len(samples) < 2:
        return
    width, height, gap = 900, 160, 40
    rows = [("resident MB", 1, 1024), ("descriptors", 3, 1), ("threads", 4, 1)]
    total = len(rows) * (height + gap) + gap
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width + 120}" height="{total}" '
             'font-family="sans-serif" font-size="12">',
             f'<rect width="100%" height="100%" fill="white"/>']
    time_of_last = samples[-1][0]
    for row, (name, at, unit) in enumerate(rows):
        top = gap + row * (height + gap)
        most = max(sample[at] for sample in samples) / unit * 1.1
        points = " ".join(
            "%.1f,%.1f" % (
                60 + width * sample[0] / time_of_last,
                top + height * (1 - sample[at] / unit / most),
            )
            for sample in samples
        )
        lines += [
            f'<text x="60" y="{top - 8}">{name}</text>',
            f'<path d="M60 {top}V{top + height}H{60 + width}" fill="none" stroke="grey"/>',
            f'<text x="54" y="{top + 10}" text-anchor="end">{most:.0f}</text>',
            f'<text x="54" y="{top + height}" text-anchor="end">0</text>',
            f'<polyline points="{points}" fill="none" stroke="#06c"/>',
        ]
    lines += [f'<text x="{60 + width}" y="{total - 16}" text-anchor="end">'
              f'{time_of_last / 60:.0f} minutes</text>', "</svg>"]
    with open(path, "w") as file:
        file.write("\n".join(lines) + "\n")


main(sys.argv[1:])
PYTHON
