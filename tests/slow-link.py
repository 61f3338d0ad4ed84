"""The measurements of slow-link.sh: a proxy with a rate and a delay, and a user behind it."""

import asyncio, contextlib, fcntl, os, pty, re, signal, socket, struct, sys, termios, time

PLACE, PORT, HALFLIGHT = (os.environ[name] for name in ("PLACE", "PORT", "HALFLIGHT"))
COLUMNS, ROWS = 120, 40
# Bytes per second and the round trip in milliseconds; 0 means no limit.
LINKS = [(0, 0), (1_000_000, 20), (128_000, 200), (40_000, 200), (40_000, 50)]
# Keys pressed while the picture rests, and while pictures flow.
RESTING, FLOWING = 25, 60


class Proxy:
    """Forwards bytes at a limited rate, with a delay, through a bounded buffer."""

    def __init__(self, rate, round_trip):
        self.rate, self.delay = rate, round_trip / 2000

    async def serve(self, reader, writer):
        far_reader, far_writer = await asyncio.open_connection("127.0.0.1", int(PORT))
        for end in (writer, far_writer):
            end.get_extra_info("socket").setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        await asyncio.gather(self.pump(reader, far_writer), self.pump(far_reader, writer))

    async def pump(self, reader, writer):
        line = asyncio.Queue(maxsize=256)

        async def deliver():
            while (item := await line.get()) is not None:
                at, data = item
                await asyncio.sleep(max(0, at - time.monotonic()))
                writer.write(data)
                # The other end may have closed the connection.
                with contextlib.suppress(ConnectionError):
                    await writer.drain()
            writer.close()

        delivery = asyncio.create_task(deliver())
        free = time.monotonic()
        try:
            while data := await reader.read(1024):
                if self.rate:
                    free = max(free, time.monotonic()) + len(data) / self.rate
                    await line.put((free + self.delay, data))
                    # The link is busy until then; further bytes wait in the sockets' buffers.
                    await asyncio.sleep(max(0, free - time.monotonic()))
                else:
                    await line.put((time.monotonic() + self.delay, data))
        except ConnectionError:
            pass
        await line.put(None)
        await delivery


class Screen:
    """A minimal terminal that tracks the cells' colours: moves, clears, colours, characters."""

    def __init__(self):
        # The cells of the selection in the last complete frame.
        self.selection = frozenset()
        self.cells, self.x, self.y = {}, 0, 0
        self.style = [None, None, False]
        self.rest = b""

    TOKEN = re.compile(
        rb"\x1b\[([?0-9;:]*)([@-~])|\x1bP[^\x1b]*\x1b\\|\x1b[^\[P]|[\r\n\x08]|[\x20-\x7e]"
        rb"|[\xc2-\xdf][\x80-\xbf]|[\xe0-\xef][\x80-\xbf]{2}|[\xf0-\xf4][\x80-\xbf]{3}"
    )

    def feed(self, data):
        """Processes bytes; returns the number of status requests."""
        data, at, asked = self.rest + data, 0, 0
        while match := self.TOKEN.match(data, at):
            at = match.end()
            if match[2]:
                asked += self.command(match[1], match[2])
            elif match[0] == b"\r":
                self.x = 0
            elif match[0] == b"\n":
                self.y += 1
            elif match[0][:1] != b"\x1b":
                self.cells[self.x, self.y] = (match[0].decode(), *self.style)
                self.x = min(self.x + 1, COLUMNS - 1)
        self.rest = data[at:]
        return asked

    def command(self, parameters, end):
        # The end of synchronized output: a terminal shows the frame now.
        if parameters == b"?2026" and end == b"l":
            self.selection = frozenset(
                at for at, cell in self.cells.items() if cell[0] == "▸" or (cell[3] and at[0] > 70)
            )
        # Other private modes, and a colour set only to query whether it is supported.
        if parameters.startswith(b"?") or b":" in parameters:
            return 0
        numbers = [int(part or 0) for part in parameters.split(b";")]
        first = numbers[0]
        if end == b"H":
            self.y, self.x = max(first, 1) - 1, max((numbers + [1])[1], 1) - 1
        elif end == b"G":
            self.x = max(first, 1) - 1
        elif end == b"C":
            self.x = min(self.x + max(first, 1), COLUMNS - 1)
        elif end == b"J":
            self.cells.clear()
        elif end == b"m":
            self.paint(numbers)
        return int(end == b"n" and first == 5)

    def paint(self, numbers):
        rest = iter(numbers)
        for number in rest:
            if number == 0:
                self.style = [None, None, False]
            elif number in (7, 27):
                self.style[2] = number == 7
            elif number in (38, 48):
                length = 1 if next(rest) == 5 else 3
                self.style[number == 48] = tuple(next(rest) for _ in range(length))
            elif number in (39, 49):
                self.style[number == 49] = None
            elif 30 <= number < 38 or 40 <= number < 48:
                self.style[40 <= number] = (number % 10,)
            elif 90 <= number < 98 or 100 <= number < 108:
                self.style[100 <= number] = (number % 10 + 8,)

    def picture(self):
        """The colours of both halves of each cell of the picture."""
        halves = {}
        for at, (character, fg, bg, reverse) in self.cells.items():
            if reverse:
                fg, bg = bg, fg
            both = {"▀": (fg, bg), "▄": (bg, fg), "█": (fg, fg), " ": (bg, bg)}
            if character in both and (character != " " or bg):
                halves[at] = both[character]
        return halves


class Session:
    """Halflight at the other end of a link."""

    def __init__(self, port):
        command = (
            f"cd {PLACE} && TERM=xterm-256color exec {HALFLIGHT} default.ray"
        )
        self.child, self.line = pty.fork()
        if self.child == 0:
            environment = {
                name: os.environ[name] for name in ("PATH", "HOME") if name in os.environ
            }
            environment["TERM"] = "xterm-256color"
            options = ["StrictHostKeyChecking=no", "UserKnownHostsFile=/dev/null", "LogLevel=ERROR"]
            arguments = ["ssh", "-tt", "-F", "none", "-i", f"{PLACE}/key", "-p", str(port)]
            for option in options:
                arguments += ["-o", option]
            time.sleep(0.2)
            os.execvpe("ssh", [*arguments, "127.0.0.1", command], environment)
        fcntl.ioctl(self.line, termios.TIOCSWINSZ, struct.pack("HHHH", ROWS, COLUMNS, 0, 0))
        os.set_blocking(self.line, False)
        self.screen = Screen()
        self.arrived, self.last, self.questions = 0, time.monotonic(), 0
        self.arrival = asyncio.Event()
        self.new = b""
        asyncio.get_running_loop().add_reader(self.line, self.read)

    def read(self):
        try:
            data = os.read(self.line, 1 << 16)
        except BlockingIOError:
            return
        except OSError:
            data = b""
        if not data:
            asyncio.get_running_loop().remove_reader(self.line)
            self.arrival.set()
            return
        asked = self.screen.feed(data)
        os.write(self.line, b"\x1b[0n" * asked)
        self.questions += asked
        self.arrived += len(data)
        self.new += data
        self.last = time.monotonic()
        self.arrival.set()

    async def until(self, holds, patience=30):
        """Waits for a condition; returns when the bytes arrived that made it true."""
        end = time.monotonic() + patience
        while not holds():
            self.arrival.clear()
            left = end - time.monotonic()
            if left <= 0:
                return None
            try:
                await asyncio.wait_for(self.arrival.wait(), left)
            except asyncio.TimeoutError:
                return None
        return self.last

    async def rest(self, quiet=1.5):
        """Waits until nothing arrives for a while."""
        while time.monotonic() - self.last < quiet:
            await asyncio.sleep(0.05)

    async def key(self, keys):
        """Sends keys; returns the time until a complete frame in which the selection has moved."""
        before, sent = self.screen.selection, time.monotonic()
        os.write(self.line, keys)
        arrival = await self.until(lambda: self.screen.selection not in (before, frozenset()))
        return (arrival or sent + 30) - sent


def spread(times):
    times = sorted(times)
    part = lambda share: times[min(len(times) - 1, int(len(times) * share))] * 1000
    return f"{part(0.5):6.0f} {part(0.95):6.0f} {times[-1] * 1000:6.0f}"


async def measure(rate, round_trip):
    proxy = Proxy(rate, round_trip)
    server = await asyncio.start_server(proxy.serve, "127.0.0.1", 0, limit=4096)
    session = Session(server.sockets[0].getsockname()[1])
    begun = await session.until(lambda: b"\x1b[?1049h" in session.new, 60)
    assert begun, session.new
    first = await session.until(lambda: len(session.screen.picture()) > 400, 60)
    await session.rest()
    resting, costs = [], []
    for turn in range(RESTING):
        key = b"j" if turn // 6 % 2 == 0 else b"k"
        before = session.arrived
        resting.append(await session.key(key))
        await asyncio.sleep(0.3)
        costs.append(session.arrived - before)
    await session.rest()
    flowing, pictures, began = [], 0, time.monotonic()
    before = session.arrived
    for turn in range(FLOWING):
        # Switch between depth and light: each time a complete picture is sent.
        os.write(session.line, b"21"[turn % 2 : turn % 2 + 1])
        await asyncio.sleep(0.15 + 0.017 * (turn % 13))
        flowing.append(await session.key(b"j" if turn // 6 % 2 == 0 else b"k"))
    throughput = (session.arrived - before) / (time.monotonic() - began)
    nudged = time.monotonic()
    await session.rest(2.5)
    settled = session.last - nudged
    result = session.screen.picture()
    # Redrawn completely.
    session.screen = Screen()
    os.write(session.line, b"\x0c")
    session.last = time.monotonic()
    await session.rest(2.5)
    exact = result == session.screen.picture()
    os.write(session.line, b"q")
    await session.until(lambda: b"\x1b[?1049l" in session.new)
    os.kill(session.child, signal.SIGTERM)
    os.waitpid(session.child, 0)
    server.close()
    costs.sort()
    name = f"{rate // 1000} KB/s {round_trip} ms" if rate else "no limit"
    print(
        f"{name:16} | {spread(resting)} | {spread(flowing)} | {costs[len(costs) // 2]:5} {costs[-1]:6}"
        f" | {throughput / 1000:6.0f} | {first - begun:6.2f} {settled:6.2f} | {session.questions:3}"
        f" | {'exact' if exact else 'DIFFERS'} ({len(result)} cells)",
        flush=True,
    )


def fail(loop, context):
    """Ends the measurement on an error in a callback, except when a proxy is cancelled."""
    if isinstance(context.get("exception"), asyncio.CancelledError):
        return
    print(context["message"], repr(context.get("exception")), flush=True)
    os._exit(1)


async def main():
    asyncio.get_running_loop().set_exception_handler(fail)
    print("                 |  j at rest, ms       |  j, pictures flow    |  bytes per j |  KB/s  | picture, s    | queries")
    print("link             |    p50    p95    max |    p50    p95    max |   p50    max | flowing| first settled |")
    wanted = sys.argv[1:]
    for rate, round_trip in LINKS:
        if not wanted or str(rate) in wanted:
            await measure(rate, round_trip)


asyncio.run(main())
