#!/usr/bin/env python3
"""Runs the test programs of a build, as many processes at a time as there are processors.

ctest runs every test as a process of its own: a thousand starts, which cost more than many of the tests where
sanitizers are on. Here ctest only says which programs there are, and each is run in as many shards as there are
processors, so that a long program does not run alone at the end. A program fails when a shard ends with another code
than 0, runs for longer than it may, or leaves no report; then the whole output of the shard is shown.

usage: programs.py [--seconds N] BUILD_FOLDER [NAME...]     all programs that ctest knows, or those of these names; the
                                                            reports lie in BUILD_FOLDER/reports
"""
import argparse
import json
import os
import shutil
import signal
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

# Of a shard: on two processors the slowest takes a tenth of it with sanitizers.
PATIENCE_SECONDS = 600


def programs_of(build):
    """The programs behind the tests of ctest."""
    listed = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], check=True, capture_output=True, text=True)
    programs = set()
    for test in json.loads(listed.stdout)["tests"]:
        if "command" not in test:
            sys.exit(f"programs: {test['name']}: not built")
        programs.add(Path(test["command"][0]))
    return programs


def complaint_about(program, shard, shards, report, seconds):
    """Runs one shard: what is wrong with its end, and its output."""
    environment = {**os.environ, "GTEST_TOTAL_SHARDS": str(shards), "GTEST_SHARD_INDEX": str(shard)}
    # As a group, so that a program which hangs takes along what it started.
    process = subprocess.Popen([program, f"--gtest_output=xml:{report}"], cwd=program.parent, env=environment,
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                               errors="replace", start_new_session=True)
    try:
        output, _ = process.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        return f"ran for more than {seconds:g} s", process.communicate()[0]
    if process.returncode != 0:
        return f"ended with {process.returncode}", output
    return (None if report.exists() else "left no report"), output


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--seconds", type=float, default=PATIENCE_SECONDS)
    parser.add_argument("build", type=Path)
    parser.add_argument("names", nargs="*")
    options = parser.parse_args()
    build, shards = options.build.resolve(), os.cpu_count()

    programs = {build / "tests" / name for name in options.names} or programs_of(build)
    reports = build / "reports"
    shutil.rmtree(reports, ignore_errors=True)
    failed = set()
    with ThreadPoolExecutor(shards) as pool:
        runs = [(program, pool.submit(complaint_about, program, shard, shards, reports / f"{program.name}-{shard}.xml",
                                      options.seconds))
                for program in sorted(programs) for shard in range(shards)]
        for program, run in runs:
            complaint, output = run.result()
            if complaint:
                print(f"{output}programs: {program.name} {complaint}")
                failed.add(program)
    print(f"{len(programs) - len(failed)} programs passed, {len(failed)} failed")
    return 1 if failed or not programs else 0


sys.exit(main())
