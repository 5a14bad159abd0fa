#!/usr/bin/env python3
"""Prints docs/targets.md from what the golden vectors were on each target: target_page.py FOLDER

A target that was not computed, because it belongs to another part of tests/run, stands there as equal: that part fails if it
is not.
"""
import sys
from pathlib import Path

GOLDEN = Path(__file__).resolve().parents[1] / "golden/golden.txt"
TARGETS = {  # what tests/run calls it: (title, what it is)
    "aarch64": ("A64", "64-bit Arm with NEON, GCC -O1, user mode"),
    "armhf": ("A32", "32-bit Arm with NEON, GCC -O1, user mode"),
    "riscv64": ("RV64", "64-bit RISC-V, GCC -Os, user mode"),
    "s390x": ("s390x", "big-endian, GCC -O1, user mode"),
    "cortex-m0": ("M0", "Cortex-M0 on `microbit` with more memory, GCC -Os"),
    "cortex-m0-clang": ("M0 c", "the same, Clang -Os"),
    "cortex-m3": ("M3", "Cortex-M3 on `mps2_an385`, GCC -O2"),
    "cortex-m4": ("M4", "Cortex-M4 on `mps2_an386`, GCC -O3"),
    "cortex-m7": ("M7", "Cortex-M7 on `mps2_an500`, GCC -O2"),
    "cortex-m7-clang": ("M7 c", "the same, Clang -O2"),
    "cortex-m33": ("M33", "Cortex-M33 on `mps2_an505`, GCC -O2"),
    "cortex-m55": ("M55", "Cortex-M55 with Helium on `mps3_an547`, GCC -O2"),
    "cortex-m55-clang": ("M55 c", "the same, Clang -O2"),
    "rv32imac": ("RV32", "RV32IMAC on `rv32_virt`, GCC -O2"),
}


def read(path):
    return dict(line.split() for line in path.read_text().splitlines() if line and not line.startswith("#"))


def main():
    folder = Path(sys.argv[1])
    golden = read(GOLDEN)
    files = {target: folder / f"{target}.txt" for target in TARGETS}
    seen = {target: read(file) if file.exists() else golden for target, file in files.items()}
    print("""# The same bits on every target

Made by `tests/target/target_page.py` at the end of `tests/run target` and `tests/run board`. Each row is a golden vector:
an operator, or a part of the core, on fixed inputs, and a checksum over all that it answers. `=` says that the target
computed the checksum of `tests/golden/golden.txt`.

The host computes them too: by GCC and Clang, -O0 to -O3, in vectors of 8, 16, 32 and 64 bytes, and with sanitizers.
Of chips the level is that of the operators of the catalogue; for the rest GCC has -O1 where they have -O2, and -O2 on the M4.
""")
    print("| target | what it is |\n|---|---|")
    for title, what in TARGETS.values():
        print(f"| {title} | {what} |")
    print("\n| vector | checksum | " + " | ".join(title for title, _ in TARGETS.values()) + " |")
    print("|---" * (len(TARGETS) + 2) + "|")
    for name, checksum in golden.items():
        marks = ["=" if seen[target].get(name) == checksum else seen[target].get(name, "missing") for target in TARGETS]
        print(f"| {name} | `{checksum}` | " + " | ".join(marks) + " |")


if __name__ == "__main__":
    main()
