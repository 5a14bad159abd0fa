#!/usr/bin/env python3
"""What docs/inventory.md says is there: headers, test files, and tests by their names.

usage: inventory.py [ROOT]     prints one line a finding and fails if there is one
"""
import re
import sys
from pathlib import Path


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[2]).resolve()
    named = re.findall(r"^TEST(?:_[FP])?\((\w+),\s*(\w+)\)", "\n".join(
        path.read_text() for path in sorted((root / "tests").rglob("*_test.cpp"))), re.M)
    tests = {f"{suite}.{name}" for suite, name in named}
    findings, words = [], 0
    for number, line in enumerate((root / "docs/inventory.md").read_text().split("\n"), 1):
        if not line.startswith("| "):
            continue
        for word in re.findall(r"`([^`]+)`", line):
            if re.fullmatch(r"[\w/]+\.hpp", word):
                found = (root / "core/include/fovea" / word).exists()
            elif re.fullmatch(r"[\w/]+_test\.cpp", word):
                found = (root / "tests/core" / word).exists()
            elif re.fullmatch(r"[A-Z]\w*\.[A-Z]\w*", word):
                found = word in tests
            else:
                continue
            words += 1
            if not found:
                findings.append(f"docs/inventory.md:{number}: there is no {word}")
    if not words:
        findings.append("docs/inventory.md names nothing")
    print("\n".join(findings) if findings else f"inventory: {words} headers and tests are there")
    return 1 if findings else 0


sys.exit(main())
