#!/usr/bin/env python3
"""Drives firmware_gauge on an emulated board from outside: firmware.py BOARD PROGRAM FOVEA [--recipe-inside]

    firmware.py recipe FOVEA FILE     compiles the recipe that is used here, for a program that has it inside

Recipes and frames go over the serial line, triggers and verdicts over the pins. What the board measures must be what
the tool FOVEA measures in the same pictures, digit for digit. Then all that can go wrong does: each time the board must
say what, leave both pins inactive, and judge the next good frame.

--recipe-inside: the program was built with a recipe, and says so at once.
"""
import json
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path

from pins import Board

MARK, ESCAPE = 0xC0, 0xDB


def packet(kind, content=b""):
    content = kind.encode() + content
    content += zlib.crc32(content).to_bytes(4, "little")
    inside = content.replace(b"\xdb", b"\xdb\xdd").replace(b"\xc0", b"\xdb\xdc")
    return b"\xc0" + inside + b"\xc0"


def begin(width, height):
    return packet("F", width.to_bytes(2, "little") + height.to_bytes(2, "little"))


def line(number, pixels):
    return packet("L", number.to_bytes(2, "little") + pixels)


def read_pgm(path):
    """(width, height, pixels) of a binary PGM."""
    words = path.read_bytes().split(maxsplit=3)
    assert words[0] == b"P5"
    width, height = int(words[1]), int(words[2])
    return width, height, path.read_bytes()[-width * height:]


class Frame:
    """A picture as the packets of its frame."""

    def __init__(self, width, height, pixels):
        self.width, self.height = width, height
        self.begin = begin(width, height)
        self.lines = [line(y, pixels[y * width:][:width]) for y in range(height)]

    def all(self):
        return self.begin + b"".join(self.lines)


class Firmware:
    def __init__(self, board):
        self.board = board
        self.faults = 0  # that the board told of

    def send(self, data):
        self.board.process.stdin.write(data)
        self.board.process.stdin.flush()

    def hear(self):
        text = self.board.process.stdout.readline().decode()
        try:
            heard = json.loads(text)
        except ValueError:
            sys.exit(f"firmware: no line of JSON: {text!r}")
        self.faults += "error" in heard or "missed" in heard
        return heard

    def expect(self, **wanted):
        heard = self.hear()
        if any(heard.get(key) != value for key, value in wanted.items()):
            sys.exit(f"firmware: {wanted} was expected, {heard} came")
        return heard

    def trigger(self):
        """By the pin where the emulator can move it."""
        if self.board.trigger is None:
            self.send(packet("T"))
        else:
            self.board.set_trigger(1)
        answer = self.hear()
        if self.board.trigger is not None:
            self.board.set_trigger(0)
            # A line that is asked, not remembered: the second answer comes after it was asked once more.
            for _ in range(2):
                self.send(packet("?"))
                self.hear()
        return answer

    def arm(self):
        answer = self.trigger()
        if not answer.get("ready"):
            sys.exit(f"firmware: not ready: {answer}")
        self.board.expect_outputs(False, False)
        return answer["frame"]

    def judge(self, picture, wanted):
        """A frame that must be judged as the tool judges it."""
        number = self.arm()
        self.send(picture.all())
        heard = self.expect(frame=number, verdict=wanted["verdict"])
        if heard["parts"] != [wanted]:
            sys.exit(f"firmware: the tool measured {wanted}, the board {heard['parts']}")
        self.board.expect_outputs(wanted["verdict"] == "ok", wanted["verdict"] == "not_ok")


def as_told_by_a_board(told):
    """The line of the tool, without what the board does not repeat."""
    part = {key: told[key] for key in ("x", "y", "angle_deg", "area_px", "holes")}
    part["features"] = [{key: feature[key] for key in ("name", "value", "verdict")} for feature in told["features"]]
    part["verdict"] = told["verdict"]
    return part


def with_a_wrong_bit(line):
    """In a pixel that is no mark before or after, nor part of an escape."""
    special = (MARK, ESCAPE)
    place = next(i for i in range(8, len(line) - 8) if not {line[i - 1], line[i], line[i] ^ 1} & set(special))
    return line[:place] + bytes([line[place] ^ 1]) + line[place + 1:]


def faults(good, room):
    """(name, what is sent after the trigger, the error), for everything but time."""
    damaged = with_a_wrong_bit(good.lines[5])
    return [
        ("a line with a wrong bit", good.begin + b"".join(good.lines[:5]) + damaged + b"".join(good.lines[6:]), "packet damaged"),
        ("a line cut off", good.begin + good.lines[0] + good.lines[1][:20] + b"".join(good.lines[2:]), "packet damaged"),
        ("a line that is missing", good.begin + good.lines[0] + b"".join(good.lines[2:]), "line missing"),
        ("a line twice", good.begin + good.lines[0] * 2 + b"".join(good.lines[1:]), "line missing"),
        ("a line that is too short", good.begin + line(0, bytes(good.width - 1)), "line of a wrong length"),
        ("a line that is too long", good.begin + line(0, bytes(good.width + 1)), "line of a wrong length"),
        ("a packet without end", good.begin + b"\xc0L" + bytes(room["line_bytes"] + 400), "packet too long"),
        ("a frame within a frame", good.begin + good.begin, "frame within a frame"),
        ("a frame that is too large", begin(60000, 60000), "frame too large"),
        ("a frame without pixels", begin(0, 48), "frame without pixels"),
        ("a frame's head cut off", packet("F", b"\x40"), "packet of a wrong size"),
        ("a packet of another kind", packet("Z", b"what?"), "packet of an unknown kind"),
        ("a recipe within a frame", packet("R", b"FVRC"), "recipe within a frame"),
        ("a wrong escape", good.begin + b"\xc0L\xdb\x01\x00\x00\x00\x00\xc0", "packet damaged"),
        ("an even picture", begin(8, 8) + b"".join(line(y, bytes(8)) for y in range(8)), "the data do not determine an answer"),
        ("a picture without part", begin(16, 16) + b"".join(line(y, bytes([200] * 15 + [9])) for y in range(16)), "no part"),
    ]


def tool_in(fovea, folder):
    return lambda *words: subprocess.run([fovea, *words], cwd=folder, capture_output=True, text=True).stdout


def make_files(tool):
    """Pictures that fit the memory of the smallest board, and their recipe."""
    common = ["--size", "64x48", "--cut", "7x5", "--holes", "10,0,4", "--blur", "0.7", "--noise", "2", "--angle", "9"]
    tool("make-part", *common, "--plate", "44x24", "--out", "good.pgm")
    tool("make-part", *common, "--plate", "41x24", "--out", "short.pgm")
    tool("teach", "--out", "plate.toml", "--known-length", "44", "good.pgm")
    tool("compile", "plate.toml", "--out", "plate.bin")


def drive(firmware, fovea, folder, recipe_inside):
    tool = tool_in(fovea, folder)
    make_files(tool)
    told = [json.loads(text) for text in tool("gauge", "--job", "plate.toml", "--json", "good.pgm", "short.pgm").splitlines()]
    good, short = (Frame(*read_pgm(folder / name)) for name in ("good.pgm", "short.pgm"))
    good_told, short_told = map(as_told_by_a_board, told)
    if (good_told["verdict"], short_told["verdict"]) != ("ok", "not_ok"):
        sys.exit("firmware: the pictures do not show a good part and a short one")
    recipe = (folder / "plate.bin").read_bytes()
    board = firmware.board

    room = firmware.expect(recipe="" if recipe_inside else None)
    if recipe_inside:
        firmware.judge(short, short_told)
        return
    board.expect_outputs(False, False)
    # Without a recipe nothing is judged, and none but a whole one is taken.
    if firmware.trigger().get("error") != "no recipe":
        sys.exit("firmware: judged without a recipe")
    wrong = bytearray(recipe)
    wrong[20] ^= 4
    newer = bytearray(recipe)
    newer[4] += 1
    for bad, reason in ((bytes(wrong), "damaged"), (bytes(newer), "of another version"), (recipe[:-9], "it ends too early")):
        firmware.send(packet("R", bad))
        firmware.expect(error=f"recipe refused: {reason}")
    firmware.send(packet("R", recipe))
    firmware.expect(recipe="", features=5)
    firmware.judge(good, good_told)
    firmware.judge(short, short_told)
    # A recipe that is refused leaves the one before.
    firmware.send(packet("R", bytes(wrong)))
    firmware.expect(error="recipe refused: damaged")
    board.expect_outputs(False, False)
    firmware.judge(good, good_told)

    for name, sent, error in faults(good, room):
        number = firmware.arm()
        firmware.send(sent)
        heard = firmware.hear()
        if (heard.get("frame"), heard.get("error"), heard.get("verdict")) != (number, error, "unmeasured"):
            sys.exit(f"firmware: {name}: '{error}' was expected, {heard} came")
        board.expect_outputs(False, False)
        firmware.judge(good, good_told)
    # Without a trigger.
    firmware.send(good.begin)
    firmware.expect(error="frame without a trigger")
    board.expect_outputs(False, False)
    firmware.send(b"".join(good.lines))  # the rest of that frame, in silence
    firmware.judge(short, short_told)
    firmware.send(good.lines[0])
    firmware.expect(error="line without a frame")
    # What was sent between is noise, and no more.
    firmware.send(b"\xc0\xc0" + bytes([7] * 3) + b"\xc0")
    firmware.expect(error="packet damaged")
    # A trigger while a frame is taken: it is missed, and the frame is judged.
    number = firmware.arm()
    firmware.send(good.begin + b"".join(good.lines[:10]))
    if firmware.trigger() != {"frame": number + 1, "missed": True}:
        sys.exit("firmware: a trigger within a frame is not told of")
    firmware.send(b"".join(good.lines[10:]))
    firmware.expect(frame=number, verdict="ok")
    # Patience.
    for sent, error in ((b"", "no frame came"), (good.begin + b"".join(good.lines[:7]), "line too late"),
                        (good.begin + good.lines[0][:9], "line too late")):
        firmware.arm()
        firmware.send(sent)
        before = time.monotonic()
        firmware.expect(error=error)
        if time.monotonic() - before < 0.5:
            sys.exit(f"firmware: '{error}' came too early")
        board.expect_outputs(False, False)
        firmware.judge(good, good_told)
    firmware.send(good.lines[0][:9])
    firmware.expect(error="packet cut off")
    firmware.judge(short, short_told)
    firmware.send(packet("?"))
    firmware.expect(recipe="", features=5, frame_bytes=room["frame_bytes"])


def main():
    if sys.argv[1] == "recipe":
        fovea, file = map(Path, sys.argv[2:])
        with tempfile.TemporaryDirectory() as folder:
            make_files(tool_in(fovea.resolve(), folder))
            file.write_bytes((Path(folder) / "plate.bin").read_bytes())
        return
    name, program, fovea, *rest = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        board = Board(name, program, folder)
        try:
            firmware, inside = Firmware(board), "--recipe-inside" in rest
            drive(firmware, Path(fovea).resolve(), Path(folder), inside)
            stack = board.deepest_stack(program)
        finally:
            board.process.terminate()
    print(f"firmware: {name}: " + ("its recipe is inside" if inside else
                                   f"as the tool measures, {firmware.faults} faults told; {stack}"))


if __name__ == "__main__":
    main()
