#!/usr/bin/env python3
"""The shape of the house, read from its files: who includes whom, and how a source file must look.

usage: layers.py [ROOT]     prints one line a finding and fails if there is one
"""
import re
import sys
from pathlib import Path

# Standard headers of the core: none of them brings code that allocates, throws, prints or computes in floats.
CORE_STANDARD = {"array", "cstddef", "cstdint", "cstring", "initializer_list", "limits", "type_traits", "utility"}
# simd/ alone may know instruction sets.
SIMD_INTRINSICS = {"arm_acle.h", "arm_mve.h", "arm_neon.h", "emmintrin.h", "immintrin.h"}
# core <- hal <- ports <- apps; tests may see all. hal sees of the core only base and image.
HOUSE = ["core", "hal", "ports", "apps", "tests"]
HAL_SEES = {"base", "image"}
MOST_LINES = 400

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
SNAKE_CASE = re.compile(r"[a-z][a-z0-9_]*(\.[a-z]+)?")

findings = []


def find(path, text):
    findings.append(f"{path}: {text}")


class Source:
    """A file, the part of the house it lies in, its folder of the core, and what it includes."""

    def __init__(self, root, path):
        self.path = path.relative_to(root)
        self.part = self.path.parts[0]
        self.folder = self.path.parts[3] if self.path.parts[:3] == ("core", "include", "fovea") else None
        self.text = path.read_text()
        self.includes = INCLUDE.findall(self.text)


def check_form(source):
    """What every source file must have, whatever it includes."""
    lines = source.text.split("\n")
    if lines[0] != "// SPDX-License-Identifier: MIT":
        find(source.path, "the first line must be the SPDX line")
    for part in source.path.parts:
        if not SNAKE_CASE.fullmatch(part):
            find(source.path, f"'{part}' is not snake_case")
    if source.path.name.endswith("_test.cpp") and ("<", "gtest/gtest.h") not in source.includes:
        find(source.path, "a test includes <gtest/gtest.h>, though it is compiled beforehand")
    if source.path.suffix == ".hpp":
        if lines.count("#pragma once") != 1:
            find(source.path, "needs one #pragma once")
        if source.part != "tests" and len(lines) - 1 > MOST_LINES:
            find(source.path, f"{len(lines) - 1} lines, at most {MOST_LINES}")


def check_direction(source, target, order):
    """source includes target: does that point down?"""
    if HOUSE.index(target.part) > HOUSE.index(source.part):
        find(source.path, f"{source.part} must not include {target.part}: {target.path}")
    elif source.part == "hal" and target.part == "core" and target.folder not in HAL_SEES:
        find(source.path, f"hal sees only {' and '.join(sorted(HAL_SEES))} of the core: {target.path}")
    elif source.folder in order and target.folder in order and order[target.folder] > order[source.folder]:
        find(source.path, f"{source.folder} lies below {target.folder} in core/layers.txt: {target.path}")


def check_core_includes(source):
    allowed = CORE_STANDARD | (SIMD_INTRINSICS if source.folder == "simd" else set())
    for bracket, name in source.includes:
        if bracket == '"':
            find(source.path, f'the core includes with <>: "{name}"')
        elif not name.startswith("fovea/") and name not in allowed:
            find(source.path, f"forbidden header in the core: <{name}>")


def check_cycles(graph):
    """Depth-first; a header that is met again while it is still open closes a cycle."""
    done, open_files = set(), []

    def visit(path):
        if path in open_files:
            circle = open_files[open_files.index(path):] + [path]
            find(path, "include cycle: " + " -> ".join(p.name for p in circle))
        elif path not in done:
            open_files.append(path)
            for target in graph[path]:
                visit(target)
            open_files.pop()
            done.add(path)

    for path in graph:
        visit(path)


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[2]).resolve()
    lines = (root / "core/layers.txt").read_text().split("\n")
    order = {name: i for i, name in enumerate(n for n in lines if n and not n.startswith("#"))}

    sources = {}
    for part in HOUSE:
        for path in sorted((root / part).rglob("*.[hc]pp")):
            source = Source(root, path)
            sources[source.path] = source
    # As the compiler would look it up: every include folder, then apps/ and tests/.
    roots = [p.relative_to(root) for part in ("core", "hal", "ports") for p in (root / part).rglob("include")]
    roots += [Path("apps"), Path("tests")]

    graph = {}
    for source in sources.values():
        check_form(source)
        if source.part == "core":
            check_core_includes(source)
            if source.folder not in order:
                find(source.path, f"folder '{source.folder}' is not in core/layers.txt")
        graph[source.path] = []
        for _, name in source.includes:
            if "../" in name:
                find(source.path, f"include by way of ../: {name}")
            target = next((sources[r / name] for r in [source.path.parent, *roots] if r / name in sources), None)
            if target:
                graph[source.path].append(target.path)
                check_direction(source, target, order)
            elif name.startswith("fovea/"):
                find(source.path, f"no such header: <{name}>")
    check_cycles(graph)

    if not graph:
        find(root, "no source files")
    print("\n".join(findings) if findings else f"layers: {len(graph)} files, nothing to say")
    return 1 if findings else 0


sys.exit(main())
