#!/usr/bin/env python3
"""Reads from the compiler's notes (-fstack-usage) that no function takes more stack than it may.

2048 bytes is the cap: a chip with 16 KiB of memory can spare that much for one function, not more. A function above
it stands in the budget, one a line: most bytes, name, reason. A frame whose size the compiler does not know is never
allowed.

usage: stack.py [--budget FILE] [--whole] FILE.su|FOLDER...
    a folder stands for the notes below it; --whole: they are of all functions of the core, so that what the budget has
    for none of them must leave it
"""
import argparse
import re
import sys
from pathlib import Path

CAP = 2048


def read_budget(path):
    """Name -> most bytes."""
    lines = [line for line in path.read_text().split("\n") if line and not line.startswith("#")]
    budget = {}
    for line in lines:
        words = line.split(maxsplit=2)
        if len(words) < 3:
            sys.exit(f"stack: {path}: bytes, name and reason are wanted: {line}")
        budget[words[1]] = int(words[0])
    return budget


def main():
    project = Path(__file__).parents[2]
    parser = argparse.ArgumentParser()
    parser.add_argument("--budget", type=Path, default=project / "tests/target/stack_budget.txt")
    parser.add_argument("--whole", action="store_true")
    parser.add_argument("notes", nargs="+", type=Path)
    options = parser.parse_args()

    notes = []
    for argument in options.notes:
        notes += sorted(argument.rglob("*.su")) if argument.is_dir() else [argument]
    budget, used = read_budget(options.budget), set()
    findings, frames = set(), 0
    for note in notes:
        for line in note.read_text().splitlines():
            place, size, kind = line.split("\t")
            # file:line:column:signature
            signature = place.split(":", 3)[3]
            name = re.sub(r"\[with .*|\(.*", "", signature).split()[-1].split("::")[-1]
            frames += 1
            if kind == "dynamic":
                findings.add(f"a frame of unknown size: {signature}")
            if int(size) > CAP:
                used.add(name)
                if int(size) > budget.get(name, CAP):
                    findings.add(f"{size} bytes, at most {budget.get(name, CAP)}: {signature}")
    if options.whole:
        findings |= {f"{name} stands in the budget and needs no more than {CAP} bytes" for name in set(budget) - used}
    if frames == 0:
        findings.add("no notes of the compiler")
    print("\n".join(sorted(findings)) if findings else f"stack: {frames} functions take {CAP} bytes at most, or their budget")
    return 1 if findings else 0


sys.exit(main())
