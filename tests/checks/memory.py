#!/usr/bin/env python3
"""docs/memory.md: the memory that fovea takes, as the compilers tell it.

Without an option the part of the page that any machine can compute must be as it is computed now. The part about
chips needs the cross compiler and changes with every change of the core, so it is only written, not compared.

usage: memory.py [--write]
"""
import argparse
import difflib
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
PAGE = PROJECT / "docs/memory.md"
INCLUDES = [f"-I{PROJECT}/core/include", f"-I{PROJECT}/tests"]
CHIPS = {"Cortex-M0": ["-mcpu=cortex-m0"], "Cortex-M4": ["-mcpu=cortex-m4", "-mfloat-abi=soft"]}
CHIP_FLAGS = ["-std=c++17", "-mthumb", "-Os", "-DNDEBUG", "-Wno-psabi", "-fno-exceptions", "-fno-rtti", "-fno-threadsafe-statics",
              "-fno-unwind-tables", "-fno-asynchronous-unwind-tables", "-ffunction-sections", "-fdata-sections", *INCLUDES]

# Entry points of tests/target/gauge_objects.cpp, and what they are called here.
TASKS = {"gauge_part": "gauge", "find": "find_parts", "label": "connected_components", "probe": "edge_probe",
         "line": "fit_line_robust", "circle": "fit_circle_robust", "binarise": "threshold",
         "level_of": "histogram_of, otsu", "erode_image": "erode", "open_image": "opening",
         "jpeg_to_gray": "decode_jpeg to Gray8", "jpeg_to_rgb": "decode_jpeg to Rgb888",
         "png_to_gray": "decode_png to Gray8", "gray_to_png": "encode_png of Gray8", "gray_to_bmp": "encode_bmp of Gray8",
         "read_recipe": "TomlReader", "write_label": "draw_label", "outline": "draw_line"}

HEAD = """# Memory

Written by `tests/checks/memory.py --write`. The core allocates nothing: images, lists and scratch are the caller's,
and every operator that wants scratch has a function that tells how much, for most of them when the program is compiled.

## Scratch

Bytes for images of four sizes, on a 64-bit processor with vectors of 16 bytes. Chips want a few bytes less, without
vectors for `box` less than half, but for `bilateral` its tables more.
connected_components takes labels for as many open regions and holes as a restless image can have; an image of calm
parts does with the 64 of the second line, and answers scratch_too_small if it does not.

"""

TYPES_HEAD = """
## Types

Bytes of what a program stores, on a 64-bit processor. A recipe has room for 24 features, a part for their results.

| type | bytes |
|---|---|
"""

CHIPS_HEAD = """
## On chips

From here on as g++ {version} for Arm compiles with -Os. Flash is all that a program needs to call the function: code,
tables, and what it takes of the compiler's library. Stack is the deepest chain of calls, without that library, whose
functions take some ten bytes. Types are as above, with pointers of four bytes.

| function | {names} |
|---|{rules}|
"""

OPERATORS_HEAD = """
The operators of the catalogue, each in a program that has no other:

| operator | {names} |
|---|{rules}|
"""


def compiled(compiler, flags, source, folder, name):
    target = Path(folder) / f"{name}.o"
    subprocess.run([compiler, *flags, "-c", str(source), "-o", str(target)], check=True, cwd=folder)
    return target


def replaced(text, names):
    for old, new in names.items():
        text = text.replace(old, new)
    return text


def type_sizes(nm, target):
    """Type -> bytes, in the order of the source."""
    listing = subprocess.run([nm, "-S", "-C", str(target)], check=True, capture_output=True, text=True).stdout
    # As the source calls what the compiler knows by another name, and without the name of the instruction set.
    plain = {"unsigned char": "Gray8", "RegionOf<fovea::Moments>": "Region", "HoleOf<fovea::Moments>": "Hole",
             "ConnectedComponentsOf<fovea::Moments>": "ConnectedComponents", "RecipeOf<24>": "Recipe",
             "HistogramOf<4>": "Histogram", "HistogramOf<1>": "Histogram", "<fovea::Real>": "<>"}
    sizes = {replaced(re.sub(r"\w+_[0-9]+::", "", found[2]), plain): int(found[1], 16)
             for found in re.finditer(r"^\S+ (\S+) \S (?:fovea::)?bytes_of<fovea::(.*?) ?>(?:\[abi.*)?$", listing, re.MULTILINE)}
    order = re.findall(r"template char bytes_of<(.*)>\[\];", (PROJECT / "tests/memory/type_sizes.cpp").read_text())
    return {name: sizes[name] for name in order}


def host_part(folder):
    program = Path(folder) / "scratch"
    subprocess.run(["g++", "-std=c++17", "-O0", "-DFOVEA_BYTES=16", *INCLUDES, str(PROJECT / "tests/memory/scratch.cpp"),
                    "-o", str(program)], check=True)
    table = subprocess.run([program], check=True, capture_output=True, text=True).stdout
    sizes = type_sizes("nm", compiled("g++", ["-std=c++17", *INCLUDES], PROJECT / "tests/memory/type_sizes.cpp", folder, "host"))
    return HEAD + table + TYPES_HEAD + "".join(f"| `{name}` | {size} |\n" for name, size in sizes.items())


# ---- Chips --------------------------------------------------------------------------------

def flash_of(flags, target, entry, folder):
    program = Path(folder) / "linked"
    subprocess.run(["arm-none-eabi-g++", *flags, "-mthumb", "-nostartfiles", "-specs=nosys.specs", "-Wl,--gc-sections",
                    f"-Wl,-e,{entry}", f"-Wl,-u,{entry}", str(target), "-o", str(program)], check=True, capture_output=True)
    listing = subprocess.run(["arm-none-eabi-size", str(program)], check=True, capture_output=True, text=True).stdout
    text, data = listing.split("\n")[1].split()[:2]
    return int(text) + int(data)


def deepest_stack(graph, entry):
    """The deepest chain of frames below a function, from the notes of -fcallgraph-info=su."""
    frames, calls = {}, {}
    for found in re.finditer(r'node: \{ title: "([^"]*)" label: "[^"]*?(?:(\d+) bytes \([^"]*)?"', graph):
        frames[found[1]] = int(found[2] or 0)
    for found in re.finditer(r'edge: \{ sourcename: "([^"]*)" targetname: "([^"]*)"', graph):
        calls.setdefault(found[1], set()).add(found[2])
    known = {}

    def depth(name, open_functions=()):
        if name in open_functions:
            sys.exit(f"memory: {name} calls itself")
        if name not in known:
            below = [depth(called, (*open_functions, name)) for called in calls.get(name, ())]
            known[name] = frames.get(name, 0) + max(below, default=0)
        return known[name]

    node = next(name for name in frames if name.split(":")[-1] == entry)
    return depth(node)


def catalogue():
    """Array of a family -> names of its operators, in the order of the families."""
    headers = PROJECT / "core/include/fovea/catalogue"
    arrays = re.findall(r'\{"\w+", catalogue::(\w+)\}', (headers / "catalogue.hpp").read_text())
    text = {array: path.read_text() for path in headers.glob("*.hpp") for array in
            re.findall(r"inline constexpr Operator (\w+)\[\]", path.read_text())}
    return {array: re.findall(r'(?:\{|_entry<[^>]*>\(\s*|_entry\(\s*)"(\w+)",\s*"', text[array][text[array].index(f"Operator {array}[]"):])
            for array in arrays}


def operator_columns(folder):
    """Per chip: operator -> flash and stack."""
    columns = [{} for _ in CHIPS]
    for array, names in catalogue().items():
        source = Path(folder) / f"{array}.cpp"
        functions = "".join(
            f'extern "C" fovea::Status op_{name}(const fovea::OperatorCall& call) {{\n'
            f'    constexpr const fovea::Operator* op = fovea::find_operator("{name}");\n'
            f"    return op->run(call);\n}}\n" for name in names)
        source.write_text("#include <fovea/catalogue/catalogue.hpp>\n" + functions)
        for column, (chip, flags) in zip(columns, CHIPS.items()):
            target = compiled("arm-none-eabi-g++", [*CHIP_FLAGS, *flags, "-fcallgraph-info=su"], source, folder, array)
            graph = (Path(folder) / f"{array}.ci").read_text()
            for name in names:
                column[name] = (flash_of(flags, target, f"op_{name}", folder), deepest_stack(graph, f"op_{name}"))
    return columns


def chip_part(folder):
    if not shutil.which("arm-none-eabi-g++"):
        return None
    columns, types = [], {}
    for number, flags in enumerate(CHIPS.values()):
        name = f"chip{number}"
        target = compiled("arm-none-eabi-g++", [*CHIP_FLAGS, *flags, "-fcallgraph-info=su"],
                          PROJECT / "tests/target/gauge_objects.cpp", folder, name)
        graph = (Path(folder) / f"{name}.ci").read_text()
        symbols = re.findall(r" T (_ZN5fovea4task(\d+)(\w+))$", subprocess.run(
            ["arm-none-eabi-nm", str(target)], check=True, capture_output=True, text=True).stdout, re.MULTILINE)
        entries = {rest[:int(length)]: symbol for symbol, length, rest in symbols}
        columns.append({task: (flash_of(flags, target, entries[task], folder), deepest_stack(graph, entries[task]))
                        for task in TASKS})
        types = type_sizes("arm-none-eabi-nm", compiled("arm-none-eabi-g++", [*CHIP_FLAGS, *flags],
                                                        PROJECT / "tests/memory/type_sizes.cpp", folder, "types"))
    version = subprocess.run(["arm-none-eabi-g++", "-dumpfullversion"], capture_output=True, text=True).stdout.strip()
    names = " | ".join(f"{chip}: flash | stack" for chip in CHIPS)
    text = CHIPS_HEAD.format(version=version, names=names, rules="|".join(["---"] * 2 * len(CHIPS)))
    for task, name in TASKS.items():
        cells = [str(number) for column in columns for number in column[task]]
        text += f"| {name} | " + " | ".join(cells) + " |\n"
    operators = operator_columns(folder)
    text += OPERATORS_HEAD.format(names=names, rules="|".join(["---"] * 2 * len(CHIPS)))
    for name in operators[0]:
        text += f"| {name} | " + " | ".join(str(number) for column in operators for number in column[name]) + " |\n"
    return text + "\n| type | bytes |\n|---|---|\n" + "".join(f"| `{name}` | {size} |\n" for name, size in types.items())


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        host = host_part(folder)
        written = PAGE.read_text() if PAGE.exists() else ""
        border = written.find("\n## On chips")
        if options.write:
            chips = chip_part(folder)
            PAGE.write_text(host + (written[border:] if chips is None and border >= 0 else chips or ""))
            print("docs/memory.md written" + ("" if chips else ", but for the part about chips"))
            return 0
    different = list(difflib.unified_diff((written[:border] if border >= 0 else written).split("\n"), host.split("\n"),
                                          "docs/memory.md", "computed now", n=0, lineterm=""))
    print("\n".join(different) if different else "memory: docs/memory.md is as computed")
    if different:
        print("memory: write it anew with tests/checks/memory.py --write")
    return 1 if different else 0


sys.exit(main())
