#!/usr/bin/env python3
"""Every operator of the core that works on images is timed by tests/bench, or stands in tests/bench/without_line.txt.

A line that is added by the name of an entry of the catalogue times what that entry calls.

usage: bench.py [ROOT]     prints one line a finding and fails if there is one
"""
import re
import sys
from pathlib import Path

sys.dont_write_bytecode = True  # the tree stays as it is
from declarations import FOUNDATIONS, declared, interface_of, is_used, without_comments


def operators_of(header):
    """The functions that take an image."""
    text = without_comments(interface_of(header.read_text()))
    return [name for name in declared(text)
            if "::" not in name and re.search(rf"\b{name}\s*\([^;{{]*\bImageView\b", text)]


def entries_of(catalogue):
    """Name of an entry -> its text."""
    found = {}
    for path in sorted(catalogue.glob("*.hpp")):
        text = path.read_text()
        parts = re.split(r'\{"(\w+)",\s*(?=")', text)
        found.update(zip(parts[1::2], parts[2::2]))
        # Entries that a template makes of a function.
        found.update((name, function) for function, name in re.findall(r'_entry<([^>]*)>\(\s*"(\w+)"', text))
    return found


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[2]).resolve()
    include, bench = root / "core/include/fovea", root / "tests/bench"
    timed = "".join(without_comments(path.read_text()) for path in sorted(bench.rglob("*_bench.cpp")))
    entries = entries_of(include / "catalogue")
    for path in sorted(bench.rglob("*_bench.cpp")):
        for name in re.findall(r'add_operator\(\s*\w+,\s*"(\w+)"', path.read_text()):
            timed += " " + without_comments(entries.get(name, ""))
    lines = (bench / "without_line.txt").read_text().split("\n")
    excuses = dict((line.split(maxsplit=1) + [""])[:2] for line in lines if line and not line.startswith("#"))
    findings = [f"without_line.txt: no reason for {name}" for name, reason in excuses.items() if not reason]
    names = set()
    for header in sorted(include.rglob("*.hpp")):
        if header.parent.name in FOUNDATIONS:
            continue
        for name in operators_of(header):
            names.add(name)
            if name not in excuses and not is_used(name, timed):
                findings.append(f"{header.relative_to(include)}: no line of the bench for {name}")
            if name in excuses and is_used(name, timed):
                findings.append(f"without_line.txt: {name} has a line")
    findings += [f"without_line.txt: no operator is called {name}" for name in excuses if name not in names]
    if not names:
        findings.append("no operators found")
    print("\n".join(findings) if findings else f"bench: {len(names)} operators, all of them timed or excused")
    return 1 if findings else 0


sys.exit(main())
