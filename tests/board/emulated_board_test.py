#!/usr/bin/env python3
"""Proves the emulated board itself: emulated_board_test.py [WORD...]

Prints one line a case. With WORDs only cases whose names hold one of them. Two boards run at a time.
"""
import contextlib
import os
import socket
import subprocess
import sys
import tempfile
import time
import urllib.request
from pathlib import Path

from cases import case, holds, run_cases, same
from debian import BoardError
from emulated_board import EmulatedBoard

HERE = Path(__file__).resolve().parent


def start(*words, **options):
    return subprocess.Popen([HERE / "run_on_board", *words], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, **options)


def run(*words, stdin=b""):
    """(status, output, what it complained of)"""
    process = start(*words)
    out, complaints = process.communicate(stdin)
    return process.returncode, out.decode(errors="replace"), complaints.decode(errors="replace")


@contextlib.contextmanager
def booted(script, *words, **options):
    with EmulatedBoard(["sh", "-c", script, "sh", *words], seconds=30, **options) as board:
        yield board


def expect(board, line):
    seen = board.stdout.line()
    if seen != line:
        raise AssertionError(f"'{line}' was expected, '{seen}' came; {board.stderr.everything()}")


def ends_well(board):
    same((board.wait(), board.trouble, board.stderr.everything()), (0, "", b""))


def within(seconds, claim, what):
    end = time.monotonic() + seconds
    while not claim():
        if time.monotonic() > end:
            raise AssertionError(what)
        time.sleep(0.05)


# ---- The command ----------------------------------------------------------------------------


@case
def status_and_streams_are_the_commands():
    same(run("--", "sh", "-c", "echo out; echo err >&2; exit 7"), (7, "out\n", "err\n"))


@case
def nothing_is_there_that_was_not_asked_for():
    status, out, _ = run("--", "sh", "-c", "cat; ls /dev /sys/class/net")
    same(status, 0)
    same([name for name in out.split() if name.startswith(("video", "ttyUSB", "vd", "eth", "watchdog"))], [])


@case
def an_abort_is_told_as_128_and_the_signal():
    status, _, _ = run("--", "sh", "-c", "kill -ABRT $$")
    same(status, 134)


@case
def a_command_that_is_not_there_is_127():
    status, _, complaint = run("--", "/nowhere/to/be/found")
    same(status, 127)
    holds(complaint, "not found")


@case
def words_arrive_as_they_were_given():
    words = ["it's", 'a "word"', "$HOME `x` \\n", "two\nlines", "", "*", "ä"]
    same(run("--", "printf", "<%s>", *words), (0, "".join(f"<{word}>" for word in words), ""))


@case
def standard_input_comes_through_unchanged():
    data = os.urandom(3000000)
    process = start("--stdin", "--", "cat")
    same(process.communicate(data)[0] == data, True)
    same(process.returncode, 0)


@case
def files_and_folders_go_in_and_come_out():
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        (folder / "in/deep").mkdir(parents=True)
        (folder / "in/deep/data").write_bytes(bytes(range(256)))
        (folder / "hello").write_text("#!/bin/sh\ncp -r /data /copy; echo $0 $1\n")
        (folder / "hello").chmod(0o755)
        answer = run("--file", f"{folder}/in:/data", "--get", f"/copy:{folder}/out", "--get",
                     f"/data/deep/data:{folder}/one", "--", folder / "hello", "you")
        same(answer, (0, "/host/hello you\n", ""))
        same((folder / "out/deep/data").read_bytes(), bytes(range(256)))
        same((folder / "one").read_bytes(), bytes(range(256)))


@case
def a_file_that_cannot_be_fetched_is_told():
    with tempfile.TemporaryDirectory() as folder:
        status, _, complaint = run("--get", f"/nothing:{folder}/x", "--", "true")
    same(status, 125)
    holds(complaint, "the board has no /nothing")


@case
def options_that_cannot_be_met_are_refused():
    for words, complaint in [
            (["--nonsense", "--", "true"], "--nonsense"), ([], "no command"),
            (["--file", "x", "--", "true"], "a colon"),
            (["--file", "/nowhere:/x", "--", "true"], "no such file: /nowhere"),
            (["--module", "nonsense", "--", "true"], "has no module nonsense"),
            (["--serial", "nonsense", "--", "true"], "a far end is")]:
        status, _, complaints = run(*words)
        same((words, status), (words, 125))
        holds(complaints, complaint)


# ---- Ends that nobody wants -----------------------------------------------------------------


@case
def a_panic_is_told():
    status, _, complaint = run("--", "sh", "-c", "echo c > /proc/sysrq-trigger")
    same(status, 125)
    holds(complaint, "Kernel panic - not syncing: sysrq triggered crash")


@case
def a_reboot_is_no_end():
    status, _, complaint = run("--", "reboot", "-f")
    same(status, 125)
    holds(complaint, "the board ended without a status")


@case
def too_little_memory_is_told():
    status, _, complaint = run("--memory-mb", "8", "--seconds", "20", "--", "true")
    same(status, 125)
    holds(complaint, "the end of its console")


@case
def time_runs_out():
    start_s = time.monotonic()
    status, _, complaint = run("--seconds", "5", "--", "sleep", "99")
    same(status, 124)
    holds(complaint, "no end after 5.0 s")
    if time.monotonic() - start_s > 15:
        raise AssertionError("it took more than 15 s")


def processes_with(text):
    commands = []
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        with contextlib.suppress(OSError):
            commands.append(path.read_bytes().decode(errors="replace"))
    return [command for command in commands if "qemu-system" in command and text in command]


def stopped_by(signal_name, folder):
    """A runner that was stopped in the middle, with its temporary files below folder."""
    process = start("--", "sh", "-c", "echo up; sleep 99", env={**os.environ, "TMPDIR": folder})
    same(process.stdout.readline(), b"up\n")
    same(len(processes_with(folder)), 1)
    getattr(process, signal_name)()
    process.communicate()
    within(3, lambda: not processes_with(folder), "QEMU is left behind")
    return process.returncode


@case
def a_killed_runner_leaves_no_process():
    with tempfile.TemporaryDirectory() as folder:
        same(stopped_by("kill", folder), -9)


@case
def a_terminated_runner_leaves_neither_process_nor_folder():
    with tempfile.TemporaryDirectory() as folder:
        same(stopped_by("terminate", folder), 143)
        same(os.listdir(folder), [])


@case
def a_reader_that_goes_away_ends_it():
    process = start("--", "sh", "-c", "while echo y; do sleep 0.1; done")
    process.stdout.readline()
    process.stdout.close()
    same(process.wait(), 141)
    process.stderr.close()


# ---- Devices --------------------------------------------------------------------------------


def cameras_of(*words):
    status, out, complaint = run(*words, "--", "sh", "-c", "ls /dev | grep video | sort | tr '\\n' ' '")
    same((status, complaint), (0, ""))
    return out.split()


@case
def one_camera():
    same(cameras_of("--cameras", "1"), ["video0"])


@case
def two_cameras():
    same(cameras_of("--cameras", "2"), ["video0", "video1"])


@case
def two_cameras_with_their_outputs():
    same(cameras_of("--cameras", "2", "--loop"), ["video0", "video1", "video2", "video3"])


@case
def modules_take_options_and_processors_are_counted():
    script = """
ls /dev/watchdog; ls /dev | grep -c 'loop[0-9]'; cat /sys/module/vivid/parameters/no_error_inj; nproc"""
    modules = ["softdog", "loop max_loop=3"]
    with booted(script, modules=modules, cameras=1, vivid="no_error_inj=1", cpus=2) as board:
        for line in ("/dev/watchdog", "3", "Y", "2"):
            expect(board, line)
        ends_well(board)


RAW = "stty -F $1 raw -echo; exec 3<> $1; echo ready; "


@case
def serial_lines():
    """Both ways, bytes of all values, a line to a socket and one to a pseudo terminal."""
    script = RAW + "dd bs=1 count=256 <&3 2>&- >&3; read -r word < $2; echo $word"
    with booted(script, "/dev/ttyS0", "/dev/ttyS1", serial=["socket", "pty"]) as board:
        expect(board, "ready")
        board.serial[0].sendall(bytes(range(256)))
        board.serial[0].settimeout(10)
        back = b""
        while len(back) < 256:
            back += board.serial[0].recv(256)
        same(back, bytes(range(256)))
        with open(board.serial[1], "r+b", buffering=0) as line:
            line.write(b"hello\n")
            expect(board, "hello")
        ends_well(board)


@case
def a_usb_serial_adapter_is_unplugged_and_plugged_in():
    script = RAW + """
read -r word <&3; echo $word
read -r word <&3 || echo gone
exec 3>&-; until [ ! -e $1 ]; do sleep 0.1; done; echo no node
until [ -e $1 ]; do sleep 0.1; done; """ + RAW + "read -r word <&3; echo $word"
    with booted(script, "/dev/ttyUSB0", usb_serial=["socket"]) as board:
        expect(board, "ready")
        board.usb_serial[0].sendall(b"one\n")
        expect(board, "one")
        board.unplug_usb_serial(0)
        expect(board, "gone")
        expect(board, "no node")
        board.plug_usb_serial(0)
        expect(board, "ready")
        board.usb_serial[0].sendall(b"two\n")
        expect(board, "two")
        ends_well(board)


@case
def pins_are_driven_and_seen():
    script = """
gpiomon --line-buffered --num-events=2 --format='%e %o' gpiochip0 3 &
until gpioinfo gpiochip0 | grep -q 'line *3.*used'; do sleep 0.05; done
echo ready; wait
gpioset gpiochip0 5=1; gpioset gpiochip0 5=0; gpioset gpiochip0 6=1; gpioget gpiochip0 2
read -r end"""
    with booted(script, packages=["gpiod"], stdin=subprocess.PIPE) as board:
        pins = board.pins
        pins.drive(2, 1)
        expect(board, "ready")
        same(pins.wait_for(5, 1, seconds=0.1), False)
        pins.drive(3, 1)
        expect(board, "1 3")
        pins.drive(3, 0)
        expect(board, "0 3")
        same(pins.wait_for(5, 1), True)
        same(pins.wait_for(5, 0), True)
        same(pins.wait_for(6, 1), True)
        same((pins.outputs().get(6), pins.outputs().get(5)), (1, 0))
        expect(board, "1")
        board.process.stdin.write(b"end\n")
        board.process.stdin.flush()
        ends_well(board)


@case
def more_pins_and_names_by_gpio_sim():
    script = """
chip=/sys/kernel/config/gpio-sim/board
mkdir -p $chip/bank/line10; echo 12 > $chip/bank/num_lines; echo trigger > $chip/bank/line10/name
echo 1 > $chip/live
pull=$(ls -d /sys/devices/platform/gpio-sim.*/gpiochip*/sim_gpio10)/pull
gpiofind trigger; gpioget $(gpiofind trigger)
echo pull-up > $pull; gpioget $(gpiofind trigger)"""
    with booted(script, packages=["gpiod"], modules=["gpio-sim"]) as board:
        for line in ("gpiochip1 10", "0", "1"):
            expect(board, line)
        ends_well(board)


@case
def a_power_cut_keeps_what_was_synced():
    with tempfile.TemporaryDirectory() as folder:
        image = Path(folder) / "disk"
        with image.open("wb") as file:
            file.truncate(32 << 20)
        subprocess.run(["/sbin/mkfs.ext4", "-q", image], check=True)
        mount = "mkdir /disk; mount -t ext4 $1 /disk && "
        with booted(mount + "echo kept > /disk/file; sync; echo synced; sleep 99", "/dev/vda", disks=[image],
                    modules=["ext4"]) as board:
            expect(board, "synced")
            board.kill()
            same(board.wait(), 125)
        with booted(mount + "cat /disk/file", "/dev/vda", disks=[image], modules=["ext4"]) as board:
            expect(board, "kept")
            ends_well(board)


@case
def a_port_of_the_board_answers():
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    script = "mkdir /www; echo page > /www/index.html; httpd -p 80 -h /www; echo ready; sleep 99"
    with booted(script, ports={80: port}) as board:
        expect(board, "ready")
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/", timeout=10) as answer:
            same(answer.read(), b"page\n")


@case
def a_board_that_cannot_start_leaves_nothing():
    board = EmulatedBoard(["true"], modules=["nonsense"])
    try:
        with board:
            raise AssertionError("it has started")
    except BoardError as error:
        holds(str(error), "nonsense")
    same(board.folder.exists(), False)
    with EmulatedBoard(["true"], disks=["/nowhere"]) as board:
        same(board.wait(), 125)
        holds(board.trouble, "Could not open '/nowhere'")
    same(board.folder.exists(), False)


# ---- Running them ---------------------------------------------------------------------------


def main():
    subprocess.run([HERE / "run_on_board", "--prepare"], check=True)
    return run_cases("emulated board", sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
