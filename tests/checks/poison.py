#!/usr/bin/env python3
"""Compiles every header of the core after the words it may not use have been poisoned.

A poisoned word is an error wherever it stands, in a template that nobody instantiates too: what no object file can
show. `delete` is not among them, because `= delete` is wanted.

usage: poison.py [--root ROOT] [COMPILER...]     a compiler may carry options: "arm-none-eabi-g++ -mcpu=cortex-m4"
"""
import argparse
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

POISON = """float double malloc calloc realloc free alloca throw try catch new typeid dynamic_cast virtual thread_local goto
            abort exit printf fprintf sprintf snprintf puts"""

# Before the poison: the headers the core may use, which contain such words themselves.
PRELUDE = """#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <type_traits>
#include <utility>
#if defined(__ARM_FEATURE_SIMD32)
#include <arm_acle.h>
#endif
#if defined(__ARM_FEATURE_MVE)
#include <arm_mve.h>
#elif defined(__ARM_NEON)
#include <arm_neon.h>
#elif defined(__x86_64__)
#include <immintrin.h>
#endif
#undef alloca
"""


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--root", type=Path, default=Path(__file__).parents[2])
    parser.add_argument("compilers", nargs="*", default=["g++", "clang++"])
    options = parser.parse_args()

    include = options.root / "core/include"
    headers = sorted(p.relative_to(include) for p in include.rglob("*.hpp"))
    if not headers:
        sys.exit("poison: no headers")
    source = PRELUDE + "".join(f"#pragma GCC poison {line}\n" for line in POISON.split("\n"))
    source += "".join(f"#include <{header}>\n" for header in headers)

    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        unit = Path(folder) / "poisoned.cpp"
        unit.write_text(source)
        for compiler in options.compilers:
            command = shlex.split(compiler) + ["-std=c++17", "-fsyntax-only", f"-I{include}", str(unit)]
            failed += subprocess.run(command).returncode != 0
    if failed == 0:
        print(f"poison: {len(headers)} headers hold none of {len(POISON.split())} words")
    return 1 if failed else 0


sys.exit(main())
