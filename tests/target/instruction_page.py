#!/usr/bin/env python3
"""Prints docs/instructions.md from the tables of tests/target/instructions and openmv.txt."""
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
PIXELS = 320 * 240
LANES = {  # table: title of its column
    "cortex-m0": "M0", "cortex-m0-clang": "M0 Clang", "cortex-m3": "M3", "cortex-m4": "M4", "cortex-m7": "M7",
    "cortex-m7-clang": "M7 Clang", "cortex-m33": "M33", "cortex-m55": "M55", "cortex-m55-clang": "M55 Clang",
    "rv32imac": "RV32",
}


def read(lane):
    lines = (FOLDER / f"instructions/{lane}.txt").read_text().splitlines()
    rows = [line.split(maxsplit=1) for line in lines if not line.startswith("#")]
    return {name: int(count) / PIXELS for count, name in rows}


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
    print("\n## All\n")
    print("| | " + " | ".join(LANES.values()) + " |")
    print("|---" * (len(LANES) + 1) + "|")
    for name in tables["cortex-m0"]:
        print(f"| {name} | " + " | ".join(number(tables[lane][name]) for lane in LANES) + " |")


if __name__ == "__main__":
    main()
