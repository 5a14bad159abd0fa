#!/usr/bin/env python3
"""Every check must fail where it should, with the right words: each is given a small tree or object with a fault
planted in it, and once the same without the fault.

usage: alarms.py [host|target|NAME...]     which compilers are there, or the alarms of these names alone
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
CHECKS = PROJECT / "tests/checks"
SPDX = "// SPDX-License-Identifier: MIT\n"
HEAD = SPDX + "#pragma once\n"

alarms = []


def alarm(function):
    """An alarm takes an empty folder and answers (what, command, words expected or None for silence) of each trial."""
    alarms.append(function)
    return function


def write(folder, files):
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    return folder


def copy_of_project(folder):
    for name in ("core", "hal", "ports", "apps", "tests"):
        shutil.copytree(PROJECT / name, folder / name)
    for name in ("CMakeLists.txt", "CMakePresets.json", ".clang-tidy", ".clang-format"):
        shutil.copy(PROJECT / name, folder)
    return folder


def replace(path, old, new):
    text = path.read_text()
    if old not in text:
        sys.exit(f"alarms: nothing to break in {path}: {old}")
    path.write_text(text.replace(old, new))


# ---- The tree -----------------------------------------------------------------------------

TREE = {
    "core/layers.txt": "# order\nbase\nnumber\nimage\n",
    "core/include/fovea/base/a.hpp": HEAD + "#include <cstdint>\n",
    "core/include/fovea/number/n.hpp": HEAD + "#include <fovea/base/a.hpp>\n",
    "core/include/fovea/image/b.hpp": HEAD + "#include <fovea/base/a.hpp>\n",
    "hal/include/fovea/hal/h.hpp": HEAD + "#include <fovea/image/b.hpp>\n",
    "ports/linux/include/fovea/linux/p.hpp": HEAD + "#include <vector>\n\n#include <fovea/hal/h.hpp>\n",
    "apps/fovea/main.cpp": SPDX + "#include <fovea/linux/p.hpp>\n",
    "tests/core/base/a_test.cpp": SPDX + "#include <gtest/gtest.h>\n\n#include <fovea/base/a.hpp>\n",
}
BASE = "core/include/fovea/base/a.hpp"


@alarm
def layers(folder):
    faults = [
        ("an include against the layers", {BASE: HEAD + "#include <fovea/image/b.hpp>\n"}, "base lies below image"),
        ("core includes hal", {BASE: HEAD + "#include <fovea/hal/h.hpp>\n"}, "core must not include hal"),
        ("hal includes a port", {"hal/include/fovea/hal/h.hpp": HEAD + "#include <fovea/linux/p.hpp>\n"},
         "hal must not include ports"),
        ("a port includes an app", {"ports/linux/include/fovea/linux/p.hpp": HEAD + "#include <fovea/main.cpp>\n"},
         "ports must not include apps"),
        ("hal sees numbers", {"hal/include/fovea/hal/h.hpp": HEAD + "#include <fovea/number/n.hpp>\n"}, "hal sees only"),
        ("a cycle", {BASE: HEAD + "#include <fovea/base/c.hpp>\n",
                     "core/include/fovea/base/c.hpp": HEAD + "#include <fovea/base/a.hpp>\n"}, "include cycle: a.hpp -> c.hpp"),
        ("a way up", {"tests/t.cpp": SPDX + '#include "../core/include/fovea/base/a.hpp"\n'}, "by way of ../"),
        ("no pragma once", {BASE: SPDX}, "needs one #pragma once"),
        ("no licence", {BASE: "#pragma once\n"}, "SPDX"),
        ("a name in capitals", {"core/include/fovea/base/BoxFilter.hpp": HEAD}, "is not snake_case"),
        ("a long header", {BASE: HEAD + "\n" * 399}, "401 lines"),
        ("a heap header", {BASE: HEAD + "#include <vector>\n"}, "forbidden header in the core: <vector>"),
        ("an intrinsics header outside simd", {BASE: HEAD + "#include <arm_acle.h>\n"}, "forbidden header in the core"),
        ("quotes", {BASE: HEAD + '#include "b.hpp"\n'}, "the core includes with <>"),
        ("a folder nobody listed", {"core/include/fovea/misc/m.hpp": HEAD}, "not in core/layers.txt"),
        ("a test without GoogleTest", {"tests/core/base/a_test.cpp": SPDX + "#include <fovea/base/a.hpp>\n"},
         "a test includes <gtest/gtest.h>"),
        ("a header that is not there", {BASE: HEAD + "#include <fovea/base/gone.hpp>\n"}, "no such header"),
    ]
    for number, (what, files, words) in enumerate([("a good tree", {}, None), *faults]):
        yield what, [CHECKS / "layers.py", write(folder / str(number), {**TREE, **files})], words


@alarm
def hygiene(folder):
    faults = [("a good tree", "see docs/, <core/include> and ../shared/data\n", None),
              ("a machine path", "cd /ro" + "ot/fovea\n", "a path of one machine"),
              ("a registry", "see https://pypi" + ".org/simple\n", "a package registry"),
              ("a promise", "// TO" + "DO: later\n", "work put off"),
              ("two glued fields", "/// Border    none Errors    none\n", "two fields of a docstring in one line"),
              ("a long comment", "// " + 36 * "abc" + "\n", "a comment of more than 110 columns"),
              ("a conflict", "<<<<<<" + "< HEAD\n", "a conflict left over")]
    for number, (what, text, words) in enumerate(faults):
        yield what, [CHECKS / "hygiene.py", write(folder / str(number), {"README.md": text})], words


@alarm
def layout(folder):
    for what, text, words in [("good", "int f();\n", None), ("bad", "int  f( );\n", "should be clang-formatted")]:
        yield what, [CHECKS / "format", write(folder / what, {**TREE, BASE: HEAD + "\n" + text})], words


@alarm
def tidy(folder):
    faults = [("good names", "namespace fovea { class Box { int size_ = 0; public: int size() const { return size_; } }; }", None),
              ("a type in lower case", "struct crate {};", "invalid case style for struct 'crate'"),
              ("a name that holds a stage's", "struct boxes {};", "invalid case style for struct 'boxes'"),
              ("a function in camel case", "void boxFilter();", "invalid case style for function"),
              ("a constant with k", "inline constexpr int kSize = 3;", "invalid case style for"),
              ("a private member without _", "class Box { int size = 0; };", "invalid case style for private member"),
              ("a template parameter", "template <int fraction_bits> struct Fixed {};", "invalid case style for"),
              ("a macro of nobody", "#define MAX_SIZE 3", "invalid case style for macro"),
              ("a copy in a loop", "struct Big { int a[99]; Big(const Big&); };\nint sum(const Big (&all)[3]) { int s = 0; "
               "for (const Big b : all) s += b.a[0]; return s; }", "performance-for-range-copy"),
              ("a name nobody uses", "namespace a { struct B; }\nusing a::B;", "misc-unused-using-decls"),
              ("a short name nobody uses", "namespace a { struct B; }\nnamespace b = a;", "misc-unused-alias-decls"),
              ("a definition", "int f() { return 1; }", "misc-definitions-in-headers"),
              ("a branch twice", "int f(int a) { if (a > 0) return 1; else return 1; }", "bugprone-branch-clone")]
    def trial(number, files):
        tree = write(folder / str(number), files)
        return [CHECKS / "tidy.py", "--root", tree, "--cache", tree / "cache"]

    for number, (what, text, words) in enumerate(faults):
        yield what, trial(number, {BASE: HEAD + text + "\n"}), words
    fault = "struct crate {};\n"
    for number, path in enumerate(["hal/include/fovea/hal/h.hpp", "ports/linux/include/fovea/linux/p.hpp",
                                   "apps/fovea/a.hpp"], 20):
        yield f"a fault in {path}", trial(number, {path: HEAD + fault}), "invalid case style for struct 'crate'"
    yield "a fault in a program", trial(30, {"apps/fovea/main.cpp": SPDX + fault}), "invalid case style for struct 'crate'"
    yield "no files", trial(40, {"README.md": ""}), "no files"


@alarm
def poison(folder):
    faults = [("integers", "int f(int a) { return a + 1; }", None), ("float", "float f(); };", "poison"),
              ("double", "int f() { return static_cast<int>(double{1}); }", "poison"),
              ("new", "T* f() { return new T; }", "poison"), ("malloc", "void* f() { return malloc(1); }", "poison"),
              ("throw", "void f() { throw T(); }", "poison"), ("virtual", "virtual void f();", "poison"),
              ("thread_local", "static thread_local int i;", "poison"), ("goto", "void f() { goto a; a:; }", "poison")]
    for compiler in ("g++", "clang++"):
        for what, text, words in faults:
            body = HEAD + "template <class T>\nstruct NeverInstantiated {\n" + text + "\n};\n"
            tree = write(folder / (compiler + what), {"core/include/fovea/base/a.hpp": body})
            yield f"{what}, {compiler}", [CHECKS / "poison.py", "--root", tree, compiler], words


@alarm
def self_containment(folder):
    """The build itself is the check: a header that leans on what others include."""
    for what, text, words in [("good", "#include <cstdint>\ninline std::uint8_t f() { return 0; }\n", None),
                              ("bad", "inline std::uint8_t f() { return 0; }\n", "does not name a type")]:
        tree = copy_of_project(folder / what)
        for part in ("core", "hal", "ports", "apps"):
            for header in (tree / part).rglob("*.hpp"):
                header.unlink()
        # a.hpp stands before z.hpp wherever all headers are included.
        write(tree, {BASE: HEAD + "#include <cstdint>\n", "core/include/fovea/base/z.hpp": HEAD + text})
        yield what, ["sh", "-c", f"cmake --preset host -S {tree} -DCMAKE_CXX_COMPILER=g++ > /dev/null 2>&1; "
                                 f"cmake --build {tree}/build/host --target headers_alone"], words


@alarm
def consumers(folder):
    def broken(name, file, old, new):
        tree = copy_of_project(folder / name)
        replace(tree / file, old, new)
        return [CHECKS / "consumers", tree, tree / "build"]

    yield "a prefix that cannot move", broken("a", "core/cmake/fovea.pc.in", "${pcfiledir}/@pc_to_prefix@",
                                              "@CMAKE_INSTALL_PREFIX@"), "pkg_config, build FAILED"
    yield "tests inside another project", broken("b", "CMakeLists.txt", '" ${PROJECT_IS_TOP_LEVEL}', '" ON'), \
        "builds more than the headers, FAILED"
    yield "a header C++20 refuses", broken("c", "core/include/fovea/number/integer.hpp", "#pragma once",
                                           "#pragma once\ninline int requires = 0;"), "find_package_moved, build FAILED"
    yield "an older version", broken("d", "CMakeLists.txt", "VERSION 0.1.0", "VERSION 0.0.9"), "find_package, configure FAILED"


@alarm
def manifests(folder):
    number = 0

    def trial(name, what, words, file=None, old="", new="", extra="docs/b.txt"):
        nonlocal number
        number += 1
        tree = write(folder / f"{number}", {extra: ""})
        for path in "core", "hal", "zephyr", "ports/zephyr", "ports/arduino":
            shutil.copytree(PROJECT / path, tree / path, dirs_exist_ok=True)
        for path in "CMakeLists.txt", "LICENSE", "README.md", "library.json", "idf_component.yml":
            shutil.copy(PROJECT / path, tree)
        write(tree, {f"{path}/a.txt": "" for path in ("apps", "docs", "tests", "toolchains")})
        if file:
            replace(tree / file, old, new)
        return f"{name}, {what}", [CHECKS / "manifests.py", tree, name], words

    yml, kconfig, module = "zephyr/module.yml", "ports/zephyr/Kconfig", "ports/zephyr/CMakeLists.txt"
    yield trial("zephyr", "as it is", None)
    yield trial("zephyr", "another name", "name is 'fover'", yml, "name: fovea", "name: fover")
    yield trial("zephyr", "a field that Zephyr does not know", "no such field: build.make", yml, "cmake:", "make:")
    yield trial("zephyr", "no Kconfig", "build.kconfig is missing", yml, "  kconfig: ports/zephyr/Kconfig\n", "")
    yield trial("zephyr", "a path that is not there", "no such path: ports/gone/Kconfig", yml, "zephyr/K", "gone/K")
    yield trial("zephyr", "no YAML", "cannot be read", yml, "name: ", "name: [")
    yield trial("zephyr", "a folder that is not there", "cmake failed", module, "/hal/include", "/hal/included")
    yield trial("zephyr", "headers without the symbol", "although CONFIG_FOVEA is not set", module, "if(CONFIG_FOVEA)", "if(TRUE)")
    yield trial("zephyr", "an older C++", "FOVEA is y with STD_CPP14", kconfig, " && !STD_CPP14", "")
    yield trial("zephyr", "the minimal library", "REQUIRES_FULL_LIBCPP is n with STD_CPP17", kconfig, "\tselect REQUIRES_FULL_LIBCPP\n", "")

    yml = "idf_component.yml"
    yield trial("esp_idf", "as it is", None)
    yield trial("esp_idf", "another version", "version is '0.1.1'", yml, "0.1.0", "0.1.1")
    yield trial("esp_idf", "another licence", "license is 'BSD'", yml, "MIT", "BSD")
    yield trial("esp_idf", "no description", "description is missing", yml, "description:", "#")
    yield trial("esp_idf", "a path that is not there", "no such path: gone/**/*", yml, "docs/", "gone/")
    yield trial("esp_idf", "headers that are left out", "Include directory", yml, "docs/", "hal/")
    yield trial("esp_idf", "a project before the component", "project command is not scriptable", "CMakeLists.txt",
                "if(ESP_PLATFORM)", "project(early)\nif(ESP_PLATFORM)")
    yield trial("esp_idf", "no registration", "cmake failed", "CMakeLists.txt", "if(ESP_PLATFORM)", "if(FALSE)")

    manifest = "library.json"
    yield trial("platformio", "as it is", None)
    yield trial("platformio", "another version", "version is '0.2.0'", manifest, "0.1.0", "0.2.0")
    yield trial("platformio", "no name", "name is missing", manifest, '"name": "fovea",', "")
    yield trial("platformio", "no JSON", "cannot be read", manifest, '"MIT",', '"MIT"')
    yield trial("platformio", "a path that is not there", "no such path: README.txt", manifest, "README.md", "README.txt")
    yield trial("platformio", "headers that are not exported", "no such path in the package: hal/include", manifest, '"hal/include", "lib', '"lib')
    yield trial("platformio", "a source among the headers", "span.cpp would be compiled", extra="core/include/fovea/base/span.cpp")

    manifest, script = "ports/arduino/library.properties", "ports/arduino/library.cmake"
    yield trial("arduino", "as it is", None)
    yield trial("arduino", "another version", "version is '0.1'", manifest, "0.1.0", "0.1")
    yield trial("arduino", "no maintainer", "maintainer is missing", manifest, "maintainer=fovea contributors\n", "")
    yield trial("arduino", "an empty field", "author is empty", manifest, "author=fovea contributors", "author=")
    yield trial("arduino", "a category of nobody", "no such category: Vision", manifest, "Data Processing", "Vision")
    yield trial("arduino", "a header that is not there", "no such header in src: vision.h", manifest, "fovea.h", "vision.h")
    yield trial("arduino", "headers that are not in src", "does not name a type", script, "${library}/src)", "${library}/source)")
    yield trial("arduino", "a macro that is not put aside", "in expansion of macro", script, " round word", " round")
    yield trial("arduino", "an older C++ that gets through", "does not say that it needs C++17", script, "201703L", "201402L")
    yield trial("arduino", "a sketch that counts wrong", "printed 'parts: 1", "ports/arduino/examples/count_parts/count_parts.ino",
                "{50, 30, 15, 20}", "{15, 15, 15, 15}")


# ---- Docs ---------------------------------------------------------------------------------

PROGRAM = """```cpp
#include <cstdio>

#include <fovea/pixelwise/invert.hpp>

int main() {
    std::printf("%d\\n%d\\n", fovea::inverted(0), fovea::inverted(1));
    return 0;
}
```

```text output
255
254
```
"""
DOCS = {
    "core/include/fovea/base/status.hpp": HEAD,
    "core/include/fovea/pixelwise/invert.hpp": HEAD + "namespace fovea {\nconstexpr int inverted(int level) { return 255 - level; }\n}\n",
    "README.md": "# Root\n\nSee [inversion](docs/operators/README.md#to-invert) and [elsewhere](https://example.invalid).\n\n"
                 "```cpp\nint half(int a) { return a / 2; }\n```\n\n```cpp fragment\nStatus s = ...\n```\n\n"
                 "```cpp file core/include/fovea/pixelwise/invert.hpp\n#pragma once\nnamespace fovea {\n```\n",
    "docs/operators/README.md": "# Operators\n\n## To `invert`\n\nIn `pixelwise/invert.hpp`, `inverted` [it](../../README.md).\n\n"
                                + PROGRAM,
}


@alarm
def snippets(folder):
    page, header = "docs/operators/README.md", "core/include/fovea/pixelwise/invert.hpp"

    def trial(what, words, file=None, old="", new=""):
        tree = write(folder / what.replace(" ", "_"), DOCS)
        if file:
            replace(tree / file, old, new)
        return what, [CHECKS / "snippets.py", tree], words

    yield trial("a good tree", None)
    yield trial("a snippet that does not compile", "README.md:6: does not compile: 'b' was not declared", "README.md", "a / 2", "b / 2")
    yield trial("a snippet with a warning", "README.md:6: does not compile", "README.md", "int a)", "long a)")
    yield trial("a snippet that does not link", "does not compile: undefined reference", page, "int main() {",
                "int gone();\n\nint main() {\n    if (gone() == 0) return 1;")
    yield trial("a snippet that fails", "ends with 3", page, "return 0", "return 3")
    yield trial("another output", "README.md:20: the program prints '254'", page, "\n254\n", "\n253\n")
    yield trial("an output that ends early", "README.md:20: the program prints '254'", page, "\n254\n", "\n")
    yield trial("an output of nothing", "an output without a program", "README.md", "cpp fragment", "text output")
    yield trial("a block without an end", "has no end", page, "254\n```", "254\n")
    yield trial("a listing of other lines", "README.md:15: this is not what core", "README.md", "namespace fovea", "namespace fover")
    yield trial("a listing with a line left out", "this is not what core", header, "#pragma once\n", "#pragma once\n\n")
    yield trial("a listing of no file", "README.md:13: no such file: core", "README.md", "pixelwise/invert.hpp\n#", "pixelwise/gone.hpp\n#")
    yield trial("a kind of block that nobody checks", "no such kind of block: cpp sketch", "README.md", "fragment", "sketch")
    yield trial("a dead link", "README.md:3: a dead link: docs/gone.md", "README.md", "docs/operators/README.md#to-invert", "docs/gone.md")
    yield trial("a heading that is not there", "no such heading: docs/operators/README.md#to-erode", "README.md", "#to-invert", "#to-erode")
    yield trial("a header without a line", "names this header", page, "`pixelwise/invert.hpp`", "a header")
    yield trial("an operator without a line", "names erode()", header, "constexpr", "int erode(int);\nconstexpr")
    yield trial("a line without a header", "no such header: pixelwise/erode.hpp", page, "In `", "In `pixelwise/erode.hpp`, `")


def function_of_run(name):
    """A function of tests/run, to be called behind it."""
    text = (PROJECT / "tests/run").read_text()
    begin = text.index(f"\n{name}() {{\n")
    return text[begin:text.index("\n}\n", begin) + 3]


@alarm
def code_plots(folder):
    """Plots that are not those of the figures."""
    def trial(what, words, file="tests/bench/codes/robustness.csv", old="", new=""):
        tree = folder / what.replace(" ", "_")
        for path in ["tests/docs/code_plots.py", "tests/bench/codes/robustness.csv",
                     "docs/pictures/code_blur.svg", "docs/pictures/code_disturbances.svg"]:
            (tree / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(PROJECT / path, tree / path)
        if old:
            replace(tree / file, old, new)
        return what, ["bash", "-c", f"cd '{tree}' && set -e; {function_of_run('same_pictures')}\n"
                                    "same_pictures tests/docs/code_plots.py tests/bench/codes/robustness.csv"], words

    level = "EAN-13,blur at 1 px,0.3,modules,fovea,10,"
    yield trial("as they are", None)
    yield trial("a code that is not read", "code_blur.svg differ", old=f"{level}10,0", new=f"{level}9,0")
    yield trial("a code that is misread", "code_blur.svg differ", old=f"{level}10,0", new=f"{level}10,1")
    contrast = "EAN-13,contrast,50,grey levels,fovea,"
    yield trial("another level", "code_disturbances.svg differ", old=contrast, new=contrast.replace("50", "51"))
    yield trial("another colour", "code_blur.svg differ", "tests/docs/code_plots.py", "#0b6e4f", "#0b6e4e")


# ---- Golden vectors, bench, memory ---------------------------------------------------------------

OPERATOR = HEAD + "namespace fovea {\n// ---- Interface\ninline Status sharpen(ImageView<const Gray8> src);\n" \
                  "class Sharp {\npublic:\n    int edge() const;\nprivate:\n    int hidden();\n};\n" \
                  "// ---- Implementation\ninline int unseen();\n}\n"
NEW_OPERATOR = {"core/include/fovea/pixelwise/sharpen.hpp": OPERATOR}


@alarm
def bench(folder):
    def tree(name, excuse="", files=None):
        made = copy_of_project(folder / name)
        (made / "tests/bench/without_line.txt").open("a").write(excuse)
        return [CHECKS / "bench.py", write(made, files or {})]

    yield "every operator is timed", tree("good"), None
    yield "an operator without a line", tree("operator", "", NEW_OPERATOR), "pixelwise/sharpen.hpp: no line of the bench for sharpen"
    yield "the operator excused", tree("excused", "sharpen  a reason\n", NEW_OPERATOR), None
    yield "an excuse without a reason", tree("reason", "sharpen\n", NEW_OPERATOR), "no reason for sharpen"
    yield "an excuse for what has a line", tree("line", "threshold  a reason\n"), "threshold has a line"
    yield "an excuse for nothing", tree("nothing", "blur  a reason\n"), "no operator is called blur"


@alarm
def inventory(folder):
    page = "| what | `base/a.hpp` | `base/a_test.cpp` | |\n| wrong | `A.IsRight` |\n"
    good = {BASE: HEAD, "tests/core/base/a_test.cpp": SPDX + "TEST(A, IsRight) {}\n", "docs/inventory.md": page}

    def trial(what, words, old="", new=""):
        tree = write(folder / what.replace(" ", "_"), {**good, "docs/inventory.md": page.replace(old, new) if old else page})
        return what, [CHECKS / "inventory.py", tree], words

    yield trial("all is there", None)
    yield trial("a header that is gone", "docs/inventory.md:1: there is no base/b.hpp", "a.hpp", "b.hpp")
    yield trial("a test file that is gone", "there is no base/b_test.cpp", "a_test.cpp", "b_test.cpp")
    yield trial("a test that is gone", "docs/inventory.md:2: there is no A.IsWrong", "IsRight", "IsWrong")
    yield trial("a page of nothing", "names nothing", "`", "")


@alarm
def golden(folder):
    def tree(name, files=None, excuse=""):
        made = copy_of_project(folder / name)
        (made / "tests/golden/without_vector.txt").open("a").write(excuse)
        return [CHECKS / "golden.py", "--root", write(made, files or {})]

    yield "every function has its vector", tree("good"), None
    yield "an operator without one", tree("operator", NEW_OPERATOR), "pixelwise/sharpen.hpp: no golden vector for sharpen"
    yield "a member without one", tree("member", NEW_OPERATOR, "sharpen  a reason\n"), "no golden vector for Sharp::edge"
    yield "the header excused", tree("excused", NEW_OPERATOR, "pixelwise/sharpen.hpp  a reason\n"), None
    yield "an excuse without a reason", tree("reason", NEW_OPERATOR, "pixelwise/sharpen.hpp\n"), "no reason for"
    yield "an excuse for nothing", tree("nothing", {}, "blur  a reason\n"), "nothing is called blur"

    table = PROJECT / "tests/golden/golden.txt"
    lines = table.read_text().split("\n")
    name, checksum = lines[-2].split()
    lines[-2] = f"{name} {int(checksum, 16) ^ 1:08x}"
    off = write(folder, {"off.txt": "\n".join(lines)}) / "off.txt"
    yield "the table", [CHECKS / "golden.py", "--table", table, "cat", table], None
    yield "a checksum off by one", [CHECKS / "golden.py", "--table", table, "cat", off], "the bits differ"
    # That the whole tree prints the table, is a step of tests/run; without optimisation by Clang it compiles soonest.
    little = copy_of_project(folder / "little")
    replace(little / "core/include/fovea/pixelwise/to_gray.hpp", "9797, 19235", "9798, 19234")
    yield "an operator off by a little", [
        "sh", "-c", f"cd {little} && clang++ -std=c++17 -O0 -Icore/include -Itests tests/golden/table.cpp -o table && "
                    f"{CHECKS}/golden.py --table {table} ./table"], "pixelwise/to_gray"
    yield "a program that fails", [CHECKS / "golden.py", "--table", table, "false"], "ended with 1"


@alarm
def general_registers(folder):
    def trial(name, text):
        return [CHECKS / "general_registers", "g++", write(folder, {f"{name}.cpp": text}) / f"{name}.cpp"]

    yield "an operator", trial("good", "#include <fovea/pixelwise/threshold.hpp>\n"), None
    yield "a float in it", trial("bad", "int half(int a) { return static_cast<int>(a * 0.5); }\n"), "error: "


@alarm
def stack(folder):
    def trial(name, source, budget="", whole=""):
        place = write(folder / name, {"unit.cpp": source, "budget": budget})
        return ["sh", "-c", f"cd {place} && g++ -O1 -fstack-usage -c unit.cpp && "
                            f"{CHECKS}/stack.py --budget budget {whole} unit.su"]

    large = "void use(char*);\nvoid fill() { char room[%s]; use(room); }\n"
    yield "a small frame", trial("small", large % 100), None
    yield "a large frame", trial("large", large % 3000), "bytes, at most 2048: void fill()"
    yield "a large frame in the budget", trial("budget", large % 3000, "3100 fill a reason\n"), None
    yield "a frame above its budget", trial("above", large % 4000, "3100 fill a reason\n"), "at most 3100"
    yield "a frame of any size", trial("any", "void use(char*);\nvoid fill(int n) { char room[n]; use(room); }\n"), \
        "a frame of unknown size"
    yield "a budget without a reason", trial("reason", large % 100, "3100 fill\n"), "reason are wanted"
    yield "a budget that nobody needs", trial("idle", large % 100, "3100 fill a reason\n", "--whole"), \
        "fill stands in the budget"
    yield "no notes", [CHECKS / "stack.py", write(folder / "empty", {"a": ""})], "no notes"


@alarm
def memory(folder):
    for what, words in [("the page", None), ("a page with another number", "write it anew")]:
        tree = copy_of_project(folder / what.replace(" ", "_"))
        page = (PROJECT / "docs/memory.md").read_text()
        write(tree, {"docs/memory.md": page.replace("| erode, dilate | ", "| erode, dilate | 1") if words else page})
        yield what, [tree / "tests/checks/memory.py"], words


# ---- Runs ---------------------------------------------------------------------------------

@alarm
def skips(folder):
    def report(name, status, result):
        test = f'<testcase name="FindsThePart" status="{status}" result="{result}" classname="Detector"/>'
        return write(folder, {name: f"<testsuites><testsuite>{test}</testsuite></testsuites>"}) / name

    write(folder, {"none.xml": "<testsuites/>", "expected": "Detector.*   a picture\n", "nothing_expected": "# none\n"})
    here, gone = f"FOVEA_TEST_DATA={folder}", f"FOVEA_TEST_DATA={folder}/gone"

    def trial(data, expected, report):
        return ["env", data, CHECKS / "skips.py", "--expected", folder / expected, report]

    yield "a test that ran", trial(gone, "expected", report("ran.xml", "run", "completed")), None
    yield "an expected skip", trial(gone, "expected", report("skip.xml", "run", "skipped")), None
    yield "an unexpected skip", trial(gone, "nothing_expected", report("other.xml", "run", "skipped")), "must not be: Detector"
    yield "a skip although the pictures are here", trial(here, "expected", report("here.xml", "run", "skipped")), "must not be: Detector"
    yield "a disabled test", trial(gone, "nothing_expected", report("off.xml", "notrun", "suppressed")), "must not be: Detector"
    several = write(folder / "several", {"a.xml": (folder / "ran.xml").read_text(), "b.xml": (folder / "skip.xml").read_text()})
    yield "a skip in one of several reports", trial(gone, "nothing_expected", several), "must not be: Detector"
    yield "no tests", trial(gone, "expected", folder / "none.xml"), "no tests were run"
    yield "no reports", trial(gone, "expected", write(folder / "empty", {"a": ""})), "no tests were run"


@alarm
def programs(folder):
    """A true test program with a fault each; and what GoogleTest itself would never do."""
    text = """#include <gtest/gtest.h>
              #include <cstdlib>
              #include <unistd.h>
              TEST(Detector, FindsThePart) { SUCCEED(); }
              TEST(Detector, FindsTheHole) { FAULT; }"""
    for number, (what, fault, words) in enumerate([
            ("tests that pass", "SUCCEED()", None), ("a test that fails", "FAIL() << 42", "42"),
            ("a test that hangs", "std::printf(\"in the hole\"); std::fflush(stdout); ::pause()", "in the hole"),
            ("a test that crashes", "std::abort()", "test_planted ended with -6"),
            ("a test that ends the program", "std::exit(0)", "test_planted left no report"),
            ("a test that is skipped", "GTEST_SKIP()", "must not be: Detector.FindsTheHole"),
            ("a disabled test", "SUCCEED(); } TEST(Detector, DISABLED_FindsTheEdge) {", "must not be: Detector.DISABLED_FindsTheEdge")]):
        tests = write(folder / str(number) / "tests", {"planted.cpp": text.replace("FAULT", fault)})
        yield what, ["sh", "-c", f"cd {tests} && g++ planted.cpp -lgtest_main -lgtest -o test_planted && "
                                 f"{CHECKS}/programs.py --seconds 5 .. test_planted && {CHECKS}/skips.py ../reports"], words
    hanging = folder / "2"
    yield "the limit of time", [CHECKS / "programs.py", "--seconds", "0.5", hanging, "test_planted"], "ran for more than 0.5 s"
    listed = "add_test(Detector.FindsThePart {})\n"
    for what, program, words in [("what ctest lists", "tests/test_planted", "test_planted ran for more"),
                                 ("a program that was not built", "tests/gone", "not built")]:
        write(hanging, {"CTestTestfile.cmake": listed.format(hanging / program)})
        yield what, [CHECKS / "programs.py", "--seconds", "0.5", hanging], words
    yield "no programs", [CHECKS / "programs.py", write(folder / "empty", {"CTestTestfile.cmake": ""})], "0 programs"


@alarm
def run(folder):
    """tests/run must not lose the failure of a step, or take a word it does not know."""
    tree = copy_of_project(folder / "tree")
    write(tree, {BASE: HEAD + "#include <vector>\n"})
    yield "a step that fails", [tree / "tests/run", "host"], "step layers FAILED"
    yield "an unknown part", [tree / "tests/run", "boat"], "no part 'boat'"


@alarm
def sanitizers(folder):
    presets = json.loads((PROJECT / "CMakePresets.json").read_text())["configurePresets"]
    flags = next(p for p in presets if p["name"] == "sanitize")["cacheVariables"]
    options = f"{flags['CMAKE_CXX_FLAGS']} {flags['CMAKE_CXX_FLAGS_DEBUG']} -I{PROJECT}/core/include"
    faults = [("nothing", "return 0;", None), ("overflow", "return 2147483647 + argc > 0;", "signed integer overflow"),
              ("heap", "return (new int[3])[argc + 2];", "heap-buffer-overflow"),
              ("assertion", "FOVEA_ASSERT(argc > 1); return 0;", "")]
    for what, text, words in faults:
        source = write(folder, {f"{what}.cpp": f"#include <fovea/base/assert.hpp>\nint main(int argc, char**) {{ {text} }}\n"})
        yield what, ["sh", "-c", f"cd {source} && clang++ {options} {what}.cpp -o {what} && ./{what}"], words


@alarm
def threads(folder):
    """The pool of workers, once with what a worker reads written behind the post that wakes it."""
    pool = "ports/linux/include/fovea/linux/worker_pool.hpp"
    told = (PROJECT / pool).read_text()
    late = write(folder, {"late/fovea/linux/worker_pool.hpp": told}) / "late/fovea/linux/worker_pool.hpp"
    replace(late, "        pieces_ = pieces;\n", "")
    replace(late, "        take_pieces(0);\n", "        pieces_ = pieces;\n        take_pieces(0);\n")
    for what, first, words in (("as it is", "", None), ("a late write", f"-I{folder}/late", "data race")):
        program = folder / what.replace(" ", "_")
        command = (f"g++ -std=c++17 -O1 -g -fsanitize=thread {first} -I{PROJECT}/core/include -I{PROJECT}/hal/include "
                   f"-I{PROJECT}/ports/linux/include {PROJECT}/tests/ports/linux/worker_pool_test.cpp -lgtest -lgtest_main "
                   f"-pthread -o {program} && TSAN_OPTIONS=halt_on_error=1 {program}")
        yield what, ["sh", "-c", command], words


@alarm
def fuzz(folder):
    text = """#include <cstddef>
              #include <cstdint>
              extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
                  if (FAULT && size > 2 && data[0] == 'F' && data[1] == 'V') __builtin_trap();
                  return 0;
              }"""
    for fault, words in [("0", None), ("1", "fuzz_planted FAILED")]:
        build = write(folder / fault, {"planted.cpp": text})
        yield f"fault {fault}", ["sh", "-c", f"cd {build} && clang++ -fsanitize=fuzzer -DFAULT={fault} planted.cpp "
                                             f"-o fuzz_planted && {CHECKS}/fuzz.py . 20000"], words
    yield "no programs", [CHECKS / "fuzz.py", write(folder / "empty", {"a": ""})], "no programs"


# ---- Object files -------------------------------------------------------------------------

# What each must be called; with a float unit the instruction is found, without one the helper.
OBJECT_FAULTS = [
    ("integers", "int f(int a) { return a / 3; }", None),
    ("float", "int f(int a) { return int(float(a) * 1.5f); }", "float "),
    ("double", "int f(int a) { return int(double(a) / 3.0); }", "float "),
    ("malloc", "#include <cstdlib>\nvoid* f(unsigned a) { return std::malloc(a); }", "heap: malloc"),
    ("new", "int* f(int a) { return new int[unsigned(a)]; }", "heap: operator new[]"),
    ("throw", "void f(int a) { if (a) throw 3; }", "exception or type information: __cxa_throw"),
    ("guard", "struct S { int v; S(int); };\nint f(int a) { static S s(a); return s.v; }", "guard of a static"),
    ("virtual", "struct B { virtual int f() const; };\nint B::f() const { return 1; }", "exception or type information: vtable for B"),
    ("printf", "#include <cstdio>\nvoid f(int a) { std::printf(\"%d\", a); }", "input or output: "),
    ("outside", "int unknown(int);\nint f(int a) { return unknown(a); }", "unknown outside symbol: unknown(int)"),
    ("bss", "int counter;\nint f() { return ++counter; }", "mutable data: counter"),
    ("data", "int f() { static int counter = 7; return ++counter; }", "mutable data: f()::counter"),
]


def objects(folder, compilers):
    for number, compiler in enumerate(compilers):
        for what, text, words in OBJECT_FAULTS:
            source = write(folder, {f"{number}{what}.cpp": text})
            exceptions = "" if what == "throw" else "-fno-exceptions"
            yield f"{what}, {compiler}", [
                "sh", "-c", f"cd {source} && {compiler} -std=c++17 -Os -c {number}{what}.cpp {exceptions} -fno-unwind-tables "
                            f"-fno-asynchronous-unwind-tables && {CHECKS}/binary.py {number}{what}.o"], words
    yield "no objects", [CHECKS / "binary.py", write(folder / "empty", {"a": ""})], "no object files"


@alarm
def binary(folder):
    yield from objects(folder, ["g++", "clang++"])


def target_binary(folder):
    chip = "arm-none-eabi-g++ -mthumb -mcpu="
    yield from objects(folder, [chip + "cortex-m0", chip + "cortex-m4", chip + "cortex-m4 -mfloat-abi=hard",
                                chip + "cortex-m55 -mfloat-abi=hard"])


def board_binary(folder):
    yield from objects(folder, ["aarch64-linux-gnu-g++", "arm-linux-gnueabihf-g++", "riscv64-linux-gnu-g++"])


# What makes a program of the microbit, but for its own file and the arithmetic behind it.
PORT = PROJECT / "ports/bare_metal"
MICROBIT = " ".join(
    ["arm-none-eabi-g++ -std=c++17 -mcpu=cortex-m0 -mthumb -Os -fno-exceptions -fno-rtti -fno-tree-loop-distribute-patterns",
     "-nostdlib -static -Wl,--gc-sections", f"-T {PORT}/microbit/memory.ld -T {PORT}/startup/sections.ld",
     *(f"-I{PROJECT / path}" for path in ("core/include", "hal/include", "tests")), f"-I{PORT}/include -I{PORT}/microbit",
     *(f"{PORT}/startup/{file}.cpp" for file in ("start", "cortex_m", "memory"))])

# The headers of C++ are those of the Arm compiler, as in toolchains/rv32imac.cmake.
SIFIVE = " ".join(
    ["riscv64-unknown-elf-g++ -std=c++17 -march=rv32imac -mabi=ilp32 -misa-spec=2.2 -mcmodel=medany -ffreestanding -Os",
     "-fno-exceptions -fno-rtti -fno-tree-loop-distribute-patterns -nostdinc++",
     *(f"-isystem /usr/include/newlib{path}" for path in
       ("/c++/$(arm-none-eabi-gcc -dumpversion)", "/c++/$(arm-none-eabi-gcc -dumpversion)/arm-none-eabi", ""))])

# A chip's program that is as large as a fault.
CHIP = """#include <board.hpp>
#include <target/print.hpp>
extern "C" {
[[gnu::noinline]] void fovea_region_begin() { __asm volatile(""); }
[[gnu::noinline]] void fovea_region_end() { __asm volatile(""); }
void* malloc(unsigned);
}
int deeper(volatile int* above) { volatile int here[64]; here[0] = above[0]; return deeper(here) + here[0]; }
int main() {
    auto serial = fovea::board::start_serial();
    fovea::target::print(serial, BITS);
    fovea_region_begin();
    for (volatile int i = 0; i < TURNS; ++i) {}
    fovea_region_end();
    fovea::target::print(serial, "= turns\\n");
    volatile int bottom = 0;
    FAULT;
    return bottom;
}
"""


def target_chip(folder):
    """chip.py must see other bits, another count and a fault; what wants a library must not link."""
    golden = write(folder, {"chip.cpp": CHIP, "golden.txt": "bits 00000001\n"}) / "golden.txt"
    plugin = folder / "count.so"
    subprocess.run(["g++", "-std=c++17", "-shared", "-fPIC", PROJECT / "tests/target/count_instructions.cpp", "-o", plugin],
                   check=True)

    def chip(name, bits="bits 00000001", turns=10, fault="", options=""):
        return ["sh", "-c",
                f"cd {folder} && {MICROBIT} '-DBITS=\"{bits}\\n\"' -DTURNS={turns} '-DFAULT={fault}' chip.cpp -lgcc -o {name} && "
                f"{PROJECT}/tests/target/chip.py lane microbit {name} {plugin} --golden {golden} --tables {folder} {options}"]

    yield "a table", chip("table", options="--write"), None
    yield "the same", chip("same"), None
    yield "other bits", chip("bits", bits="bits 00000002"), "computes other bits"
    yield "bits that are missing", chip("missing", bits="# bits"), "computes other bits"
    yield "more instructions", chip("more", turns=11), "takes other numbers"
    yield "fewer instructions", chip("fewer", turns=9), "takes other numbers"
    yield "growth without a reason", chip("reason", turns=11, options="--write"), "have grown"
    yield "growth with a reason", chip("reason", turns=11, options="--write --because planted"), None
    yield "a wild pointer", chip("wild", fault="*reinterpret_cast<volatile int*>(0x90000000u) = 1"), "ended with 99"
    yield "a stack that is too deep", chip("deep", fault="bottom = deeper(&bottom)"), "ended with -6"
    yield "an exit code", chip("code", fault="bottom = 3"), "ended with 3"
    yield "a heap", chip("heap", fault="bottom = malloc(4) == nullptr"), "undefined reference to `malloc'"


def target_pins(folder):
    """pins.py must see a verdict that does not move, an edge that is gone, wrong bytes and a clock that stands."""
    program = (PROJECT / "tests/target/pins.cpp").read_text()
    for name, good, bad, words in [
            ("nothing", "", "", None), ("verdict", "(ok.set(true)", "(ok.set(false)", "OK and not OK must be True, False"),
            ("edge", "edge, active", "edge, gone", "'edge, active' was expected"),
            ("echo", "static_cast<char>(byte), ", "static_cast<char>(byte | 1), ", "'f' was expected"),
            ("clock", "clock.microseconds() - begin", "std::int64_t{7}", "the clock said 7 and then 7")]:
        source = write(folder, {f"{name}.cpp": program.replace(good, bad) if good else program}) / f"{name}.cpp"
        yield name, ["sh", "-c", f"cd {folder} && {MICROBIT} -DFOVEA_OUTPUTS=1 {source} -lgcc -o {name} && "
                                 f"{PROJECT}/tests/target/pins.py microbit {name}"], words


def target_watchdog(folder):
    """watchdog.py must see a watchdog that sleeps, as that of a microbit does in the emulator."""
    yield "asleep", ["sh", "-c", f"mkdir -p {folder} && cd {folder} && {MICROBIT} {PROJECT}/tests/target/watchdog.cpp -lgcc -o asleep && "
                                 f"{PROJECT}/tests/target/watchdog.py microbit asleep"], "'start' was expected, '' came"


DEPTH = """
#include <cstdint>
int fovea_sink;
using Step = int (*)(int);
[[gnu::noinline]] int large(int n) {
    volatile char room[600];
    for (int i = 0; i < 600; ++i) room[i] = static_cast<char>(n + i);
    return room[n & 511];
}
[[gnu::noinline]] int small(int n) { return fovea_sink + n; }
volatile Step chosen = STEP;
[[gnu::noinline]] int turn(int n) { return TURN; }
int main() { return turn(fovea_sink) & 1; }
"""


def target_call_depth(folder):
    """call_depth.py must see a chain that is too deep, also behind a pointer, recursion, and a run that went deeper."""
    compile_for = {
        "arm": ("arm-none-eabi-g++ -std=c++17 -mcpu=cortex-m0 -mthumb -Os -fno-exceptions", MICROBIT),
        "riscv": (SIFIVE, f"{SIFIVE} -nostdlib -static -Wl,--gc-sections -Wl,--entry=fovea_reset -T {PORT}/sifive_e/memory.ld "
                          f"-T {PORT}/startup/sections.ld -I{PROJECT}/core/include -I{PROJECT}/hal/include -I{PORT}/include "
                          f"-I{PORT}/sifive_e " + " ".join(f"{PORT}/startup/{file}.cpp" for file in ("start", "riscv", "memory")))}

    def depth(name, turn="small(n)", step="small", stack=1024, measured=0, processor="arm"):
        place = write(folder / name, {"depth.cpp": DEPTH})
        compiler, linker = compile_for[processor]
        return ["sh", "-c", f"cd {place} && {compiler} -fcallgraph-info=su '-DTURN={turn}' -DSTEP={step} -c depth.cpp -o depth.obj && "
                            f"{linker} -Wl,--defsym=fovea_stack_size={stack} depth.obj -lgcc -o program && "
                            f"{CHECKS}/call_depth.py program . --measured {measured}"]

    yield "a shallow program", depth("shallow", measured=50), None
    yield "a deep one with room", depth("deep", turn="large(n)"), None
    yield "one that is too deep", depth("too_deep", turn="large(n)", stack=512), "bytes of stack, and there are 512"
    yield "behind a pointer", depth("pointer", turn="chosen(n)", step="large", stack=512), "bytes of stack, and there are 512"
    yield "recursion", depth("recursion", turn="n > 0 ? turn(n - 1) + 1 + turn(n / 2) : 0"), "recursion: "
    yield "a frame of any size", depth("any", turn="({ volatile char room[n + 8]; room[n] = 1; room[n / 2]; })"), \
        "a frame of unknown size"
    yield "a run that went deeper", depth("measured", measured=700), "a run took 700 bytes"
    yield "RISC-V, a deep program with room", depth("riscv", "large(n)", processor="riscv"), None
    yield "RISC-V, one that is too deep", depth("riscv_deep", "large(n)", stack=512, processor="riscv"), \
        "bytes of stack, and there are 512"
    yield "RISC-V, behind a pointer", depth("riscv_pointer", "chosen(n)", "large", 512, processor="riscv"), \
        "bytes of stack, and there are 512"
    yield "no notes", ["sh", "-c", f"mkdir -p {folder}/none && {CHECKS}/call_depth.py {folder}/shallow/program {folder}/none"], \
        "no notes"


def target_firmware(folder):
    """firmware.py must see a wrong value, an error that is not told, and a pin that stays."""
    fovea = PROJECT / "build/tool/apps/fovea"
    limits = "-DFOVEA_FRAME_BYTES=3072 -DFOVEA_SCRATCH_BYTES=7168 -DFOVEA_LINE_BYTES=384 -DFOVEA_FEATURES=6 -DFOVEA_PARTS=1"
    frames = "firmware/frame_firmware.hpp"
    faults = [("nothing", "", "", "", None),
              ("value", "firmware_gauge/firmware_gauge.hpp", "(result.measurement.value, places)",
               "(result.measurement.value + Decimal{1}, places)", "the tool measured"),
              ("pins", frames, "set_outputs(Verdict::unmeasured);\n        line_.text(\"{\");", "line_.text(\"{\");",
               "OK and not OK must be"),
              ("order", frames, 'if (number_at(rest, 0) != next_line_) return fail("line missing");', "", "a line that is missing")]
    for name, file, good, bad, words in faults:
        tree = copy_of_project(folder / name)
        if file:
            replace(tree / "apps" / file, good, bad)
        yield name, ["sh", "-c", f"cd {tree} && {MICROBIT} -Iapps {limits} -Wl,--defsym=fovea_stack_size=3328 "
                                 f"apps/firmware_gauge/main.cpp -lgcc -o firmware && "
                                 f"{PROJECT}/tests/target/firmware.py microbit firmware {fovea}"], words


def target_firmware_read(folder):
    """firmware_read.py must see another text, a verdict that is wrong, a code that stays from the frame before, and a program
    that takes more memory than it is granted."""
    faults = [("nothing", "", "", "", 640, None),
              ("text", "frame_codes.hpp", "*size});\n        else", "*size - 1});\n        else", 640, "the tool reads"),
              ("verdict", "frame_codes.hpp", "verdict = Verdict::ok;", "verdict = Verdict::not_ok;", 640, "ok, None was expected"),
              ("pins", "frame_codes.hpp", "verdict = Verdict::not_ok;\n        if (status == Status::not_found",
               "verdict = Verdict::ok;\n        if (status == Status::not_found", 640, "not_ok, nothing found was expected"),
              ("a frame before", "bar_job.hpp", "stream_ = fresh(size.width);", "if (stream_.idle_scratch().size() != 8 * size.width) "
               "stream_ = fresh(size.width);", 640, "firmware_read: "),
              ("memory", "", "", "", 680, "memory_budget.txt grants it")]
    for name, file, good, bad, width, words in faults:
        tree = copy_of_project(folder / name)
        if file:
            replace(tree / "apps/firmware_read" / file, good, bad)
        yield name, ["sh", "-c", f"cd '{tree}' && {MICROBIT} -Iapps -DFOVEA_WIDTH={width} '-DFOVEA_SYMBOLOGIES=retail_symbologies()' "
                                 "-Wl,--defsym=fovea_stack_size=2432 apps/firmware_read/main.cpp -lgcc -o firmware_read_bars_microbit && "
                                 f"{PROJECT}/tests/target/firmware_read.py microbit firmware_read_bars_microbit "
                                 f"{PROJECT}/build/tool/apps/fovea"], words


def target_code_work(folder):
    """code_work.py must see a picture that takes too long, a code that is not read, one where there is none, a count that is
    missing, and a page of other numbers. An emulator that repeats what was counted stands in for the real one."""
    lines = {f"{kind} {picture} {reader} {codes}": millions
             for reader in ("read_codes", "read_qr")
             for kind, picture, codes, millions in [("with", "qr_1", 1, 20), ("with", "qr_2", 1, 30), ("without", "stones_1", 0, 100),
                                                    ("without", "stones_2", 0, 120), ("busy", "noise_1", 0, 300), ("busy", "noise_2", 0, 320)]}
    run = f"{function_of_run('same_page')}\nsame_page code_work.md {PROJECT}/tests/target/code_work.py program plugin"

    def work(name, old="", new="", millions=None, counts=None, page=""):
        """One line has other words or another count, or so many counts are written; the page is that of all as it was."""
        place = folder / name
        told = {line.replace(old, new) if line == old else line: millions if line == old and millions else count
                for line, count in lines.items()}
        for tree, seen in ((place / "before", lines), (place, told)):
            numbers = list(seen.values())[:counts if tree == place else None]
            write(tree, {"seen": "".join(f"{line}\n" for line in seen),
                         "counted": "".join(f"{count}000000\n" for count in numbers),
                         "qemu-x86_64": '#!/bin/sh\ncp counted "${2##*out=}"\ncat seen\n', "build/.keep": ""})
            (tree / "qemu-x86_64").chmod(0o755)
        return ["bash", "-c", f"set -e; cd {place}/before; PATH=.:$PATH {PROJECT}/tests/target/code_work.py program plugin > "
                              f"../code_work.md; cd ..; PATH=.:$PATH; {run}"]

    busy, with_code, without = "busy noise_2 read_codes 0", "with qr_2 read_codes 1", "without stones_1 read_codes 0"
    yield "what was counted before", work("good"), None
    # The median of the four ordinary pictures is 65.
    yield "a picture that takes too long", work("long", busy, busy, 326), "noise_2: 326 million instructions are more than 5 times 65"
    yield "a code that is not read", work("unread", with_code, with_code[:-1] + "0"), "qr_2: 0 codes were read"
    yield "a code where there is none", work("read", without, without[:-1] + "1"), "stones_1: 1 codes were read"
    yield "a count that is missing", work("missing", counts=11), "12 regions were told and 11 counted"
    yield "another count", work("count", busy, busy, 310), "code_work.md is not what"
    yield "another count of a single reader", work("single", "busy noise_2 read_qr 0", "busy noise_2 read_qr 0", 350), "code_work.md is not what"


def target_new_board(folder):
    """A port that cannot be taken into another project, or a board whose clock stands."""
    def broken(name, file, old, new):
        tree = copy_of_project(folder / name)
        shutil.copytree(PROJECT / "toolchains", tree / "toolchains")
        if file:
            replace(tree / file, old, new)
        return [CHECKS / "new_board", tree, tree / "build"]

    yield "the smallest board", broken("good", None, "", ""), None
    yield "files of a project that is another's", broken("a", "ports/bare_metal/CMakeLists.txt", "${CMAKE_CURRENT_FUNCTION_LIST_DIR}",
                                                         "${PROJECT_SOURCE_DIR}/ports/bare_metal"), "configure FAILED"
    yield "no stack", broken("b", "ports/bare_metal/rv32_virt/memory.ld", "stack_size", "stack_sizes"), "build FAILED"
    yield "a clock at no address", broken("c", "ports/bare_metal/rv32_virt/board.hpp", "0x0200BFF8", "0x02000000"), "run FAILED"


target_alarms = [target_binary, target_chip, target_pins, target_watchdog, target_call_depth, target_firmware,
                 target_firmware_read, target_code_work, target_new_board]


def board_proofs(folder):
    """ports_test.py must see a check that fails, and a program that proves nothing."""
    def says(text, status=0):
        return [PROJECT / "tests/board/proof_lines.py", "sh", "-c", f"printf '{text}'; exit {status}"]

    good = "ok a\\nfigure b = 3 us\\n1 checks, 0 failed\\n"
    yield "a program without a fault", says(good), None
    yield "a check that fails", says("ok a\\nFAILED b: 1, not 2\\n2 checks, 1 failed\\n"), "FAILED b: 1, not 2"
    yield "a status", says(good, 1), "status 1"
    yield "nothing", says(""), "0 of 0 checks passed"
    yield "no check", says("0 checks, 0 failed\\n"), "0 of 0 checks passed"
    yield "an early end", says("ok a\\n"), "1 of 0 checks passed"
    yield "lines that are missing", says("ok a\\n2 checks, 0 failed\\n"), "1 of 2 checks passed"
    yield "a figure twice", says(f"figure b = 4 us\\n{good}"), "two figures have the name b"
    program = write(folder, {"pictures_on_board": "#!/bin/sh\necho FAILED planted; echo 1 checks, 1 failed\n"}) / "pictures_on_board"
    program.chmod(0o755)
    yield "on a board", [PROJECT / "tests/board/ports_test.py", folder, "multi_planar"], "FAILED planted"


board_alarms = [board_binary, board_proofs]


@alarm
def board_invariants(folder):
    """What invariants.py sees in the record of a run: each of them broken once."""
    def result(number, frame, now_us, verdict="OK", age_us=2000):
        return {"ev": "result", "seq": number, "t_mono_us": now_us, "verdict": verdict,
                "frame": {"seq": frame, "age_us": age_us}, "us": {"answer": 90000, "judge": 1000}}

    def checked(**changes):
        answer = [[2, 1], [5, 1], [4, 1], [2, 0], [4, 0], [5, 0]]
        record = {"said": [{"ev": "start", "interval_us": 40000}, result(1, 5, 1000000), result(2, 9, 2000000, "NG")],
                  "pins": answer, "records": ["1;OK;160.1", "2;NG;?"], "edges": 2,
                  "asked": [["OK triggers 2 ok 1 ng 1 error 0 missed 0 us 1 2 3", 3]],
                  "held": [[[14, 60, 900], 2], [[14, 60, 920], 3]], "calls": [["F1", "away", 60, 20, 4.0, 0]],
                  "faults": []}
        record.update(changes)
        name = folder / f"{len(list(folder.iterdir()))}.json"
        name.write_text(json.dumps(record))
        return [PROJECT / "tests/board/invariants.py", name]

    said = json.loads(checked()[1].read_text())["said"]
    lost, back = {"ev": "camera_lost", "reason": "No such device"}, {"ev": "camera_back"}
    yield "a run without a fault", checked(), None
    yield "an answer twice", checked(said=[*said, result(2, 12, 3000000)]), "I1: triggers are numbered [1, 2, 2]"
    anew = [said[0], {"ev": "reload"}]
    yield "numbers that go on", checked(said=[*said, *anew, result(3, 2, 3000000)], edges=3), None
    yield "numbers that begin anew", checked(said=[*said, *anew, result(1, 2, 3000000)], edges=3), "I1: triggers are numbered [1, 2, 1]"
    missed = {"ev": "trigger_missed", "seq": 3}
    yield "a trigger that came in between", checked(said=[*said[:2], missed, said[2]], edges=3, asked=[]), None
    swapped = [said[0], {**said[2], "seq": 2}, {**said[1], "seq": 1}]
    yield "results in another order", checked(said=swapped, asked=[], records=[]), "I1: results are not in order"
    yield "an edge without an answer", checked(edges=3), "I1: 3 edges, 2 answers"
    yield "other statistics", checked(asked=[["triggers 2 ok 2 ng 0 error 0 missed 0", 3]]), "I1: {'ok': 1"
    yield "another verdict on the serial line", checked(records=["1;NG;1"]), "I1: on the serial line alone"
    yield "an old frame", checked(said=[*said[:2], result(2, 9, 2000000, "NG", age_us=50000)]), "I2: NG of trigger 2: its frame began 1000"
    yield "a frame twice", checked(said=[*said[:2], result(2, 5, 2000000, "NG")]), "I2: NG of trigger 2 of frame 5"
    yield "a verdict without a camera", checked(said=[*said[:2], lost, said[2], back], asked=[]), "while camera_lost"
    yield "OK and NG", checked(pins=[[5, 1], [6, 1]]), "I3: change 1: OK and NG together"
    yield "VALID alone", checked(pins=[[4, 1]]), "I3: change 0: VALID with neither"
    yield "a file too many", checked(held=[[[14, 60, 900], 2], [[15, 60, 900], 3]]), "I4: 14 files were open, and are 15"
    yield "more memory", checked(held=[[[14, 60, 900], 2], [[14, 60, 965], 3]]), "I4: mappings and KiB were"
    yield "a loop that spins", checked(calls=[["F1", "away", 81, 20, 4.0, 0]]), "I5: away: 81 calls in 4.0 s"
    yield "turns without frames", checked(calls=[["F14", "stuck", 900, 325, 4.0, 60]]), "I5: stuck: 85 turns that no frame brought"
    yield "a fault told twice", checked(said=[*said, lost, lost, back]), "I6: camera_lost twice"
    yield "a fault without an end", checked(said=[*said, lost], faults=[["F1", "camera_lost", 1]]), "I6: no end of {'camera_lost'}"
    yield "a fault that nobody provoked", checked(said=[*said, lost, back]), "I6: {} were provoked"
    yield "no reason", checked(said=[*said, {**lost, "reason": "ok"}, back]), "I6: no reason"


@alarm
def faults_page(folder):
    """A page of another text than is printed, a proof that is gone, figures that are missing."""
    copies = PROJECT / "tests/board/faults_page.py"
    page = PROJECT / "docs/faults.md"
    other = write(folder, {"other.md": page.read_text().replace("never lent", "lent")}) / "other.md"
    yield "the page as it is", [copies, "--check", page], None
    yield "another text", [copies, "--check", other], "is not what faults_page.py prints"
    figures = write(folder, {"figures": "a figure that nobody knows = 3 us\n"}) / "figures"
    yield "other figures", [copies, "--check", page, figures], "has other figures"
    tree = folder / "tests"
    shutil.copytree(PROJECT / "tests/board", tree / "board")
    shutil.copytree(PROJECT / "tests/apps/daemon", tree / "apps/daemon")
    shutil.copytree(PROJECT / "tests/ports", tree / "ports")
    shutil.copytree(PROJECT / "tests/hal", tree / "hal")
    replace(tree / "hal/frame_time_test.cpp", "RunsOverFromTheLastNumberToTheFirst", "IsCalledOtherwise")
    yield "a proof that is gone", [tree / "board/faults_page.py", "--check", page], "F7: there is no SequenceGaps"


# ---- All of them --------------------------------------------------------------------------

def ring(function, folder):
    """The lines of one alarm: what rang, and what did not."""
    rang, silent = [], []
    for what, command, words in function(folder):
        result = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                errors="replace")
        name = f"{function.__name__}: {what}"
        if words is None and result.returncode != 0:
            silent.append(f"{name}: must pass, but\n{result.stdout}")
        elif words is not None and (result.returncode == 0 or words not in result.stdout):
            silent.append(f"{name}: must fail with '{words}', but (exit {result.returncode})\n{result.stdout}")
        else:
            rang.append(f"{name}: " + ("silent, as it should be" if words is None else "rang"))
    return rang, silent


def main():
    names = sys.argv[1:]
    parts = {"host": alarms, "target": target_alarms, "board": board_alarms}
    every = [function for part in parts.values() for function in part]
    if len(names) < 2 and (names or ["host"])[0] in parts:
        chosen = parts[(names or ["host"])[0]]
    else:
        chosen = [function for function in every if function.__name__ in names]
        if len(chosen) != len(names):
            sys.exit(f"alarms: there are {', '.join(function.__name__ for function in every)}")
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(os.cpu_count()) as pool:
        folders = [Path(folder) / function.__name__ for function in chosen]
        for place in folders:
            place.mkdir()
        results = list(pool.map(ring, chosen, folders))
    rang = [line for result in results for line in result[0]]
    silent = [line for result in results for line in result[1]]
    print("\n".join(rang + silent))
    print(f"alarms: {len(rang)} trials as they should be, {len(silent)} not")
    return 1 if silent else 0


sys.exit(main())
