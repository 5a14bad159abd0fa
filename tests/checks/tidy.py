#!/usr/bin/env python3
"""clang-tidy over every header and program, with the list in .clang-tidy.

All headers of the core are one source file to it, those of the hal, the ports and the applications another, and each
program one more: what many include is read and judged once. A header with a using-declaration or a short name for a
namespace is a source file of its own as well, because clang-tidy sees only there whether they are used. A source file
that passed is not looked at again until it, something it includes of ours, or the list changes.

usage: tidy.py [--root ROOT] [--cache FOLDER]
"""
import argparse
import hashlib
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

BORROWED_NAME = re.compile(r"^\s*using\s+[\w:]*::\w+\s*[;,]|\bnamespace\s+\w+\s*=", re.MULTILINE)


def main():
    project = Path(__file__).parents[2]
    parser = argparse.ArgumentParser()
    parser.add_argument("--root", type=Path, default=project)
    parser.add_argument("--cache", type=Path, default=project / "build/tidy")
    options = parser.parse_args()
    root, rules = options.root.resolve(), project / ".clang-tidy"
    options.cache.mkdir(parents=True, exist_ok=True)

    folders = [*root.glob("*/include"), *root.glob("ports/*/include"), root / "apps"]
    flags = ["-x", "c++", "-std=c++17", "-Wno-pragma-once-outside-header", *(f"-I{folder}" for folder in folders)]
    headers = {folder: sorted(folder.rglob("*.hpp")) for folder in folders}
    # Source file -> the headers that are judged with it, as a regular expression.
    # Programs for boards are compiled for these alone.
    units = {path: "" for path in sorted((root / "apps").rglob("*.cpp")) if "<board.hpp>" not in path.read_text()}
    for name, judged in ("core", "core"), ("others", "(hal|ports|apps)"):
        unit = options.cache.resolve() / f"{name}.cpp"
        unit.write_text("".join(f"#include <{path.relative_to(folder)}>\n" for folder in folders for path in headers[folder]
                                if (folder.parent.name == "core") == (name == "core")))
        units[unit] = f"{root}/{judged}/.*"
    count = sum(map(len, headers.values())) + len(units) - 2
    if count == 0:
        sys.exit("tidy: no files")
    units |= {path: "" for folder in folders for path in headers[folder] if BORROWED_NAME.search(path.read_text())}
    version = subprocess.run(["clang-tidy", "--version"], check=True, capture_output=True).stdout

    def stamp_of(path):
        """A file whose name is the hash of all that the verdict depends on."""
        listed = subprocess.run(["clang++", "-MM", *flags, str(path)], capture_output=True, text=True)
        if listed.returncode != 0:
            return None
        known = hashlib.sha256(version + rules.read_bytes())
        for name in listed.stdout.replace("\\\n", " ").split()[1:]:
            known.update(Path(name).read_bytes())
        return options.cache / f"{path.stem}-{known.hexdigest()[:16]}"

    def problems(path):
        stamp = stamp_of(path)
        if stamp and stamp.exists():
            return ""
        command = ["clang-tidy", "--quiet", f"--config-file={rules}", f"--header-filter={units[path]}", str(path), "--", *flags]
        run = subprocess.run(command, capture_output=True, text=True)
        if run.returncode == 0 and stamp:
            stamp.touch()
        return "" if run.returncode == 0 else run.stdout

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        reports = [report for report in pool.map(problems, units) if report]
    print("".join(reports) if reports else f"tidy: {count} files, nothing to say")
    return 1 if reports else 0


sys.exit(main())
