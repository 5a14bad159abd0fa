"""fovead on the emulated board: its settings, its pictures, and what it says."""
import time
from pathlib import Path

from board_shell import BoardShell

WIDTH, HEIGHT = 640, 480
READY, BUSY, VALID, OK, NG, ALARM, TRIGGER = 1, 2, 4, 5, 6, 7, 0  # line 3 has the board's power button

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


class DaemonRig(BoardShell):
    """A board with fovead on it, by its settings and a job."""

    def __init__(self, programs, settings, **options):
        """programs: the folder of what was compiled for the board; settings: those of fovead, without the format."""
        options.setdefault("seconds", 90)
        super().__init__(["sh"], **options)
        here = Path(self.folder.name)
        (here / "jobs").mkdir()
        (here / "jobs/disc.toml").write_text(RECIPE)
        (here / "fovead.toml").write_text("format = 1\n" + settings)
        for name, hole in (("good", True), ("bad", False)):
            pixels = disc(hole)
            (here / f"{name}.gray").write_bytes(pixels)
            (here / f"{name}.pgm").write_bytes(b"P5\n%d %d\n255\n" % (WIDTH, HEIGHT) + pixels)
        files = {"/test": here}
        for name in ("fovead", "show_pictures", "usb_camera", "camera_on_board", "fovead_counted"):
            files[f"/bin/{name}"] = Path(programs) / name
        self.options["files"] = files

    def __enter__(self):
        super().__enter__()
        self.run("mkdir -p /tmp; ln -s /test /etc/fovea")
        return self

    def start(self, options=""):
        """Starts fovead, and waits until it says so."""
        self.tell(f"fovead --config /etc/fovea/fovead.toml {options} < /dev/null 2> /tmp/complaints & daemon=$!")
        return self.event("start")

    def stop(self):
        """Ends it: (its status, the seconds that it took)."""
        begin = time.monotonic()
        status, _ = self.run("kill $daemon; wait $daemon")
        return status, time.monotonic() - begin

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

    def trigger(self):
        """An edge on the trigger's line, and the result that it brings."""
        self.pins.drive(TRIGGER, 1)
        result = self.event("result")
        self.pins.drive(TRIGGER, 0)
        return result
