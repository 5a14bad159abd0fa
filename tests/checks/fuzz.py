#!/usr/bin/env python3
"""Runs every fuzz program below a build folder for a fixed number of inputs from a fixed seed.

A program fuzz_<folder>_<name> begins with the inputs of tests/fuzz/<folder>/<name>_corpus/, if that exists. New
inputs stay in the build folder; an input that crashes is written to crash-* there, and becomes a named test. What
searches whole images takes a hundred times as long as what parses a line: tests/fuzz/slow.txt says which programs get
a share of the inputs.

usage: fuzz.py BUILD_FOLDER [RUNS]
"""
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

SECONDS_AN_INPUT = 5
MEGABYTES = 2048


def main():
    corpora = Path(__file__).parents[1] / "fuzz"
    build, runs = Path(sys.argv[1]).resolve(), int(sys.argv[2]) if len(sys.argv) > 2 else 20000
    programs = sorted(path for path in build.rglob("fuzz_*") if path.is_file() and os.access(path, os.X_OK))
    if not programs:
        sys.exit(f"fuzz: no programs below {build}")
    seeds = {"fuzz_" + "_".join(path.relative_to(corpora).parts).removesuffix("_corpus"): path
             for path in corpora.rglob("*_corpus")}

    slow = {}
    for line in (corpora / "slow.txt").read_text().split("\n"):
        if line and not line.startswith("#"):
            name, share = line.split()[:2]
            slow[name] = int(share)

    def run(program):
        grown = build / "corpus" / program.name
        grown.mkdir(parents=True, exist_ok=True)
        command = [str(program), f"-runs={runs // slow.get(program.name, 1)}", "-seed=1", f"-timeout={SECONDS_AN_INPUT}", f"-rss_limit_mb={MEGABYTES}",
                   f"-artifact_prefix={build}/", "-print_final_stats=1", str(grown)]
        if program.name in seeds:
            command.append(str(seeds[program.name]))
        return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")

    failed = inputs = 0
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for program, result in zip(programs, pool.map(run, programs)):
            done = re.search(r"number_of_executed_units: (\d+)", result.stdout)
            if result.returncode != 0 or not done:
                failed += 1
                print(f"{result.stdout}\nfuzz: {program.name} FAILED")
            else:
                inputs += int(done[1])
                print(f"{program.name}: {done[1]} inputs")
    if failed == 0:
        print(f"fuzz: {len(programs)} programs, {inputs} inputs, no complaint")
    return 1 if failed else 0


sys.exit(main())
