#!/usr/bin/env python3
"""Reads from a program for a chip how deep its stack can be, along the deepest chain of calls, and that it has so much.

Frames and calls come from the compiler's notes (-fcallgraph-info=su). A call through a pointer may reach every function
whose address the object files take. Functions that the compiler did not write, of libgcc, are read from the program:
what they push, and whom they call. On Arm, the frame that the processor stacks for an interrupt and the deepest interrupt
come on top; the boards with RISC-V have none.

usage: call_depth.py PROGRAM FOLDER... [--measured BYTES]    the notes and object files below the folders; the depth
       that a run has reached must not be above what is read here
"""
import argparse
import re
import subprocess
import sys
from pathlib import Path

INDIRECT = "__indirect_call"

NODE = re.compile(r'^node: \{ title: "([^"]*)" label: "([^"]*)"')
EDGE = re.compile(r'^edge: \{ sourcename: "([^"]*)" targetname: "([^"]*)"')
FRAME = re.compile(r"\\n(\d+) bytes \(([^)]*)\)")
SYMBOL = re.compile(r"^([0-9a-f]+) <(.*)>:$")
INSTRUCTION = re.compile(r"^ *[0-9a-f]+:\t(\S+)\s*(.*)$")


class Arm:
    tools = "arm-none-eabi-"
    entry = "fovea_reset"
    interrupts = ("fovea_systick",)
    # Eight words, and one to align them.
    exception_frame = 36
    # In a table or a literal, or as two instructions.
    taken = re.compile(r"R_ARM_(?:ABS32|THM_MOVW_ABS_NC)\s+(?:\.text\.)?(\S+)")
    jump = re.compile(r"b(l|x|\.[nw])?$|b[a-z]{2}(\.[nw])?$")

    @staticmethod
    def stacked(word, rest):
        """Bytes that an instruction takes of the stack."""
        if word.startswith("push") or (word.startswith("stmdb") and rest.startswith("sp!")):
            return 4 * registers(rest)
        if re.match(r"sub(\.w|w)?$", word) and (size := re.match(r"sp, (?:sp, )?#(\d+)", rest)):
            return int(size[1])
        stored = re.search(r"\[sp, #-(\d+)\]!", rest)
        return int(stored[1]) if stored else 0

    @staticmethod
    def begins_frame(word, rest):
        return word.startswith(("push", "stmdb")) and "lr" in rest


class RiscV:
    tools = "riscv64-unknown-elf-"
    # What lies in front of it has no stack yet.
    entry = "fovea_start"
    interrupts = ()
    exception_frame = 0
    taken = re.compile(r"R_RISCV_(?:32|HI20|PCREL_HI20)\s+(?:\.text\.)?([^\s+]+)")
    jump = re.compile(r"jal?$|b[a-z]+$|tail$")

    @staticmethod
    def stacked(word, rest):
        taken = re.match(r"sp,sp,-(\d+)", rest) if word == "addi" else None
        return int(taken[1]) if taken else 0

    @staticmethod
    def begins_frame(word, rest):
        return False


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def plain(title):
    """A function of one file is called FILE:NAME there."""
    return title.rsplit(":", 1)[-1]


class Calls:
    def __init__(self, processor):
        self.processor = processor
        self.frames, self.calls, self.taken, self.program, self.reached, self.problems = {}, {}, set(), set(), set(), []

    def read_notes(self, path):
        for line in path.read_text().splitlines():
            if (found := NODE.match(line)) and (frame := FRAME.search(found[2])):
                name = plain(found[1])
                # An inline function stands in several files; one of them is in the program.
                self.frames[name] = max(int(frame[1]), self.frames.get(name, 0))
                if frame[2] != "static":
                    self.problems.append(f"a frame of unknown size: {name}")
            elif found := EDGE.match(line):
                self.calls.setdefault(plain(found[1]), set()).add(plain(found[2]))

    def read_object(self, path):
        self.taken |= set(self.processor.taken.findall(run(self.processor.tools + "objdump", "-r", str(path))))

    def read_program(self, path):
        """What the notes do not tell of: functions that the compiler did not write, and words of an argument that came in
        registers and are laid on the stack in front of a frame. A function may have several names."""
        names = {}
        for line in run(self.processor.tools + "nm", str(path)).splitlines():
            words = line.split()
            if len(words) == 3 and words[1] in "tTwW":
                names.setdefault(int(words[0], 16), []).append(words[2])
                self.program.add(words[2])
        pushed, front, name = {}, {}, None
        for line in run(self.processor.tools + "objdump", "-d", "--no-show-raw-insn", str(path)).splitlines():
            if found := SYMBOL.match(line):
                here = names.get(int(found[1], 16))
                # Other labels are no functions.
                if here:
                    name = here[0]
                    pushed[name], front[name] = 0, None
                    for other in here[1:]:
                        if other not in self.frames:
                            self.frames[other], self.calls[other] = 0, {name}
            elif name and (found := INSTRUCTION.match(line)):
                word, rest = found.groups()
                taken = self.processor.stacked(word, rest)
                if front[name] is None and self.processor.begins_frame(word, rest):
                    front[name] = pushed[name]
                if taken == 0 and name not in self.frames and self.processor.jump.match(word):
                    to = re.search(r"<([^+>]*)>", rest)
                    if to and to[1] != name:
                        self.calls.setdefault(name, set()).add(to[1])
                pushed[name] += taken
        for name, bytes_pushed in pushed.items():
            noted = self.frames.get(name, 0) + (front[name] or 0)
            self.frames[name] = max(bytes_pushed, noted)

    def deepest(self, name):
        """Bytes from a function on, and the chain of calls."""
        done = {}
        path = []

        def depth(function):
            if function in path:
                self.problems.append(f"recursion: {' -> '.join(path[path.index(function):] + [function])}")
                return 0, []
            if function not in done:
                path.append(function)
                callees = self.taken_functions() if function == INDIRECT else self.calls.get(function, set())
                # Calls that the compiler has taken out at last lead to nothing.
                callees = {callee for callee in callees if callee in self.program or callee == INDIRECT}
                below = max((depth(callee) for callee in sorted(callees)), default=(0, []))
                path.pop()
                done[function] = (self.frames.get(function, 0) + below[0], [function, *below[1]])
            return done[function]

        answer = depth(name)
        self.reached |= done.keys()
        return answer

    def taken_functions(self):
        never = (self.processor.entry, *self.processor.interrupts, "fovea_fault")
        return {name for name in self.taken if name in self.program and name not in never}


def registers(text):
    inside = text[text.index("{") + 1:text.index("}")]
    number = {"sl": 10, "fp": 11, "ip": 12, "sp": 13, "lr": 14, "pc": 15}
    count = 0
    for part in inside.replace(" ", "").split(","):
        ends = [number.get(end) if end in number else int(end[1:]) for end in part.split("-")]
        count += ends[-1] - ends[0] + 1
    return count


def main():
    sys.setrecursionlimit(10000)
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=Path)
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--measured", type=int, default=0)
    options = parser.parse_args()
    # The number of the machine in an ELF file.
    processor = {40: Arm, 243: RiscV}[int.from_bytes(options.program.read_bytes()[18:20], "little")]
    calls = Calls(processor)
    notes = [path for folder in options.folders for path in sorted(folder.rglob("*.ci"))]
    for path in notes:
        calls.read_notes(path)
    for folder in options.folders:
        for path in sorted(folder.rglob("*.obj")):
            calls.read_object(path)
    calls.read_program(options.program)
    places = {line.split()[2]: int(line.split()[0], 16) for line in run(processor.tools + "nm", str(options.program)).splitlines()
              if len(line.split()) == 3}
    room = places["fovea_stack_top"] - places["fovea_stack_limit"]
    depth, chain = calls.deepest(processor.entry)
    interrupt = processor.exception_frame + max((calls.deepest(name)[0] for name in processor.interrupts), default=0)
    most = depth + interrupt
    if "main" not in calls.reached:
        calls.problems.append("main is not called")
    if not notes:
        calls.problems.append("no notes of the compiler")
    if most > room:
        calls.problems.append(f"{most} bytes of stack, and there are {room}")
    if options.measured > most:
        calls.problems.append(f"a run took {options.measured} bytes of stack, and at most {most} were read")
    if calls.problems:
        print("\n".join(sorted(set(calls.problems))))
        print("\n".join(f"{calls.frames.get(name, 0):6} {name}" for name in chain))
        return 1
    print(f"call_depth: at most {most} of {room} bytes of stack, {interrupt} of them for interrupts")
    return 0


sys.exit(main())
