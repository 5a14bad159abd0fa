#!/usr/bin/env python3
"""Every text file of the project: no paths of one machine, no package registries, nothing put off, comments as they are to be.

usage: hygiene.py [ROOT]
"""
import re
import sys
from pathlib import Path

FORBIDDEN = {
    "a path of one machine": r"(?<![\w.])/(work|root|home|Users|mnt)/|\b[A-Z]:\\",
    "a package registry": r"\b(pypi|npmjs|crates|quay|ghcr|docker|conan|vcpkg)\.(org|com|io)\b|files\.pythonhosted|deb\.debian",
    "work put off": r"\b(TO[D]O|FIX[M]E|X[X]X)\b",
    "a conflict left over": r"^(<{7}|>{7}) ",
    "two fields of a docstring in one line": r"^\s*/// .*\S +(Shapes|Units|Rounding|Border|Overlap|Scratch|Errors|Source)  +\S",
    "a comment of more than 110 columns": r"^(?=.{111})\s*//.*",
}
NOT_OURS = {".git", "build", "out"}


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[2]).resolve()
    found = files = 0
    for path in sorted(root.rglob("*")):
        name = path.relative_to(root)
        if name.parts[0] in NOT_OURS or "__pycache__" in name.parts or not path.is_file():
            continue
        data = path.read_bytes()
        if b"\0" in data:
            continue
        files += 1
        for number, line in enumerate(data.decode("utf-8", "replace").split("\n"), 1):
            for what, pattern in FORBIDDEN.items():
                if hit := re.search(pattern, line):
                    print(f"{name}:{number}: {what}: {hit[0]}")
                    found += 1
    if found == 0:
        print(f"hygiene: {files} files, nothing to say")
    return 1 if found else 0


sys.exit(main())
