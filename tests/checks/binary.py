#!/usr/bin/env python3
"""Reads from object files and programs that they hold no floating point, heap, exceptions, type information,
guards of statics, input or output, and (object files) no mutable globals.

Three looks: the symbols, where a helper or a library would be called; the instructions, where a float unit needs no
helper; the sections. An object file may want only the few outside symbols in ALLOWED.

usage: binary.py FILE|FOLDER...     a folder stands for the object files below it
"""
import re
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

# e_machine of the ELF header -> prefix of the binary utilities, and what computes in floats there. Loads, stores and
# plain moves are not among them: Helium and NEON use the same registers for integers.
MACHINES = {
    40: ("arm-none-eabi-", r"(?!vmovx?\.|vins\.)v[a-z0-9]+(\.[a-z0-9]+)*\.[bf](16|32|64)(\.[a-z0-9]+)*|vcvt.*|vsqrt.*|vdiv.*"),
    62: ("", r"v?(add|sub|mul|div|sqrt|min|max|round|rcp|rsqrt|hadd|hsub|addsub|cmp[a-z_]*|f?n?m(add|sub)[0-9]*|dp)"
             r"[sp][sdh]|v?u?comis[sdh]|v?cvt.*|f(n?i?(ld|st|add|sub|mul|div|com|sqrt|abs|chs|ild|sin|cos).*)"),
    183: ("aarch64-linux-gnu-", r"f(add|sub|n?m(add|sub|ul)|ml[as]|mulx?|div|sqrt|abs|neg|cvt[a-z]*|rint[a-z]|cmp?e?|"
                                r"cm[a-z]+|ccmpe?|csel|max(nm)?p?v?|min(nm)?p?v?|addp|abd|rec[a-z]+|rsqrt[a-z]+)|[su]cvtf"),
    243: ("riscv64-linux-gnu-", r"f(add|sub|mul|div|sqrt|n?madd|n?msub|cvt|mv|sgnjn?x?|min|max|eq|lt|le|class)\..*"),
}

SYMBOLS = {
    "float helper": r"__aeabi_[fd](add|sub|rsub|mul|div|neg|cmp.*|2.*)|__aeabi_c[fd]r?cmp.*|__aeabi_u?[il]2[fd]|"
                    r"__aeabi_[hfd]2.*|__(add|sub|mul|div|neg|eq|ne|lt|le|gt|ge|unord|cmp)[hsdtx]f[23]?|__powi[sdtx]f2|"
                    r"__float(un)?[sdt]i[hsdtx]f|__fix(uns)?[hsdtx]f[sdt]i|__(extend|trunc)[hsdtx]f[hsdtx]f2|__gnu_(h2f|f2h).*",
    "heap": r"_?(malloc|calloc|realloc|free)(_r)?|aligned_alloc|memalign|_?sbrk(_r)?|_Zn[wa][jmy].*|_Zd[la]Pv.*",
    "exception or type information": r"__cxa_(?!guard|atexit|thread_atexit).*|__gxx_personality.*|_Unwind_.*|__aeabi_unwind.*|"
                                     r"_ZSt[0-9]+__throw_.*|_ZT[ISV].*|__dynamic_cast|_ZSt9terminatev|abort",
    "guard of a static": r"__cxa_(guard_.*|atexit|thread_atexit)|_ZGV.*",
    "input or output": r"_?_?(v|s|sn|vsn|f|vf)?i?printf(_r|_chk)?|puts|putchar|strto[dfl].*|_dtoa.*|__sf.*|_impure_ptr",
}

# What an object file may call outside: memory functions, and the integer helpers of processors that lack an instruction.
ALLOWED = re.compile(r"mem(cpy|set|move|cmp)|__aeabi_mem(cpy|set|move|clr)[48]?|__aeabi_u?[il]div(mod)?|"
                     r"__aeabi_(l(mul|lsl|lsr|asr)|u?lcmp)|__(u?div|u?mod|u?divmod|mul|ashl|ashr|lshr|bswap|clz|ctz|popcount|u?cmp|neg)"
                     r"[sdt]i[234]|__gnu_thumb1_case_[us](qi|hi|i)|_GLOBAL_OFFSET_TABLE_")

FORBIDDEN_SECTIONS = re.compile(r"\.(eh_frame|gcc_except_table|ARM\.extab|init_array|ctors|tdata|tbss)(\..*)?")
# Where a variable lies. .data.rel.ro is constant: tables of pointers that the loader sets once. What lies there without
# a name is no variable either: GCC for AArch64 keeps the first value of an object with a pointer so.
MUTABLE_SECTIONS = re.compile(r"\.(data(?!\.rel\.ro)|bss|tdata|tbss)(\..*)?|\*COM\*")

# The lines of objdump.
SECTION = re.compile(r"^ *[0-9]+ (\S+) +([0-9a-f]+) ")
SYMBOL = re.compile(r"^[0-9a-f]+ .{7} (\S+)\t[0-9a-f]+ +(?:\.hidden )?(\S+)$")
FUNCTION = re.compile(r"^[0-9a-f]+ <(.*)>:$")
INSTRUCTION = re.compile(r"^ *[0-9a-f]+:\t([a-z]\S*)")
RELOCATION = re.compile(r"^\s+[0-9a-f]+: R_\S+\t([^\s+-]+)")
# -fkeep-inline-functions keeps the standard library's functions too, numeric_limits<float>::max() for one. They count
# only where ours call them.
STANDARD = re.compile(r"_ZN?K?St")


class Binary:
    """A file as objdump tells it: sections with bytes in them, (symbol, section), and what each function holds."""

    def __init__(self, path):
        header = path.read_bytes()[:20]
        kind, machine = struct.unpack(("<" if header[5] == 1 else ">") + "HH", header[16:20])
        self.relocatable = kind == 1
        prefix, self.float_instruction = MACHINES[machine]
        self.sections, self.symbols, self.instructions, self.references = set(), [], {}, {}
        self.listen(prefix, "-ht", path)
        with tempfile.TemporaryDirectory() as folder:
            self.listen(prefix, "-dr", self.in_one_section(prefix, path, Path(folder)) if self.relocatable else path)

    @staticmethod
    def in_one_section(prefix, path, folder):
        """The same object with all instructions in one section: where every function has one of its own, objdump
        looks through all symbols for each address, which takes a hundred times as long."""
        (folder / "one.ld").write_text("SECTIONS { .text : { *(.text .text.*) } }\n")
        subprocess.run([prefix + "ld", "-r", "--force-group-allocation", "-T", folder / "one.ld", "-o", folder / "one.o", path],
                       check=True)
        return folder / "one.o"

    def listen(self, prefix, what, path):
        command = [prefix + "objdump", what, "--no-show-raw-insn", str(path)]
        for line in subprocess.run(command, check=True, capture_output=True, text=True).stdout.split("\n"):
            self.read(line)

    def read(self, line):
        if found := INSTRUCTION.match(line):
            self.instructions[self.function].add(found[1])
        elif found := RELOCATION.match(line):
            self.references[self.function].add(found[1])
        elif found := FUNCTION.match(line):
            self.function = found[1]
            self.instructions[self.function], self.references[self.function] = set(), set()
        elif found := SYMBOL.match(line):
            self.symbols.append((found[2], found[1]))
        elif (found := SECTION.match(line)) and int(found[2], 16) > 0:
            self.sections.add(found[1])

    def reached(self):
        """Every function and symbol of ours, and what those call."""
        done = set()
        waiting = [function for function in self.references if not STANDARD.match(function)]
        while waiting:
            name = waiting.pop()
            if name not in done:
                done.add(name)
                waiting += self.references.get(name, ())
        return done


def findings(path):
    binary = Binary(path)
    reached = binary.reached()
    for_others = set().union(*binary.references.values()) - reached
    for name, section in binary.symbols:
        if name in for_others:
            continue
        kinds = [kind for kind, pattern in SYMBOLS.items() if re.fullmatch(pattern, name)]
        if kinds:
            yield f"{kinds[0]}: {name}"
        elif binary.relocatable and section == "*UND*" and not ALLOWED.fullmatch(name):
            yield f"unknown outside symbol: {name}"
        elif binary.relocatable and MUTABLE_SECTIONS.fullmatch(section) and name != section and name[0] != "$":
            yield f"mutable data: {name}"
    for section in sorted(binary.sections):
        if FORBIDDEN_SECTIONS.fullmatch(section):
            yield f"forbidden section: {section}"
    for function, used in binary.instructions.items():
        for instruction in sorted(used) if function in reached else ():
            if re.fullmatch(binary.float_instruction, instruction):
                yield f"float instruction: {instruction} in {function}"


def main():
    files = []
    for argument in map(Path, sys.argv[1:]):
        files += sorted([*argument.rglob("*.o"), *argument.rglob("*.obj")]) if argument.is_dir() else [argument]
    if not files:
        print("binary: no object files", file=sys.stderr)
        return 1
    bad = 0
    for path in files:
        for finding in findings(path):
            subprocess.run(["c++filt"], input=f"{path}: {finding}\n", text=True)
            bad += 1
    if bad == 0:
        print(f"binary: {len(files)} files hold integers alone")
    return 1 if bad else 0


sys.exit(main())
