#!/usr/bin/env python3
"""Prints docs/instructions.md from the tables of tests/target/instructions and openmv.txt, and docs/memory.md."""
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
MEMORY = FOLDER.parents[1] / "docs/memory.md"
PIXELS = 320 * 240
LANES = {  # table: title of its column
    "cortex-m0": "M0", "cortex-m0-clang": "M0 Clang", "cortex-m3": "M3", "cortex-m4": "M4", "cortex-m7": "M7",
    "cortex-m7-clang": "M7 Clang", "cortex-m33": "M33", "cortex-m55": "M55", "cortex-m55-clang": "M55 Clang",
    "rv32imac": "RV32",
}


def counts(table):
    lines = (FOLDER / f"instructions/{table}.txt").read_text().splitlines()
    rows = [line.split(maxsplit=1) for line in lines if not line.startswith("#")]
    return {name: int(count) for count, name in rows}


def read(lane):
    return {name: count / PIXELS for name, count in counts(lane).items()}


def memory():
    """Of every operator that the page of memory names: flash and stack on M0 and M4, and scratch, as it writes them."""
    rooms, chips = MEMORY.read_text().split("## On chips")

    def rows(text):
        cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines()]
        return [row for row in cells if len(row) == 5 and row[1].isdigit()]

    scratch = {name: row[2] for row in rows(rooms) for name in row[0].split(", ")}
    return {row[0]: row[1:] + [scratch[row[0]]] for row in rows(chips) if row[0] in scratch}


def number(value):
    return f"{value:.2f}" if value < 100 else f"{value:.0f}"


def main():
    tables = {lane: read(lane) for lane in LANES}
    print("""# Instructions on chips

Made by `tests/target/instruction_page.py`. How many instructions a processor executes for one pixel, for pictures of
320x240, counted exactly on emulated boards (`tests/target/count_instructions.cpp`); `tests/run target` compares every
count. Instructions are no time: flash that waits, caches and instructions that take more than a cycle are not in them.

GCC 12.2 and Clang 14, -O2, without floats; M0 by -Os, M4 by -O3, and GCC without its vectorizer of straight
code but for the M7. Parameters are the presets of `fovea ops`. Four discs with noise of 16 levels are the picture.

## Beside OpenMV

OpenMV's imlib on the same emulated boards, same size, GCC -O2 (`tests/target/openmv.txt`), on the M7 and the M55. A
ratio is theirs over ours with GCC; above 1 we take fewer.
""")
    print("| OpenMV | ours | M7: theirs | ours | ratio | M55: theirs | ours | ours, Clang | ratio |")
    print("|---|---|---|---|---|---|---|---|---|")
    ratios = {"cortex-m7": [], "cortex-m55": []}
    for line in (FOLDER / "openmv.txt").read_text().splitlines():
        if line.startswith("#"):
            continue
        figures, rows, title = [part.strip() for part in line.split("|")]
        m7, m55 = map(float, figures.split())
        ours = {lane: sum(tables[lane][row] for row in rows.split(" + ")) for lane in LANES}
        ratios["cortex-m7"].append(m7 / ours["cortex-m7"])
        ratios["cortex-m55"].append(m55 / ours["cortex-m55"])
        print(f"| {title} | {rows} | {m7} | {number(ours['cortex-m7'])} | {m7 / ours['cortex-m7']:.1f} | {m55} "
              f"| {number(ours['cortex-m55'])} | {number(ours['cortex-m55-clang'])} | {m55 / ours['cortex-m55']:.1f} |")
    for lane, wanted in (("cortex-m7", 2), ("cortex-m55", 4)):
        met = sum(ratio >= wanted for ratio in ratios[lane])
        print(f"\n{LANES[lane]}: {met} of {len(ratios[lane])} by {wanted} times or more"
              f"{'; fewest ' if met < len(ratios[lane]) else '; least '}{min(ratios[lane]):.1f}.")
    print("""
## All

Behind the counts the bytes that an operator takes: flash and the deepest stack on M0 and M4, each compiled by -Os in a
program that has no other, and scratch for 320x240 (`docs/memory.md`, which also has other sizes).
""")
    needs = ("flash M0", "stack M0", "flash M4", "stack M4", "scratch")
    print("| | " + " | ".join((*LANES.values(), *needs)) + " |")
    print("|---" * (len(LANES) + len(needs) + 1) + "|")
    bytes_of = memory()
    for name in tables["cortex-m0"]:
        cells = [number(tables[lane][name]) for lane in LANES]
        print(f"| {name} | " + " | ".join(cells + bytes_of.get(name, [""] * len(needs))) + " |")
    print("""
## Codes in frames

Millions of instructions for a frame, counted in the jobs of [firmware that reads codes](codes.md#on-a-chip) as it is compiled
there, by -Os: all lines taken, those of bars read, every other one of them, or the whole frame. What the serial line takes is
not in them. Frames have noise of 16 levels; the lines of noise have nothing else.
""")
    codes = {lane: counts(f"codes-{lane}") for lane in ("cortex-m4", "cortex-m7")}
    print("| | " + " | ".join(LANES[lane] for lane in codes) + " |")
    print("|---" * (len(codes) + 1) + "|")
    for name in codes["cortex-m4"]:
        print(f"| {name} | " + " | ".join(f"{table[name] / 1e6:.2f}" for table in codes.values()) + " |")
    print("""
## Numbers and geometry

Instructions for a call, with [`Real`](operators/foundations.md#numbers), compiled by -Os; of numbers the mean of 256 calls, with the loop
around them.
""")
    geometry = {lane: {**counts(f"geometry-{lane}"), **counts(f"calibration-{lane}")}
                for lane in ("cortex-m0", "cortex-m4", "rv32imac")}
    print("| | " + " | ".join(LANES[lane] for lane in geometry) + " |")
    print("|---" * (len(geometry) + 1) + "|")
    names = list(geometry["cortex-m0"])
    for name in names:
        calls = 256 if names.index(name) < names.index("solve_ldlt, 8 unknowns") else 1
        print(f"| {name} | " + " | ".join(number(table[name] / calls) if calls > 1 else str(table[name])
                                          for table in geometry.values()) + " |")


if __name__ == "__main__":
    main()
