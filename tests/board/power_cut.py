#!/usr/bin/env python3
"""Cuts the power of boards that save without end: power_cut.py BOARD_PROGRAM HOST_PROGRAM [OPTIONS]

Both programs are storage_on_board.cpp, compiled for the board and for the host. A board is started once, and each run
goes on from there. Before every cut the board has told
what it saved last. After it the host has the journal replayed (e2fsck), takes the files from the image and wants
each to be whole, and not older than what was told. Every tenth time the kernel of a second board replays and
reads too.

A cut ends QEMU. What the board had handed to its disk by then is kept, though a real disk may lose what it has not
been told to flush: that the flush is asked for is in FileStorage's tests of its calls, not here.
"""
import argparse
import collections
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from emulated_board import EmulatedBoard

IMAGE_MB = 16
# Where the boards go on from: a board that is up, and has not looked at its disk yet.
SCRIPT = """
mkdir /disk
echo ready
read -r what mount kinds
mount -t ext4 -o $mount /dev/vda /disk && exec /test/storage $what /disk/data $kinds
"""


def run(*command, good=(0,)):
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode not in good:
        raise RuntimeError(f"{command[0]} ended with {done.returncode}: {done.stdout}")
    return done.stdout


def numbers(text):
    """{kind: the last number told}; a line that has no end was not told."""
    return {kind: int(number) for kind, number in re.findall(r"^(\w+) (\d+)\n", text, re.M)}


class Disk:
    """An image with one file of each kind, so that one which is gone cannot be taken for one never written."""

    def __init__(self, folder, program, kinds, journal):
        self.path, self.kinds = folder / "seed.img", kinds
        seed = folder / "seed"
        (seed / "data").mkdir(parents=True)
        run(program, "seed", seed / "data", *kinds)
        with self.path.open("wb") as image:
            image.truncate(IMAGE_MB << 20)
        run("mkfs.ext4", "-q", "-F", "-d", seed, *([] if journal else ["-O", "^has_journal"]), self.path)


def board(options, image, **further):
    return EmulatedBoard(["sh", "-c", SCRIPT], files={"/test/storage": options.board_program}, modules=["ext4"],
                         disks=[image], stdin=subprocess.PIPE, memory_mb=128, seconds=60, **further)


def tell(running, *words):
    running.process.stdin.write(" ".join(words).encode() + b"\n")
    running.process.stdin.flush()


def boot(options, folder):
    """Saves the state of a board that is up; the file."""
    image = folder / "none.img"
    with image.open("wb") as file:
        file.truncate(IMAGE_MB << 20)
    with board(options, image) as running:
        if running.stdout.line() != "ready":
            running.wait()
            raise RuntimeError(f"the board is not ready: {running.stderr.everything()} {running.trouble}")
        running.save_state(folder / "state")
    return folder / "state"


def cut(options, state, disk, number, mount, longest):
    """What was told before a cut, and what is read after it, by the host and at times by a board."""
    dice = random.Random(f"{options.seed} {number}")
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        image = folder / "disk.img"
        shutil.copy(disk.path, image)
        with board(options, image, resume=state) as running:
            tell(running, "save", mount, *disk.kinds)
            if running.stdout.line() is None:
                running.wait()
                raise RuntimeError(f"nothing was saved: {running.stderr.everything()} {running.trouble}")
            time.sleep(dice.uniform(0, longest))
            running.kill()
            told = numbers(running.stdout.everything().decode())
        seen = [read_here(options, disk, image, folder)]
        if number % 10 == 0:
            with board(options, image, resume=state) as reading:
                tell(reading, "read", mount, *disk.kinds)
                reading.wait()
                seen.append(reading.stdout.everything().decode())
    return told, seen


def read_here(options, disk, image, folder):
    """What the host reads from a copy of the image; its own is replayed by a board."""
    copy = folder / "copy.img"
    shutil.copy(image, copy)
    run("e2fsck", "-y", copy, good=(0, 1))
    (folder / "files").mkdir()
    run("debugfs", "-R", f"rdump /data {folder}/files", copy)
    return subprocess.run([options.host_program, "read", folder / "files/data", *disk.kinds], stdout=subprocess.PIPE,
                          text=True).stdout


def faults(told, seen):
    """What is wrong. A file may be ahead of what was told, by a save that the cut kept from being told."""
    wrong = set()
    for text in seen:
        held = numbers(text)
        for kind, number in told.items():
            if kind not in held:
                wrong.update([line for line in text.splitlines() if line.startswith(f"{kind}:")] or [f"{kind}: gone"])
            elif held[kind] < number:
                wrong.add(f"{kind}: older than what was told")
    return wrong


def series(options, state, name, kinds, cuts, journal=True, mount="relatime", longest=1.5):
    """Cuts so often; {what is wrong: how often} and the number of cuts."""
    begin = time.monotonic()
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(options.at_once) as pool:
        disk = Disk(Path(folder), options.host_program, kinds, journal)
        results = list(pool.map(lambda number: cut(options, state, disk, number, mount, longest), range(cuts)))
    bad = collections.Counter(fault for told, seen in results for fault in faults(told, seen))
    saved = sum(sum(told.values()) for told, _ in results)
    print(f"{name}: {cuts} cuts after {saved} saves in {time.monotonic() - begin:.0f} s, {sum(bad.values())} bad files",
          *(f"  {count} times {what}" for what, count in sorted(bad.items())), sep="\n", flush=True)
    return bad, saved


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("board_program", type=Path)
    parser.add_argument("host_program", type=Path)
    parser.add_argument("--cuts", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--at-once", type=int, default=1, metavar="BOARDS")
    parser.add_argument("--figures", type=Path)
    options = parser.parse_args()
    options.board_program, options.host_program = options.board_program.resolve(), options.host_program.resolve()
    without = options.cuts // 5
    with tempfile.TemporaryDirectory() as folder:
        state = boot(options, Path(folder))
        ours, saved = series(options, state, "ext4", ["file", "generations"], options.cuts - without)
        bare, more = series(options, state, "ext4 without a journal", ["generations"], without, journal=False)
        # It must be seen that this sees something.
        planted, _ = series(options, state, "planted: truncated and written", ["in_place"], 5, mount="commit=1",
                            longest=3)
    if options.figures:
        figures = {"power cuts": options.cuts, "power cuts: saves told before them": saved + more,
                   "power cuts: files bad or older than told": sum((ours + bare).values()),
                   "power cuts: of 5, files bad or older when truncated in place": sum(planted.values())}
        options.figures.write_text("".join(f"{name} = {value}\n" for name, value in figures.items()))
    good = not ours and not bare and bool(planted)
    print(f"power cuts: {options.cuts}, {sum((ours + bare).values())} bad; planted fault "
          f"{'seen' if planted else 'NOT SEEN'}")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
