"""A board with Linux, emulated: Debian's arm64 kernel, its real drivers on test devices, and one command.

    with EmulatedBoard(["sh", "-c", "cat /dev/ttyS0"], serial=["socket"]) as board:
        board.serial[0].sendall(b"trigger\\n")
        assert board.stdout.line() == "trigger"
        board.pins.drive(3, 1)          # see pl061.py
        board.machine("query-status")   # commands of QMP
        status = board.wait()           # or board.kill(): a power cut

The words of a command are the board's own: a host's file goes in by files. In the shell of the board the name
of a busybox applet is the applet, whatever PATH says.
"""
import re
import shlex
import shutil
import signal
import socket
import subprocess
import sys
import tarfile
import tempfile
import threading
import time
from pathlib import Path

import board_files
import qemu
import systemd_files
from debian import BoardError, Cache
from kernel import Kernel, plain
from pl061 import Pins
from qmp import Machine

TIMED_OUT, FAILED = 124, 125
LATENCY_S = 0.01  # at which what the board writes is looked for


class Channel:
    """A stream of the board's. QEMU keeps it in a file: nothing is lost when the board goes off at once."""

    def __init__(self, path, board):
        self.path, self.board, self.rest = path, board, b""
        path.touch()
        self.file = path.open("rb")

    def read(self):
        """Bytes that are new; b"" once the board has ended."""
        while True:
            ended = self.board.process.poll() is not None  # asked before reading
            if (data := self.file.read()) or ended:
                return data
            time.sleep(LATENCY_S)

    def line(self):
        """The next line, once it is there; None after the last."""
        while b"\n" not in self.rest:
            if not (data := self.read()):
                break
            self.rest += data
        if not self.rest:
            return None
        line, _, self.rest = self.rest.partition(b"\n")
        return line.decode(errors="replace")

    def lines(self):
        return iter(self.line, None)

    def everything(self):
        return self.path.read_bytes()


class EmulatedBoard:
    """command: its words. Then by name:

    files       {path on the board: file or folder of the host}
    fetch       {path on the board: where wait() puts it on the host}
    packages    Debian's packages, with what they need
    systemd     the first process is Debian's systemd, with udev; the command is a service of it
    modules     of the kernel, each with its options behind a blank
    cameras     how many of vivid; loop: fed by outputs; vivid: further options
    cpus, memory_mb
    steady      its time counts the instructions of its one processor, 250 to the microsecond: what shares the host
                with it makes it no slower by its own clock
    serial      far ends of /dev/ttyS0..: "socket" is connected in board.serial[0], "pty" has its path there,
                "unix:PATH" listens
    usb_serial  the same of /dev/ttyUSB0.., with unplug_usb_serial(0) and plug_usb_serial(0)
    ports       {TCP port of the board: port of 127.0.0.1}
    disks       images /dev/vda..
    stdin       as subprocess.Popen takes it, such as PIPE; the board.process.stdin is then the command's
    resume      file of save_state(): goes on where another board with the same files and options was, on
                disks of its own; what a file system had mounted is not looked at again
    seconds     until it is stopped, from its start
    """

    def __init__(self, command, *, files=None, fetch=None, packages=(), systemd=False, modules=(), cameras=0,
                 loop=False, vivid="", cpus=1, steady=False, memory_mb=512, serial=(), usb_serial=(), ports=None, disks=(),
                 stdin=None, resume=None, seconds=60):
        self.command, self.systemd = list(command), systemd
        self.layers = package_layers(packages, systemd)
        self.files, self.fetch = files or {}, fetch or {}
        self.cpus, self.steady, self.memory_mb, self.seconds, self.stdin = cpus, steady, memory_mb, seconds, stdin
        self.serial_ends, self.usb_serial_ends = list(serial), list(usb_serial)
        self.ports, self.disks, self.resume = ports or {}, list(disks), resume
        needed = ["virtio_pci", "virtio_console"]
        needed += ["virtio_blk"] if self.disks else []
        needed += ["virtio_net"] if self.ports else []
        needed += ["xhci_pci", "ftdi_sio"] if self.usb_serial_ends else []
        asked = [module.partition(" ") for module in modules]
        self.modules = {**dict.fromkeys(needed, ""), **{plain(name): options for name, _, options in asked}}
        if cameras:
            self.modules["vivid"] = f"{qemu.vivid_options(cameras, loop)} {vivid}"
        self.process = self.folder = None
        self.timed_out, self.sockets = False, []
        self.trouble = ""  # why there is no status of the command's
        self.machine_connection = self.pins_connection = None

    # ---- From start to end ----------------------------------------------------------------

    def __enter__(self):
        exit_on_signals()
        self.folder = Path(tempfile.mkdtemp(prefix="board-"))
        try:
            self.start()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        if self.process:
            self.timer.cancel()
            self.process.kill()
            self.process.wait()
            for stream in (self.process.stdin, *self.sockets):
                if stream:
                    stream.close()
        shutil.rmtree(self.folder)

    def start(self):
        cache = Cache()
        with cache.locked():
            kernel = Kernel(cache)
            modules = kernel.in_order(self.modules)
            layers = [board_files.package_layer(cache, names) for names in self.layers]
            with (self.folder / "initrd").open("wb") as initrd:
                for layer in layers:
                    initrd.write(layer.read_bytes())
                initrd.write(board_files.own_layer(self, cache, modules))
        # QEMU dies with the thread that started it, whatever ends that.
        command = ["setpriv", "--pdeathsig", "KILL", *qemu.command(self, kernel.image)]
        with (self.folder / "qemu").open("wb") as log:
            self.process = subprocess.Popen(command, stdout=log, stderr=log,
                                            stdin=subprocess.DEVNULL if self.stdin is None else self.stdin)
        self.timer = threading.Timer(self.seconds, self.time_out)
        self.timer.daemon = True
        self.timer.start()
        self.stdout, self.stderr = (Channel(self.folder / name, self) for name in ("stdout", "stderr"))
        self.serial = [self.far_end(f"serial{n}", end) for n, end in enumerate(self.serial_ends)]
        self.usb_serial = [self.far_end(f"usb_serial{n}", end) for n, end in enumerate(self.usb_serial_ends)]
        if self.resume:
            self.await_answer("query-status", "inmigrate", "paused")
            self.machine("cont")

    def time_out(self):
        self.timed_out = True
        self.process.kill()

    def kill(self):
        """Cuts the power."""
        self.process.kill()
        self.process.wait()

    def save_state(self, path):
        """What the board has in its memory, for others to resume from; this one stands still from then on."""
        self.machine("stop")
        self.machine("migrate", uri=f"exec:cat > {shlex.quote(str(path))}")
        self.await_answer("query-migrate", "active", "completed")

    def await_answer(self, question, before, after):
        while (status := self.machine(question).get("status", before)) != after:
            if status not in (before, "setup", "device"):
                raise BoardError(f"the state of a board: {status}")
            time.sleep(LATENCY_S)

    def wait(self):
        """The command's status, 128 + N for signal N; 124 if time ran out, 125 if none: see trouble."""
        self.process.wait()
        self.timer.cancel()
        status = re.search(r"status (\d+)\n", self.text("status"))
        if status is None:
            self.trouble = self.what_went_wrong()
            return TIMED_OUT if self.timed_out else FAILED
        missing = self.take_fetched()
        self.trouble = "".join(f"the board has no {name}\n" for name in missing)
        return FAILED if missing and status[1] == "0" else int(status[1])

    def what_went_wrong(self):
        console = self.text("console")
        told = [f"no end after {self.seconds} s" if self.timed_out else "the board ended without a status"]
        told += re.findall(r"Kernel panic.*|board: .*", console)[:1]
        told += ["QEMU said:", self.text("qemu")] if self.text("qemu") else []
        return "\n".join([*told, "the end of its console:", *console.splitlines()[-25:]]) + "\n"

    def text(self, name):
        path = self.folder / name
        return path.read_bytes().decode(errors="replace").replace("\r", "") if path.exists() else ""

    def take_fetched(self):
        """Puts what was fetched in its place; answers what is missing."""
        missing = []
        for name, path in self.fetch.items():
            inside, path = name.strip("/"), Path(path)
            try:
                with tarfile.open(self.folder / "fetched") as archive:
                    members = [m for m in archive if m.name == inside or m.name.startswith(f"{inside}/")]
                    for member in members:
                        target = path / member.name[len(inside) + 1:]
                        if member.isdir():
                            target.mkdir(parents=True, exist_ok=True)
                        elif member.isfile():
                            target.parent.mkdir(parents=True, exist_ok=True)
                            target.write_bytes(archive.extractfile(member).read())
            except tarfile.ReadError:
                members = []
            missing += [] if members else [name]
        return missing

    # ---- Its surroundings ------------------------------------------------------------------

    def channels(self):
        return ["stdout", "stderr", "status", "fetched"] + ([] if self.stdin is None else ["stdin"])

    def far_end(self, name, end):
        if end == "socket":  # before the board is up: what it wrote until then would be lost
            return self.connect(name)
        if end == "pty":
            known = {device["label"]: device["filename"] for device in self.machine("query-chardev")}
            return known[name][len("pty:"):]
        return end[len("unix:"):]

    def connect(self, name):
        connection = socket.socket(socket.AF_UNIX)
        self.sockets.append(connection)
        while True:
            try:
                connection.connect(str(self.folder / name))
                return connection
            except OSError:
                if self.process.poll() is not None:
                    raise BoardError(f"QEMU has ended: {self.text('qemu')}") from None
                time.sleep(LATENCY_S)

    @property
    def machine(self):
        if self.machine_connection is None:
            self.machine_connection = Machine(self.connect("qmp"))
        return self.machine_connection

    @property
    def pins(self):
        if self.pins_connection is None:
            self.pins_connection = Pins(self.connect("qtest"), self.machine)
        return self.pins_connection

    def unplug_usb_serial(self, number):
        self.machine("device_del", id=f"usb_serial{number}")

    def plug_usb_serial(self, number):
        """Plugs it in again, with its far end as before, which QEMU may take a moment to let go."""
        name, end = f"usb_serial{number}", time.monotonic() + 5
        device = {"driver": "usb-serial", "bus": "usb.0", "id": name, "chardev": name, "always_plugged": True}
        while True:
            try:
                return self.machine("device_add", **device)
            except OSError as error:
                if "in use" not in str(error) or time.monotonic() > end:
                    raise
                time.sleep(LATENCY_S)


def package_layers(packages, systemd):
    """Those of one layer share what they need."""
    return [[*systemd_files.PACKAGES, *packages]] if systemd else [[name] for name in packages]


def exit_on_signals():
    """So that what is left open is closed: by default Python just dies."""
    if threading.current_thread() is threading.main_thread():
        for number in (signal.SIGTERM, signal.SIGHUP):
            if signal.getsignal(number) == signal.SIG_DFL:
                signal.signal(number, lambda number, _: sys.exit(128 + number))
