#!/usr/bin/env python3
"""Drives the pins of an emulated board from outside and looks at them: pins.py BOARD PROGRAM

The world around the board is QEMU's test socket: levels on inputs, registers of outputs.
"""
import os
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

# board: (the trigger's object and line if there is one, the register of outputs, bits of OK and not OK)
BOARDS = {
    "microbit": ("/machine/nrf51 unnamed-gpio-in 1", 0x50000504, 1 << 3, 1 << 2),
    "lm3s6965evb": ("/machine/unattached/device[12] unnamed-gpio-in 2", 0x400053FC, 1, 2),
    "sifive_e": ("/machine/soc unnamed-gpio-in 7", 0x1001200C, 1 << 19, 1 << 20),
    "mps2_an386": (None, 0x40028000, 1, 2),
    "mps2_an500": (None, 0x40028000, 1, 2),
    "netduinoplus2": ("/machine/unattached/device[0]/syscfg unnamed-gpio-in 3", None, 0, 0),
}


def address_of(program, name):
    symbols = subprocess.run(["arm-none-eabi-nm", program], check=True, capture_output=True, text=True).stdout
    return int(next(line for line in symbols.splitlines() if line.endswith(f" {name}")).split()[0], 16)


class Board:
    def __init__(self, board, program, folder):
        self.trigger, self.register, self.ok, self.not_ok = BOARDS[board]
        path = Path(folder) / "world"
        emulate = Path(__file__).resolve().parent / "emulate"
        self.process = subprocess.Popen(
            [emulate, board, program, "-qtest", f"unix:{path},server=on,wait=off", "-qtest-log", os.devnull, "-accel", "tcg"],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.world = socket.socket(socket.AF_UNIX)
        for _ in range(500):
            try:
                self.world.connect(str(path))
                break
            except OSError:
                time.sleep(0.01)
        self.answers = self.world.makefile("r")

    def tell(self, command):
        self.world.sendall(f"{command}\n".encode())
        answer = self.answers.readline().split()
        if not answer or answer[0] != "OK":
            sys.exit(f"pins: {command}: {answer}")
        return answer[1:]

    def set_trigger(self, level):
        self.tell(f"set_irq_in {self.trigger} {level}")

    def outputs(self):
        bits = int(self.tell(f"readl {self.register:#x}")[0], 16)
        return bool(bits & self.ok), bool(bits & self.not_ok)

    def deepest_stack(self, program):
        """Of the stack that startup painted: how much a program took."""
        limit, top = address_of(program, "fovea_stack_limit"), address_of(program, "fovea_stack_top")
        memory = bytes.fromhex(self.tell(f"read {limit:#x} {top - limit:#x}")[0][2:])
        free = next(i for i in range(0, len(memory), 4) if memory[i:i + 4] != bytes.fromhex("55eeffc0"))
        return f"{len(memory) - free} of {len(memory)} bytes of stack"

    def say(self, text):
        self.process.stdin.write(text.encode())
        self.process.stdin.flush()

    def expect(self, line):
        seen = self.process.stdout.readline().decode().rstrip("\n")
        if seen != line:
            sys.exit(f"pins: '{line}' was expected, '{seen}' came")

    def expect_outputs(self, ok, not_ok):
        if self.register is not None and self.outputs() != (ok, not_ok):
            sys.exit(f"pins: OK and not OK must be {ok}, {not_ok}, but are {self.outputs()}")


def drive(board):
    board.expect("ready")
    board.expect_outputs(False, True)
    # Every byte comes back, in order.
    for text in "fovea 42":
        board.say(text)
        board.expect(text)
    # An edge is seen once, and only one that makes the line active.
    for _ in range(3):
        board.set_trigger(1)
        board.expect("edge" if board.register is None else "edge, active")
        board.expect_outputs(True, False)
        board.set_trigger(0)
        # The second answer comes after the program has asked for the line once more.
        for _ in range(2):
            board.say("-")
            board.expect("-")
    # A clock that runs, and not much faster than ours; a busy emulator loses time.
    board.say("t")
    first = int(board.process.stdout.readline())
    start = time.monotonic()
    time.sleep(0.2)
    board.say("t")
    second = int(board.process.stdout.readline())
    elapsed = round((time.monotonic() - start) * 1000000)
    if not 0 <= first < second <= first + 5 * elapsed:
        sys.exit(f"pins: the clock said {first} and then {second}, {elapsed} us later")
    board.say("q")
    code = board.process.wait(30)
    if code != 0:
        sys.exit(f"pins: the program ended with {code}")


def main():
    name, program = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        board = Board(name, program, folder)
        try:
            drive(board)
        finally:
            board.process.terminate()
    print(f"pins: {name}: trigger, verdicts, echo and clock")


if __name__ == "__main__":
    main()
