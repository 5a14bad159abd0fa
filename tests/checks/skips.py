#!/usr/bin/env python3
"""Reads what ctest wrote about a run, counts, and lists the tests that were skipped.

Fails when there were no tests, or when one was skipped that tests/expected_skips.txt does not allow. Skipping is
allowed at all only while the folder of test pictures is absent.

usage: skips.py [--expected FILE] JUNIT.xml
"""
import argparse
import fnmatch
import os
import sys
import xml.etree.ElementTree
from pathlib import Path


def main():
    project = Path(__file__).parents[2]
    parser = argparse.ArgumentParser()
    parser.add_argument("--expected", type=Path, default=project / "tests/expected_skips.txt")
    parser.add_argument("junit")
    options = parser.parse_args()

    data = Path(os.environ.get("FOVEA_TEST_DATA") or project.parent / "shared/data")
    lines = [line for line in options.expected.read_text().split("\n") if line and not line.startswith("#")]
    allowed = [] if data.is_dir() else [line.split()[0] for line in lines]

    tests = xml.etree.ElementTree.parse(options.junit).getroot().findall("testcase")
    skipped = [test.get("name") for test in tests if test.get("status") in ("notrun", "disabled")]
    wrong = [name for name in skipped if not any(fnmatch.fnmatchcase(name, pattern) for pattern in allowed)]
    for name in skipped:
        print(f"skipped{', and must not be' if name in wrong else ''}: {name}")
    print(f"{len(tests) - len(skipped)} tests passed, {len(skipped)} skipped")
    if not tests:
        print("no tests were run")
    return 1 if wrong or not tests else 0


sys.exit(main())
