#!/usr/bin/env python3
"""Drives firmware_read on an emulated board from outside: firmware_read.py BOARD PROGRAM FOVEA [--allowed-inside]

    firmware_read.py allowed FILE     writes the list of texts that a program has inside for --allowed-inside

The tool FOVEA draws codes; as frames they go over the serial line, scaled, turned, upside down, damaged and without any.
What the board tells of a code must be what the tool reads in the same picture, the pins must show the verdict, and the
memory of the program must be no more than tests/target/memory_budget.txt grants it.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from firmware import Firmware, Frame, begin, line, packet, read_pgm, with_a_wrong_bit
from pins import Board, address_of

BUDGET = Path(__file__).resolve().parent / "memory_budget.txt"
NOTHING = "nothing found"
ALLOWED = ["9780905705712", "55123457"]


class Picture:
    """Rows of pixels; the ground is light."""

    def __init__(self, width, height, ground=255):
        self.rows = [bytearray([ground]) * width for _ in range(height)]

    def put(self, code, x, y):
        for row, pixels in enumerate(code.rows):
            self.rows[y + row][x:x + len(pixels)] = pixels
        return self

    def fill(self, x, y, width, height, level):
        for row in self.rows[y:y + height]:
            row[x:x + width] = bytes([level]) * len(row[x:x + width])
        return self

    def turned(self, quarters):
        """Clockwise."""
        rows = self.rows
        for _ in range(quarters):
            rows = [bytearray(column) for column in zip(*reversed(rows))]
        turned = Picture(0, 0)
        turned.rows = rows
        return turned

    def frame(self):
        return Frame(len(self.rows[0]), len(self.rows), b"".join(self.rows))

    def save(self, path):
        path.write_bytes(b"P5\n%d %d\n255\n" % (len(self.rows[0]), len(self.rows)) + b"".join(self.rows))


class Noise(Picture):
    def __init__(self, width, height):
        super().__init__(width, height)
        number = 1
        for row in self.rows:
            for x in range(width):
                number = number * 1103515245 + 12345 & 0x7FFFFFFF
                row[x] = number >> 16 & 255


class Reader(Firmware):
    def __init__(self, board, fovea, folder):
        super().__init__(board)
        self.fovea, self.folder, self.frames = fovea, folder, 0

    def tool(self, *words):
        return subprocess.run([self.fovea, *words], cwd=self.folder, capture_output=True, text=True).stdout

    def code(self, text, symbology="qr", module=3, **options):
        words = [word for name, value in options.items() for word in ([f"--{name}"] if value is None else [f"--{name}", str(value)])]
        self.tool("make-code", "--out", "code.pgm", "--symbology", symbology, "--module", str(module), *words, "--", text)
        width, height, pixels = read_pgm(self.folder / "code.pgm")
        code = Picture(0, 0)
        code.rows = [bytearray(pixels[y * width:][:width]) for y in range(height)]
        return code

    def told_by_tool(self, picture, symbologies):
        """What the tool reads, without what boards do not repeat."""
        picture.save(self.folder / "frame.pgm")
        told = []
        for text in self.tool("read", "--json", "--quick", "--symbology", symbologies, "frame.pgm").splitlines():
            told.append({key: value for key, value in json.loads(text).items()
                         if key not in ("schema", "image", "code", "bytes_hex")})
        return told

    def read(self, name, picture, verdict="ok", reason=None):
        """The codes that the board tells of a frame."""
        number = self.arm()
        self.send(picture.frame().all())
        heard = self.hear()
        self.frames += 1
        if (heard.get("frame"), heard.get("verdict"), heard.get("reason")) != (number, verdict, reason):
            sys.exit(f"firmware_read: {name}: {verdict}, {reason} was expected, {heard} came")
        self.board.expect_outputs(verdict == "ok", verdict == "not_ok")
        return heard["codes"]

    def refuse(self, name, sent, error):
        """What is sent behind a trigger, and the error that it must be answered with."""
        number = self.arm()
        self.send(sent)
        heard = self.hear()
        if (heard.get("frame"), heard.get("error"), heard.get("verdict")) != (number, error, "unmeasured"):
            sys.exit(f"firmware_read: {name}: '{error}' was expected, {heard} came")
        self.board.expect_outputs(False, False)

    def refuse_faults(self, good, faults):
        """Between good frames, which must be read as before."""
        wanted = self.read("a good frame", good)
        for name, sent, error in faults:
            self.refuse(name, sent, error)
            if self.read(f"after {name}", good) != wanted:
                sys.exit(f"firmware_read: after {name} the board reads otherwise")

    def compare(self, name, picture, symbologies, count, keys=None):
        """A frame in which the tool reads so many codes: the board must tell the same of them, or of these keys."""
        wanted = self.told_by_tool(picture, symbologies)
        if len(wanted) != count:
            sys.exit(f"firmware_read: {name}: the tool reads {wanted}")
        heard = self.read(name, picture)
        cut = [[{key: code[key] for key in keys or wanted[0]} for code in codes] for codes in (heard, wanted)]
        if cut[0] != cut[1]:
            sys.exit(f"firmware_read: {name}: the tool reads {cut[1]}, the board {cut[0]}")
        return heard


def read_bars(reader, whole):
    """Codes in a few lines, up to 640 pixels wide; what a serial line in an emulator takes is time."""
    def bars(text, symbology="ean-13", module=2):
        return reader.code(text, symbology, module, height=8 // module, quiet=0)

    def at(code, width=240, x=24):
        return Picture(width, len(code.rows)).put(code, x, 0)

    def compare(name, picture, count=1):
        heard = reader.compare(name, picture, "retail", count, ("symbology", "text", "aim", "inverted", "mirrored"))
        if not all(code["agreeing_lines"] >= 2 for code in heard):
            sys.exit(f"firmware_read: {name}: too few lines agree: {heard}")

    ean = bars(ALLOWED[0])
    compare("EAN-13 in lines of 640", at(bars(ALLOWED[0], module=4), 640, 200))
    compare("upside down", at(ean.turned(2)))
    reader.read("nothing", Picture(640, 4), "not_ok", NOTHING)
    reader.read("bars overpainted in all lines", at(ean).fill(70, 0, 20, 8, 255), "not_ok", NOTHING)
    if not whole:
        return
    for text, symbology in ((ALLOWED[1], "ean-8"), ("036000291452", "upc-a"), ("01234565", "upc-e")):
        compare(symbology, at(bars(text, symbology)))
    compare("two codes", at(ean, 440).put(bars("96385074", "ean-8"), 270, 0), 2)
    compare("a spot on some lines", at(ean).fill(100, 0, 60, 2, 255))
    reader.read("noise", Noise(240, 8), "not_ok", NOTHING)
    reader.read("a code of another kind", at(bars("FOVEA 42", "code-128"), 400), "not_ok", NOTHING)
    one = at(ean)
    one.rows = one.rows[:2]
    reader.read("one line that is looked at", one, "not_ok", "undecided")
    crowd = Picture(560, 8)
    for i, text in enumerate((ALLOWED[1], "96385074", "40170725")):
        crowd.put(bars(text, "ean-8"), 24 + 176 * i, 0)
    reader.refuse("three codes", crowd.frame().all(), "more entries than the list can hold")
    good = at(ean)
    frame = good.frame()
    reader.refuse_faults(good, [
        ("a line with a wrong bit", frame.begin + frame.lines[0] + with_a_wrong_bit(Noise(240, 2).frame().lines[1]), "packet damaged"),
        ("a line that is missing", frame.begin + frame.lines[0] + frame.lines[2], "line missing"),
        ("a line that is too short", frame.begin + line(0, bytes(frame.width - 1)), "line of a wrong length"),
        ("lines that are too long", frame.begin + b"".join(line(y, bytes(frame.width + 1)) for y in range(3)), "packet too long"),
        ("a frame that is too wide", begin(641, 2) + line(0, bytes(641)) + line(1, bytes(641)), "frame too large"),
        ("a frame that is too narrow", begin(31, 2), "frame too narrow"),
        ("a recipe", packet("R", b"FVRC"), "packet of an unknown kind"),
        ("a last line that does not come", frame.begin + b"".join(frame.lines[:-1]), "line too late")])


def read_qr(reader, whole):
    """Symbols with their quiet zone as frames; one of 320x240."""
    texts = {1: "fovea", 2: "fovea reads here", 3: "fovea reads QR codes on a chip alone",
             4: "fovea reads QR codes on a chip, line after line, and more", 5: "https://fovea.example/" + "a1" * 29,
             6: "P/N 4711 \u00e4\u00f6\u00fc\\n" + "ab cd ef gh ij kl mn op qr st uv wx yz 0123456789 ab cd ef gh ij kl mn op"}
    symbols = {version: reader.code(text, module=2) for version, text in texts.items()}
    if [len(symbol.rows) for symbol in symbols.values()] != [2 * (4 * version + 25) for version in texts]:
        sys.exit("firmware_read: the symbols are not of versions 1 to 6")
    strong = reader.code("fovea mends", level="H", module=2)
    reader.compare("version 1", symbols[1], "qr", 1)
    reader.read("a symbol that is damaged", Picture(66, 66).put(strong, 0, 0).fill(24, 24, 26, 26, 128), "not_ok", NOTHING)
    if not whole:
        large = reader.code(texts[6], module=4)
        reader.compare("version 6 in 320x240, upside down", Picture(320, 240).put(large, 60, 20).turned(2), "qr", 1)
        return
    for version, symbol in symbols.items():
        reader.compare(f"version {version}, {90 * (version % 4)} degrees", symbol.turned(version % 4), "qr", 1)
    reader.compare("light on dark", reader.code('"on" \\\\ 1', module=2, inverted=None), "qr", 1)
    reader.compare("two symbols", Picture(128, 66).put(symbols[1], 0, 0).put(strong, 62, 0), "qr", 2)
    crowd = Picture(190, 66).put(symbols[1], 0, 0).put(strong, 62, 0).put(reader.code("third", module=2), 124, 0)
    reader.refuse("three symbols", crowd.frame().all(), "more entries than the list can hold")
    mended = reader.compare("a spot that is mended", Picture(66, 66).put(strong, 0, 0).fill(34, 30, 6, 6, 255), "qr", 1)
    if mended[0]["corrected_errors"] == 0:
        sys.exit("firmware_read: there was nothing to mend")
    reader.read("nothing", Picture(70, 66), "not_ok", NOTHING)
    reader.read("noise", Noise(90, 80), "not_ok", NOTHING)
    seven = reader.code("abcdefghijklmnop" * 7, module=2)
    if len(seven.rows) != 106 or len(reader.told_by_tool(seven, "qr")) != 1:
        sys.exit("firmware_read: the tool does not read version 7")
    reader.read("version 7", seven, "not_ok", NOTHING)
    frame = symbols[1].frame()
    reader.refuse_faults(symbols[1], [("a frame that is too large", begin(320, 241), "frame too large"),
                                      ("a line that is missing", frame.begin + frame.lines[1], "line missing")])


def read_allowed(reader):
    """A program that has a list inside."""
    def at(text, symbology, x=24):
        return Picture(440, 8).put(reader.code(text, symbology, 2, height=4, quiet=0), x, 0)

    for text, symbology, verdict in ((ALLOWED[0], "ean-13", "ok"), ("4006381333931", "ean-13", "not_ok"), (ALLOWED[1], "ean-8", "ok")):
        heard = reader.read(f"{text} of a list", at(text, symbology), verdict)
        if [(code["text"], code["verdict"]) for code in heard] != [(text, verdict)]:
            sys.exit(f"firmware_read: {text} of a list: {heard}")
    both = at(ALLOWED[1], "ean-8").put(reader.code("96385074", "ean-8", 2, height=4, quiet=0), 230, 0)
    heard = reader.read("one that is allowed and one that is not", both, "not_ok")
    if sorted(code["verdict"] for code in heard) != ["not_ok", "ok"]:
        sys.exit(f"firmware_read: one that is allowed and one that is not: {heard}")
    reader.read("nothing", Picture(440, 4), "not_ok", NOTHING)


def check_memory(program):
    """All RAM that it has: its stack, and what is behind."""
    taken = address_of(program, "fovea_bss_end") - address_of(program, "fovea_stack_limit")
    granted = {name: int(most) for most, name in (text.split()[:2] for text in BUDGET.read_text().splitlines() if text[:1] not in ("#", ""))}
    if taken > granted.get(program.name, 0):
        sys.exit(f"firmware_read: {program.name} takes {taken} bytes of memory, {BUDGET.name} grants it {granted.get(program.name)}")
    return f"{taken} bytes of memory"


def main():
    if sys.argv[1] == "allowed":
        Path(sys.argv[2]).write_text("".join(f"{text}\r\n" for text in ALLOWED))
        return
    name, program, fovea, *rest = sys.argv[1:]
    memory = check_memory(Path(program))
    with tempfile.TemporaryDirectory() as folder:
        board = Board(name, program, folder)
        try:
            reader = Reader(board, Path(fovea).resolve(), Path(folder))
            inside = "--allowed-inside" in rest
            state = reader.expect(board=name, allowed=len(ALLOWED) if inside else None)
            board.expect_outputs(False, False)
            if inside:
                read_allowed(reader)
            elif state["reads"] == "bars":
                read_bars(reader, whole=name == "microbit")
            else:
                read_qr(reader, whole=name == "mps2_an386")
            stack = board.deepest_stack(program)
        finally:
            board.process.terminate()
    print(f"firmware_read: {name}: {state['reads']}: {reader.frames} frames as the tool reads them, {reader.faults} faults told; "
          f"{memory}; {stack}")


if __name__ == "__main__":
    main()
