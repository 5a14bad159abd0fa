#!/usr/bin/env python3
"""clang-tidy over every header and program, with the list in .clang-tidy.

Each header is checked as if it were the source file, so a finding appears once. A file that passed is not looked at
again until it, something it includes of ours, or the list changes.

usage: tidy.py [--root ROOT] [--cache FOLDER]
"""
import argparse
import hashlib
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path


def main():
    project = Path(__file__).parents[2]
    parser = argparse.ArgumentParser()
    parser.add_argument("--root", type=Path, default=project)
    parser.add_argument("--cache", type=Path, default=project / "build/tidy")
    options = parser.parse_args()
    root, rules = options.root.resolve(), project / ".clang-tidy"
    options.cache.mkdir(parents=True, exist_ok=True)

    folders = [*root.glob("*/include"), *root.glob("ports/*/include"), root / "apps"]
    flags = ["-std=c++17", "-Wno-pragma-once-outside-header", *(f"-I{folder}" for folder in folders)]
    files = sorted(path for folder in folders for path in folder.rglob("*.[hc]pp"))
    if not files:
        sys.exit("tidy: no files")
    version = subprocess.run(["clang-tidy", "--version"], check=True, capture_output=True).stdout

    def stamp_of(path):
        """A file whose name is the hash of all that the verdict depends on."""
        listed = subprocess.run(["clang++", "-MM", "-x", "c++", *flags, str(path)], capture_output=True, text=True)
        if listed.returncode != 0:
            return None
        known = hashlib.sha256(version + rules.read_bytes())
        for name in listed.stdout.replace("\\\n", " ").split()[1:]:
            known.update(Path(name).read_bytes())
        return options.cache / f"{path.relative_to(root).as_posix().replace('/', '_')}-{known.hexdigest()[:16]}"

    def problems(path):
        stamp = stamp_of(path)
        if stamp and stamp.exists():
            return ""
        command = ["clang-tidy", "--quiet", f"--config-file={rules}", str(path), "--", "-x", "c++", *flags]
        run = subprocess.run(command, capture_output=True, text=True)
        if run.returncode == 0 and stamp:
            stamp.touch()
        return "" if run.returncode == 0 else run.stdout

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        reports = [report for report in pool.map(problems, files) if report]
    print("".join(reports) if reports else f"tidy: {len(files)} files, nothing to say")
    return 1 if reports else 0


sys.exit(main())
