#!/usr/bin/env python3
"""Reads what the test programs wrote about their run, counts, and lists the tests that were skipped.

Fails when there were no tests, or when one was skipped that tests/expected_skips.txt does not allow. Skipping is
allowed at all only while the folder of test pictures is absent.

usage: skips.py [--expected FILE] REPORT.xml|FOLDER...     of GoogleTest; a folder stands for the reports in it
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
    parser.add_argument("reports", nargs="+", type=Path)
    options = parser.parse_args()

    data = Path(os.environ.get("FOVEA_TEST_DATA") or project.parent / "shared/data")
    lines = [line for line in options.expected.read_text().split("\n") if line and not line.startswith("#")]
    allowed = [] if data.is_dir() else [line.split()[0] for line in lines]

    tests, skipped = 0, []
    for argument in options.reports:
        for report in sorted(argument.glob("*.xml")) if argument.is_dir() else [argument]:
            for test in xml.etree.ElementTree.parse(report).getroot().iter("testcase"):
                tests += 1
                # "skipped" is what a test says of itself, "suppressed" one whose name begins with DISABLED_.
                if test.get("status") != "run" or test.get("result") != "completed":
                    skipped.append(f"{test.get('classname')}.{test.get('name')}")
    wrong = [name for name in skipped if not any(fnmatch.fnmatchcase(name, pattern) for pattern in allowed)]
    for name in skipped:
        print(f"skipped{', and must not be' if name in wrong else ''}: {name}")
    print(f"{tests - len(skipped)} tests passed, {len(skipped)} skipped")
    if not tests:
        print("no tests were run")
    return 1 if wrong or not tests else 0


sys.exit(main())
