#!/usr/bin/env python3
"""Proves the Linux ports on the kernel's real drivers: ports_test.py PROGRAMS [--figures FILE] [WORD...]

PROGRAMS is a folder with the programs *_on_board and usb_camera, compiled for the board. Each case boots a board
that runs some of them, and wants every check to hold. What they measured goes to FILE, sorted, a figure a line:
times are right where each board has a processor to itself. With WORDS only cases whose names hold one.
"""
import argparse
import re
import subprocess
import sys
import time
from pathlib import Path

import proof_lines
from cases import case, run_cases, same
from emulated_board import EmulatedBoard

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("programs", type=Path)
parser.add_argument("--figures", type=Path)
parser.add_argument("--at-once", type=int, default=2, metavar="BOARDS")
parser.add_argument("--peers", action="store_true", help="ustreamer in the same boot, too: its log is read")
parser.add_argument("words", nargs="*")
options = parser.parse_intermixed_args()
figures = {}


def program(name):
    return {f"/test/{name}": options.programs / name}


def take(board, prefix=""):
    """The board's end, the figures of what ran on it, and all that it said."""
    status = board.wait()
    said, complaints = (stream.everything().decode(errors="replace") for stream in (board.stdout, board.stderr))
    try:
        if board.trouble:
            raise AssertionError(board.trouble)
        found = proof_lines.figures(status, said, prefix)
    except AssertionError as error:
        raise AssertionError(f"{error}\n{complaints}") from None
    note(found)
    return said


def note(found):
    for name, value in found.items():
        if figures.setdefault(name, value) is not value:
            raise AssertionError(f"another case has the figure {name}")


def prove(command, files, prefix="", **board_options):
    with EmulatedBoard(command, files=files, seconds=120, **board_options) as board:
        return take(board, prefix)


@case
def faults_of_a_webcam():
    prove(["/test/camera_on_board", "faults"], program("camera_on_board"), cameras=1)


@case
def the_camera_port_on_a_webcam():
    prove(["/test/camera_on_board", "negotiation", "sweep", "latest"], program("camera_on_board"), cameras=1)


@case
def the_camera_port_on_an_input_for_video_signals():
    prove(["sh", "-c", "/test/camera_on_board signal && /test/pictures_on_board"],
          {**program("camera_on_board"), **program("pictures_on_board")}, cameras=1, loop=True)


@case
def pictures_through_a_multi_planar_driver():
    prove(["/test/pictures_on_board"], program("pictures_on_board"), "multi-planar, ", cameras=1, loop=True,
          vivid="multiplanar=2")


@case
def the_camera_port_on_usb_cameras():
    prove(["/test/usb_camera_on_board", "/test/usb_camera", "modes", "identity", "controls", "damaged",
           "unplugging"], {**program("usb_camera_on_board"), **program("usb_camera")},
          modules=["vhci-hcd", "uvcvideo"])


def answer(board, name, act):
    """Waits until the program is ready for that, does it, and says so."""
    while (line := board.stdout.line()) != f"ready {name}":
        if line is None:
            return
    act()
    board.process.stdin.write(b"done\n")
    board.process.stdin.flush()


def toggle(pins, line, count, apart_s, level=1):
    for _ in range(count):
        pins.drive(line, level)
        level = 1 - level
        time.sleep(apart_s)


def ping(pins, level):
    pins.drive(2, level)
    if not pins.wait_for(5, level):
        raise AssertionError("an edge was not answered")


@case
def lines_of_a_gpio_chip():
    parts = ["busy", "names", "sweep", "outputs", "inputs", "burst", "levels", "debounce"]
    with EmulatedBoard(["/test/lines_on_board", *parts], files=program("lines_on_board"),
                       modules=["gpio-keys", "gpio-sim"], stdin=subprocess.PIPE) as board:
        seen = []
        # Only from here on, for QEMU waits for who does not read what its pins do.
        answer(board, "outputs", lambda: board.pins.changes())
        answer(board, "outputs were set", lambda: seen.extend(board.pins.changes()))
        answer(board, "inputs", lambda: [ping(board.pins, level) for level in 100 * [1, 0]])
        answer(board, "burst", lambda: toggle(board.pins, 2, 100, 0.005))
        answer(board, "levels", lambda: toggle(board.pins, 4, 4, 0.02))
        answer(board, "debounce", lambda: toggle(board.pins, 7, 7, 0.001))
        take(board)
    # One is low, and then active; the other is high until it is.
    same(seen, [(6, 1), (5, 1), (5, 0), (5, 1), (6, 0), (6, 1), (5, 0)])


def record(number):
    return f"record {number:06d} " + number * 37 % 90 * chr(ord("a") + number % 26)


def read_records(line, last):
    """Their numbers up to the last, each of which must be whole; what comes before the first is another part's."""
    line.settimeout(20)
    text = ""
    while record(last) + "\n" not in text:
        text += line.recv(65536).decode()
    numbers = []
    for entry in text[text.index("record "):].splitlines():
        numbers.append(int(entry.split(" ")[1]))
        same(entry, record(numbers[-1]))
    return numbers


def exchange(board, line):
    """The part "records"."""
    def act():
        same(read_records(line, 99), list(range(100)))
        line.sendall(bytes(range(256)))
    answer(board, "records", act)


@case
def a_serial_port_whose_reader_stops():
    parts = ["/dev/ttyS0", "sweep", "owner", "records", "blocked"]
    with EmulatedBoard(["/test/serial_on_board", *parts], files=program("serial_on_board"), serial=["socket"],
                       stdin=subprocess.PIPE) as board:
        exchange(board, board.serial[0])
        numbers = []
        answer(board, "blocked", lambda: numbers.extend(read_records(board.serial[0], 999)))
        said = take(board)
    dropped = int(re.search(r"^dropped (\d+) of 1000$", said, re.M)[1])
    same((numbers, len(numbers) + dropped), (sorted(set(numbers)), 1000))
    note({"F14: records of 1000 dropped while nobody reads": str(dropped)})


@case
def a_usb_serial_adapter_that_is_pulled():
    parts = ["usb:0403:6001", "sweep", "owner", "records", "unplugging"]
    with EmulatedBoard(["/test/serial_on_board", *parts], files=program("serial_on_board"), usb_serial=["socket"],
                       stdin=subprocess.PIPE) as board:
        line = board.usb_serial[0]
        exchange(board, line)
        for cycle in range(10):
            def pull():
                if cycle > 0:
                    same(read_records(line, cycle - 1), [cycle - 1])
                board.unplug_usb_serial(0)
            answer(board, "to be pulled", pull)
            answer(board, "to be plugged in", lambda: board.plug_usb_serial(0))
        answer(board, "records of 10 cycles", lambda: same(read_records(line, 9), [9]))
        take(board)


PRESSES = 8
BESIDE_A_PEER = f"""
ustreamer -d /dev/video0 -m YUYV -r 320x180 -f 30 --host 127.0.0.1 --perf --no-log-colors > /log 2>&1 &
until grep -q 'Encoded frame' /log; do sleep 0.1; done
for button in Disconnect "Inject Fatal Streaming Error"; do
  for time in $(seq {PRESSES}); do
    /test/camera_on_board press "$button"
    sleep 0.7
    grep -E 'ERROR|A new second has come; captured_fps=0' /log
    : > /log
  done
done
kill $!
wait $!
exec /test/camera_on_board recovery
"""


def recovery_beside_that_of_ustreamer():
    """From its first complaint to its first frame, by its own log; ours from the status to the frame."""
    said = prove(["sh", "-c", BESIDE_A_PEER], program("camera_on_board"), "beside ustreamer: ", cameras=1,
                 packages=["ustreamer"])
    for button, what in (("Disconnect", "a plug pulled"), ("Inject Fatal Streaming Error", "a broken stream")):
        losses, presses = [], []  # in milliseconds
        for part in said.split(f"ok {button}\n")[1:]:
            part = part.split("\nok ")[0]
            same([word for word in ("ERROR", "PERF") if f"{word} " not in part], [])
            pressed = int(re.search(r"pressed at (\d+) us", part)[1]) / 1000
            lost, back = (1000 * float(re.search(rf"{word} *\[(\d+\.\d+) ", part)[1]) for word in ("ERROR", "PERF"))
            losses.append(round(back - lost))
            presses.append(round(back - pressed))
        same(len(losses), PRESSES)
        for start, times in ((f"its complaint of {what}", sorted(losses)), (what, sorted(presses))):
            note({f"ustreamer: from {start} to the next frame, median of {PRESSES}": f"{times[PRESSES // 2]} ms",
                  f"ustreamer: from {start} to the next frame, the most": f"{times[-1]} ms"})


if options.peers:
    case(recovery_beside_that_of_ustreamer)


if __name__ == "__main__":
    status = run_cases("Linux ports on the emulated board", options.words, options.at_once)
    if options.figures:
        options.figures.write_text("".join(f"{name} = {value}\n" for name, value in sorted(figures.items())))
    sys.exit(status)
