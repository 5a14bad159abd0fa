"""fovead on the emulated board: its settings, its pictures, and what it says."""
import json
import re
import time
from pathlib import Path

import mjpeg
from invariants import ALARM, BUSY, NG, OK, READY, VALID
from watched import WatchedBoard

WIDTH, HEIGHT = 640, 480
TRIGGER = 0  # line 3 has the board's power button

RECIPE = """format = 1
name = "disc"
[locate]
part = "dark"
threshold = "fixed"
level = 128
orientation = "none"
area_min = 1000
hole_area_min = 100
[[feature]]
name = "holes"
kind = "hole_count"
nominal = 1
minus = 0
plus = 0
[[feature]]
name = "d1"
kind = "diameter"
centre = [0, 0]
radius = 80
search = 10
nominal = 160
minus = 1.5
plus = 1.5
"""

# What vivid shows by itself has parts, and no holes are counted.
PATTERN_RECIPE = """format = 1
name = "pattern"
[locate]
part = "dark"
threshold = "fixed"
level = 128
orientation = "none"
area_min = 1000
hole_area_min = 1000
[[feature]]
name = "holes"
kind = "hole_count"
nominal = 0
minus = 0
plus = 1000
"""

# Reads codes in place of measuring.
CODE_JOB = """format = 1
name = "label"
[codes]
symbologies = ["retail"]
patterns = ["978*"]
"""
CODES = {"code": "9780905705712", "other_code": "4006381333931"}

LINES = f"""[lines]
chip = "pl061"
ready = "{READY}"
busy = "{BUSY}"
valid = "{VALID}"
ok = "{OK}"
ng = "{NG}"
alarm = "{ALARM}"
"""
BY_LINE = f'[trigger]\nsource = "line"\nline = "{TRIGGER}"\n'
BY_COMMAND = '[trigger]\nsource = "command"\n'
VIVID = f'[camera]\ndevice = "/dev/video0"\nwidth = {WIDTH}\nheight = {HEIGHT}\npixel_format = "gray8"\n'
USB = f'[camera]\ndevice = "usb:1209:0001"\nwidth = {WIDTH}\nheight = {HEIGHT}\npixel_format = "gray8"\n'
SERIAL = '[serial]\ndevice = "/dev/ttyS0"\nresults = "{seq};{verdict};{f.d1}\\\\r\\\\n"\n'


def disc(hole):
    """The pixels of a dark disc on bright ground."""
    pixels = bytearray([220]) * (WIDTH * HEIGHT)
    for y in range(HEIGHT // 2 - 80, HEIGHT // 2 + 81):
        for x in range(WIDTH // 2 - 80, WIDTH // 2 + 81):
            square = (x - WIDTH // 2) ** 2 + (y - HEIGHT // 2) ** 2
            if square <= 6400 and not (hole and square <= 400):
                pixels[y * WIDTH + x] = 30
    return bytes(pixels)


def ean_13(digits):
    """The pixels of an EAN-13 on bright ground, modules of 4 px. ISO/IEC 15420."""
    odd = "0001101 0011001 0010011 0111101 0100011 0110001 0101111 0111011 0110111 0001011".split()
    right = [digit.translate({48: 49, 49: 48}) for digit in odd]
    even = [digit[::-1] for digit in right]
    parity = "000000 001011 001101 001110 010011 011001 011100 010101 010110 011010".split()[int(digits[0])]
    left = "".join((odd, even)[int(bit)][int(digit)] for digit, bit in zip(digits[1:7], parity))
    modules = "101" + left + "01010" + "".join(right[int(digit)] for digit in digits[7:]) + "101"
    row = bytearray([220]) * WIDTH
    for place, module in enumerate(modules):
        if module == "1":
            row[130 + 4 * place:134 + 4 * place] = bytes([30]) * 4
    blank = bytes([220]) * WIDTH * (HEIGHT // 4)
    return blank + bytes(row) * (HEIGHT // 2) + blank


class DaemonRig(WatchedBoard):
    """A board with fovead on it, by its settings and a job."""

    def __init__(self, programs, settings, recipe=RECIPE, **options):
        """programs: the folder of what was compiled for the board; settings: those of fovead, without the format."""
        options.setdefault("seconds", 90)
        super().__init__(["sh"], process="$daemon", **options)
        here = Path(self.folder.name)
        (here / "jobs").mkdir()
        (here / "jobs/disc.toml").write_text(recipe)
        (here / "fovead.toml").write_text("format = 1\n" + settings)
        for name, hole in (("good", True), ("bad", False)):
            pixels = disc(hole)
            (here / f"{name}.gray").write_bytes(pixels)
            (here / f"{name}.jpg").write_bytes(mjpeg.encode(pixels, WIDTH, HEIGHT))
            (here / f"{name}.pgm").write_bytes(b"P5\n%d %d\n255\n" % (WIDTH, HEIGHT) + pixels)
        for name, digits in CODES.items():
            (here / f"{name}.pgm").write_bytes(b"P5\n%d %d\n255\n" % (WIDTH, HEIGHT) + ean_13(digits))
        files = {"/test": here}
        for name in ("fovead", "show_pictures", "usb_camera", "camera_on_board", "fovead_counted", "fovead_slow",
                     "count_calls"):
            files[f"/bin/{name}"] = Path(programs) / name
        self.options["files"] = files
        self.unheard = b""
        self.record.stamped_at_end = "usb:" not in settings

    def __enter__(self):
        super().__enter__()
        self.run("mkdir -p /tmp; ln -s /test /etc/fovea")
        return self

    def start(self, program="fovead", before=""):
        """Starts fovead, and waits until it says so."""
        self.tell(f"({before} exec {program} --config /etc/fovea/fovead.toml < /dev/null 2> /tmp/complaints) & daemon=$!")
        return self.event("start")

    def cut_power(self):
        """In the middle of what it does; a board with the same disks is up then. Without power all lines are low."""
        self.board.kill()
        for line in (self.board.stdout.rest + self.board.stdout.read()).decode().split("\n")[:-1]:
            if line.startswith("{"):
                self.record.said.append(json.loads(line))
        history = self.pins.whole_history()
        self.record.pins += history + [(line, 0) for line in (VALID, OK, NG, ALARM, BUSY, READY) if dict(history).get(line)]
        self.board.__exit__()
        self.events, self.unheard = [], b""
        self.__dict__.pop("pictures", None)
        self.__enter__()

    def stop(self):
        """Ends it: (its status, the seconds that it took)."""
        self.count_calls_after()
        if self.record.held:
            self.hold()
        begin = time.monotonic()
        status, _ = self.run("kill $daemon; wait $daemon")
        return status, time.monotonic() - begin

    def event(self, *kinds):
        event = super().event(*kinds)
        if event["ev"] == "result" and not self.record.held:
            self.hold()
        return event

    def heard(self, count, seconds=5):
        """So many lines of the serial port's other end; each is whole."""
        line, end = (self.board.serial or self.board.usb_serial)[0], time.monotonic() + seconds
        line.settimeout(0.2)
        while self.unheard.count(b"\n") < count and time.monotonic() < end:
            try:
                self.unheard += line.recv(65536)
            except TimeoutError:
                pass
        *lines, self.unheard = self.unheard.split(b"\r\n")
        lines = [each.decode("ascii") for each in lines]
        for text in lines:
            if re.fullmatch(r"\d+;(OK|NG|ERROR);[-0-9.?]*", text):
                self.record.records.append(text)
            elif not re.fullmatch(r"(#\w+ )?(OK( .*)?|ERR \d+ .*)", text):
                raise AssertionError(f"a line that is none on the serial port: {text!r}")
        return lines

    def statistics(self):
        """The answer to STAT?, when no trigger waits."""
        (self.board.serial or self.board.usb_serial)[0].sendall(b"#9 stat?\r\n")
        end = time.monotonic() + 5
        while time.monotonic() < end:
            for text in self.heard(1, 1):
                if text.startswith("#9 OK"):
                    self.run("true")  # what was said before it has come
                    self.record.asked.append((text, len(self.record.said)))
                    return text
        raise AssertionError("no answer to STAT?")

    def show(self, name):
        """Lets the camera of vivid see a picture."""
        if "pictures" not in self.__dict__:
            self.pictures = True
            self.run("mkfifo /tmp/pictures")
            self.tell(f"show_pictures /dev/video0 /dev/video1 {WIDTH}x{HEIGHT} < /tmp/pictures &\nexec 3> /tmp/pictures")
            while self.line() != "shown":
                pass
        self.tell(f"echo /test/{name}.pgm >&3")
        while self.line() != f"shown /test/{name}.pgm":
            pass

    def edge(self):
        """On the trigger's line; its end is no trigger."""
        self.record.edges = (self.record.edges or 0) + 1
        self.pins.drive(TRIGGER, 1)

    def trigger(self):
        """An edge on the trigger's line, and the result that it brings."""
        self.edge()
        result = self.event("result")
        self.pins.drive(TRIGGER, 0)
        return result

    def latencies(self, where, count):
        """Of so many triggers, from the edge to the answer, in microseconds."""
        for _ in range(count):
            result = self.trigger()
            self.record.latencies.setdefault(where, []).append(result["us"]["answer"])
            self.pins.wait_for(READY, 1)
        return sorted(self.record.latencies[where])
