#!/usr/bin/env python3
"""A chip's golden vectors and costs: runs a golden program on an emulated board.

usage: chip.py LANE BOARD PROGRAM PLUGIN [--write [--because REASON]] [--golden FILE] [--tables FOLDER]
               [--seen FILE]

A cost has a line "= NAME" of the program, or "=N NAME" if it was counted in N parts. The golden vectors must be those of tests/golden/golden.txt, and the instructions that operators take those of
tests/target/instructions/LANE.txt, to the last one. --write puts the counts as they are now into that file; where one
has grown it wants the reason, and adds it to tests/target/instructions/grown.txt.
"""
import argparse
import subprocess
import sys
import tempfile
from itertools import accumulate
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]


def run(board, program, plugin):
    """(golden lines, {cost: instructions}, remarks)"""
    with tempfile.TemporaryDirectory() as folder:
        counts = Path(folder) / "counts"
        command = [TESTS / "target/emulate", board, program, "-plugin", f"{plugin},out={counts}"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"chip: {program} on {board} ended with {done.returncode}\n{done.stdout[-2000:]}{done.stderr}")
        regions = [int(line) for line in counts.read_text().split()]
    lines = done.stdout.splitlines()
    names = [line[1:].split(" ", 1) for line in lines if line.startswith("=")]
    counts = [int(count or 1) for count, _ in names]
    if sum(counts) != len(regions) or not names:
        sys.exit(f"chip: names of {sum(counts)} costs, but {len(regions)} were counted")
    ends = list(accumulate(counts))
    costs = {name: sum(regions[end - count:end]) for (_, name), count, end in zip(names, counts, ends)}
    golden = [line for line in lines if not line.startswith(("=", "# "))]
    return golden, costs, [line[2:] for line in lines if line.startswith("# ")]


def read_table(path):
    lines = path.read_text().splitlines() if path.exists() else []
    rows = [line.split(maxsplit=1) for line in lines if line and not line.startswith("#")]
    return {name: int(count) for count, name in rows}


def main():
    parser = argparse.ArgumentParser()
    for argument in ("lane", "board", "program", "plugin"):
        parser.add_argument(argument)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--because")
    parser.add_argument("--golden", type=Path, default=TESTS / "golden/golden.txt")
    parser.add_argument("--seen", type=Path, help="where the golden vectors are left")
    parser.add_argument("--tables", type=Path, default=TESTS / "target/instructions")
    options = parser.parse_args()

    golden, costs, remarks = run(options.board, options.program, options.plugin)
    if options.seen:
        options.seen.parent.mkdir(parents=True, exist_ok=True)
        options.seen.write_text("".join(f"{line}\n" for line in golden))
    expected = options.golden.read_text().splitlines()
    wrong = [line for line in golden if line not in expected] + [line for line in expected if line not in golden]
    if wrong or len(golden) != len(expected):
        sys.exit("\n".join(wrong + [f"chip: {options.lane} computes other bits than {options.golden.name}"]))

    path = options.tables / f"{options.lane}.txt"
    before = read_table(path)
    grown = [name for name in costs if name in before and costs[name] > before[name]]
    if options.write:
        if grown and not options.because:
            sys.exit("\n".join(f"{before[n]} -> {costs[n]} {n}" for n in grown) + "\nchip: these have grown: --because REASON")
        path.parent.mkdir(exist_ok=True)
        path.write_text("# Instructions for a picture of 320x240 or of the size in the name; of geometry for all calls.\n" + "".join(f"{costs[n]} {n}\n" for n in costs))
        if grown:
            with (options.tables / "grown.txt").open("a") as file:
                file.writelines(f"{options.lane}: {n} {before[n]} -> {costs[n]}: {options.because}\n" for n in grown)
    elif costs != before:
        for name in sorted(costs.keys() | before.keys()):
            if costs.get(name) != before.get(name):
                print(f"{before.get(name, 'none')} -> {costs.get(name, 'none')} {name}")
        sys.exit(f"chip: {options.lane} takes other numbers of instructions than {path.name} says: "
                 "tests/target/chip.py --write, with --because where one has grown")
    print(f"chip: {options.lane}: {len(golden)} checksums and {len(costs)} costs as in the tables; {'; '.join(remarks)}")


if __name__ == "__main__":
    main()
