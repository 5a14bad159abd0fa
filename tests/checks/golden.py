#!/usr/bin/env python3
"""Golden vectors: every public function has one, and every processor computes the same.

usage: golden.py [--root ROOT]              each function in the Interface part of a core header is called by
                                            tests/golden/*_vectors.hpp or by an entry of the catalogue, or stands
                                            in tests/golden/without_vector.txt
       golden.py --table FILE [--seen FILE] COMMAND...
                                            the command prints the table in FILE; lines that begin with # are remarks;
                                            what it printed is left in the other file
"""
import argparse
import difflib
import fnmatch
import subprocess
import sys
from pathlib import Path

sys.dont_write_bytecode = True  # the tree stays as it is
from declarations import declared, interface_of, is_used, without_comments


def check_coverage(root):
    include = root / "core/include/fovea"
    # The catalogue's entries call their operators, and each of them is a vector.
    places = [*sorted((root / "tests/golden").glob("*.hpp")), *sorted((include / "catalogue").glob("*.hpp"))]
    vectors = "".join(without_comments(path.read_text()) for path in places)
    lines = [line for line in (root / "tests/golden/without_vector.txt").read_text().split("\n")
             if line and not line.startswith("#")]
    entries = [line.split(maxsplit=1) for line in lines]
    findings = [f"without_vector.txt: no reason for {entry[0]}" for entry in entries if len(entry) < 2]
    useful, count = set(), 0
    for header in sorted(include.rglob("*.hpp")):
        place = header.relative_to(include).as_posix()
        names = declared(without_comments(interface_of(header.read_text())))
        count += len(names)
        for name in names:
            excuses = {entry[0] for entry in entries if entry[0] == place or fnmatch.fnmatchcase(name, entry[0])}
            useful |= excuses
            if not excuses and not is_used(name, vectors):
                findings.append(f"{place}: no golden vector for {name}")
    findings += [f"without_vector.txt: nothing is called {entry[0]}" for entry in entries if entry[0] not in useful]
    if count == 0:
        findings.append("no public functions found")
    print("\n".join(findings) if findings else f"golden: {count} public functions, all of them in vectors or excused")
    return 1 if findings else 0


def check_table(table, command, seen):
    expected = [line for line in Path(table).read_text().split("\n") if line and not line.startswith("#")]
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode != 0:
        print(f"golden: {' '.join(command)} ended with {run.returncode}\n{run.stderr}")
        return 1
    printed = [line for line in run.stdout.split("\n")[:-1] if not line.startswith("#")]
    remarks = [line[2:] for line in run.stdout.split("\n") if line.startswith("# ")]
    if seen:
        seen.parent.mkdir(parents=True, exist_ok=True)
        seen.write_text("".join(f"{line}\n" for line in printed))
    different = [line for line in difflib.unified_diff(expected, printed, table, "computed here", n=0, lineterm="")]
    print("\n".join(different) if different else "; ".join([f"golden: {len(printed)} lines as in the table", *remarks]))
    if different:
        print("golden: the bits differ")
    return 1 if different or not printed else 0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--root", type=Path, default=Path(__file__).parents[2])
    parser.add_argument("--table")
    parser.add_argument("--seen", type=Path)
    parser.add_argument("command", nargs=argparse.REMAINDER)
    options = parser.parse_args()
    return check_table(options.table, options.command, options.seen) if options.table else check_coverage(options.root)


if __name__ == "__main__":
    sys.exit(main())
