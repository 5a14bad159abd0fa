#!/usr/bin/env python3
"""Counts the instructions that readers of codes execute and prints docs/code_work.md.

usage: code_work.py PROGRAM PLUGIN    code_work.cpp compiled for this machine, and count_instructions.cpp

Fails where read_codes() takes more than MOST times as many for a picture that is made to keep it busy as for the
median of ordinary pictures, half of which hold no code; where it reads nothing from an ordinary picture with a code; or
something from one without.
"""
import collections
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

MOST = 5


def measure(program, plugin):
    """Of every reader, its regions: kind, picture, codes read, instructions in millions."""
    with tempfile.TemporaryDirectory() as folder:
        counts = Path(folder) / "counts"
        seen = subprocess.run(["qemu-x86_64", "-plugin", f"{plugin},out={counts}", program], check=True, text=True,
                              stdout=subprocess.PIPE).stdout.splitlines()
        executed = [int(line) / 1e6 for line in counts.read_text().splitlines()]
    if not seen or len(seen) != len(executed):
        sys.exit(f"code_work: {len(seen)} regions were told and {len(executed)} counted")
    readers = collections.defaultdict(list)
    for line, millions in zip(seen, executed):
        kind, picture, reader, codes = line.split()
        readers[reader].append((kind, picture, int(codes), millions))
    return readers


def family(picture):
    return picture.rstrip("0123456789_").replace("_", " ")


def main():
    readers = measure(*sys.argv[1:])
    print("""# Work of readers of codes

Made by `tests/target/code_work.py`, which `tests/run target` runs and compares. Millions of instructions for a picture of
320x240, GCC -O2 for x86-64 without vectors beyond SSE2, counted exactly under QEMU. `read_codes` as it is called without
options: thorough, all symbologies, up to 32 codes. What is ordinary, and what the bound means: [Reading codes](codes.md).

| reader | ordinary, median | with a code | without a code | busy, most | times the median |
|---|---|---|---|---|---|""")
    for reader, rows in readers.items():
        of = {kind: [row[3] for row in rows if row[0] == kind] for kind in ("with", "without", "busy")}
        ordinary = statistics.median(of["with"] + of["without"])
        most = max(of["busy"])
        print(f"| `{reader}` | {ordinary:.0f} | {statistics.median(of['with']):.0f} | {statistics.median(of['without']):.0f} "
              f"| {most:.0f} | {most / ordinary:.1f} |")
    print("""
The most that a picture of each family takes:

| family | """ + " | ".join(f"`{reader}`" for reader in readers) + " |\n|---|" + "---|" * len(readers))
    for name in dict.fromkeys(family(row[1]) for row in readers["read_codes"] if row[0] == "busy"):
        most = [max(row[3] for row in rows if row[0] == "busy" and family(row[1]) == name) for rows in readers.values()]
        print(f"| {name} | " + " | ".join(f"{count:.0f}" for count in most) + " |")

    faults = []
    rows = readers["read_codes"]
    ordinary = statistics.median(row[3] for row in rows if row[0] != "busy")
    for kind, picture, codes, millions in rows:
        if kind == "busy" and millions > MOST * ordinary:
            faults.append(f"{picture}: {millions:.0f} million instructions are more than {MOST} times {ordinary:.0f}")
        if kind != "busy" and codes != (kind == "with"):
            faults.append(f"{picture}: {codes} codes were read")
    print("\n".join(faults), file=sys.stderr, end="\n" if faults else "")
    return 1 if faults else 0


sys.exit(main())
