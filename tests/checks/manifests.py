#!/usr/bin/python3
"""The files by which other build systems take fovea in: each says what CMakeLists.txt says, names what is there, and
builds a program.

usage: manifests.py [ROOT [NAME...]]     prints one line a finding and fails if there is one; the names are

    zephyr      zephyr/module.yml by the keys that Zephyr knows; its Kconfig read by kconfiglib, of which Zephyr has a
                copy; its CMakeLists.txt called by a stand-in for Zephyr's build
    esp_idf     idf_component.yml by the keys that its component manager knows; CMakeLists.txt read as a script and then
                as a part of the build by a stand-in for ESP-IDF's
    platformio  library.json by PlatformIO's rules; what it exports, alone, compiled with the include folders it names
    arduino     ports/arduino/library.properties by Arduino's specification; the library that library.cmake makes, with a
                sketch that Arduino's own builder compiles for this machine and runs, and compiled for a Cortex-M0+

west, ESP-IDF and PlatformIO themselves are in no package of Debian: what they would say is checked as far as their
rules are published, and against stand-ins. The modules of Python are Debian's, hence the first line.
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

import kconfiglib
import yaml

SEMANTIC_VERSION = re.compile(r"\d+\.\d+\.\d+")
CONSUMERS = Path(__file__).resolve().parents[1] / "consumers"

findings = []


def find(path, text):
    findings.append(f"{path}: {text}")


class Project:
    """What CMakeLists.txt and LICENSE say of the project; every manifest must say the same."""

    def __init__(self, root):
        self.root = root
        text = (root / "CMakeLists.txt").read_text()
        self.name, self.version = re.search(r"project\((\w+) VERSION (\S+)", text).groups()
        self.description = re.search(r'DESCRIPTION "([^"]+)"', text)[1]
        self.licence = re.match(r"(\w+) License\n", (root / "LICENSE").read_text())[1]

    def compare(self, path, said, **where):
        """where: what a manifest calls a fact, by the name of that fact here."""
        for fact, key in where.items():
            if said.get(key) != getattr(self, fact):
                find(path, f"{key} is {said.get(key)!r}, CMakeLists.txt and LICENSE say {getattr(self, fact)!r}")

    def exists(self, manifest, name, is_kind=Path.exists):
        if is_kind(self.root / name):
            return True
        find(manifest, f"no such path: {name}")
        return False


def check_keys(path, said, required, optional, of=""):
    for key in sorted(required - said.keys()):
        find(path, f"{of}{key} is missing")
    for key in sorted(said.keys() - required - optional):
        find(path, f"no such field: {of}{key}")


def loaded(path, parse):
    """The mapping in a manifest; empty, with a finding, where there is none."""
    try:
        said = parse(path.read_text())
    except (OSError, ValueError, yaml.YAMLError) as error:
        find(path.name, f"cannot be read: {' '.join(str(error).split())}")
        return {}
    if not isinstance(said, dict):
        find(path.name, "is no mapping")
        return {}
    return said


def runs(path, *command, output=None, **options):
    """True if a command succeeds, and prints what it must."""
    ran = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)
    if ran.returncode != 0:
        lines = [line for line in ran.stdout.split("\n") if re.search(r"error|Error", line)] or ran.stdout.strip().split("\n")
        find(path, f"{Path(command[0]).name} failed: {' '.join(lines[0].split())}\n{ran.stdout.rstrip()}")
    elif output is not None and ran.stdout != output:
        find(path, f"{Path(command[0]).name} printed {ran.stdout!r}")
    else:
        return True
    return False


def builds(path, consumer, folder, *options):
    """Configures, builds and runs a program of tests/consumers."""
    return (runs(path, "cmake", "-S", CONSUMERS / consumer, "-B", folder, "-G", "Ninja", *options) and
            runs(path, "cmake", "--build", folder) and runs(path, folder / "consumer"))


# ---- Zephyr -------------------------------------------------------------------------------

def zephyr(project, place):
    name = "zephyr/module.yml"
    said = loaded(project.root / name, yaml.safe_load)
    build = said.get("build", {})
    check_keys(name, said, {"name", "build"}, {"tests", "samples", "boards", "blobs", "security"})
    check_keys(name, build, {"cmake", "kconfig"}, {"depends", "settings"}, of="build.")
    project.compare(name, said, name="name")
    cmake, kconfig = build.get("cmake", ""), build.get("kconfig", "")
    if not project.exists(name, f"{cmake}/CMakeLists.txt", Path.is_file) or not project.exists(name, kconfig, Path.is_file):
        return
    configure(project, kconfig)
    module = [f"-DFOVEA={project.root}", f"-DMODULE_CMAKE={project.root / cmake}"]
    builds(name, "zephyr", place / "with", *module, "-DCONFIG_FOVEA=y")
    # Without the symbol the headers stay out of the application.
    subprocess.run(["cmake", "-S", CONSUMERS / "zephyr", "-B", place / "without", "-G", "Ninja", *module], capture_output=True)
    if "fovea/hal" not in subprocess.run(["cmake", "--build", place / "without"], capture_output=True, text=True).stdout:
        find(f"{cmake}/CMakeLists.txt", "the headers are there although CONFIG_FOVEA is not set")


def configure(project, kconfig):
    """CONFIG_FOVEA can be had with C++17 alone, and brings the whole standard library."""
    os.environ["MODULE_KCONFIG"] = str(project.root / kconfig)
    try:
        tree = kconfiglib.Kconfig(str(CONSUMERS / "zephyr/Kconfig"), warn_to_stderr=False)
    except kconfiglib.KconfigError as error:
        find(kconfig, f"cannot be read: {' '.join(str(error).split())}")
        return
    for warning in tree.warnings:
        find(kconfig, " ".join(warning.split()))
    if "FOVEA" not in tree.syms:
        find(kconfig, "there is no FOVEA")
        return
    for standard, answer in [(None, "n"), ("STD_CPP14", "n"), ("STD_CPP17", "y"), ("STD_CPP20", "y")]:
        tree.unset_values()
        tree.syms["FOVEA"].set_value("y")
        if standard:
            tree.syms["CPP"].set_value("y")
            tree.syms[standard].set_value("y")
        for symbol in "FOVEA", "REQUIRES_FULL_LIBCPP":
            if tree.syms[symbol].str_value != answer:
                find(kconfig, f"{symbol} is {tree.syms[symbol].str_value} with {standard or 'C alone'}")


# ---- ESP-IDF ------------------------------------------------------------------------------

def esp_idf(project, place):
    name = "idf_component.yml"
    said = loaded(project.root / name, yaml.safe_load)
    check_keys(name, said, {"version", "description", "license", "dependencies"},
               {"maintainers", "tags", "targets", "files", "examples", "url", "repository", "documentation", "issues", "discussion"})
    project.compare(name, said, version="version", licence="license", description="description")
    needed = said.get("dependencies", {}).get("idf", {}).get("version", "")
    if not re.fullmatch(r">=\d+\.\d+(\.\d+)?", needed):
        find(name, f"dependencies.idf.version is no range: {needed!r}")
    files = said.get("files", {})
    check_keys(name, files, set(), {"exclude", "include", "use_gitignore"}, of="files.")
    for pattern in [*files.get("exclude", []), *files.get("include", [])]:
        if not any(project.root.glob(pattern)):
            find(name, f"no such path: {pattern}")
    # As the component manager hands it out: without what is excluded.
    component = place / project.name
    for path in "core", "hal":
        shutil.copytree(project.root / path, component / path)
    for pattern in files.get("exclude", []):
        for path in sorted(component.glob(pattern), reverse=True):
            path.rmdir() if path.is_dir() else path.unlink()
    shutil.copy(project.root / "CMakeLists.txt", component)
    builds("CMakeLists.txt", "esp_idf", place / "build", f"-DFOVEA={component}")


# ---- PlatformIO ---------------------------------------------------------------------------

def platformio(project, place):
    name = "library.json"
    said = loaded(project.root / name, json.loads)
    check_keys(name, said, {"name", "version", "description", "license", "build", "export"},
               {"keywords", "authors", "homepage", "repository", "frameworks", "platforms", "headers", "examples", "dependencies"})
    project.compare(name, said, name="name", version="version", licence="license", description="description")
    for word in said.get("keywords", []):
        if not re.fullmatch(r"[a-z\d+. -]{1,50}", word):
            find(name, f"no keyword: {word!r}")
    for author in said.get("authors", []):
        check_keys(name, author, {"name"}, {"email", "url", "maintainer"}, of="authors.")
    build = said.get("build", {})
    check_keys(name, build, {"srcDir", "includeDir"}, {"flags", "unflags", "srcFilter", "libArchive", "libLDFMode",
                                                       "libCompatMode"}, of="build.")
    export = said.get("export", {})
    check_keys(name, export, {"include"}, {"exclude"}, of="export.")
    here = [path for path in export.get("include", []) if project.exists(name, path)]
    for path in {name, "LICENSE"} - set(here):
        find(name, f"{path} is not exported")
    # As a package holds it: nothing but what is exported.
    package = place / project.name
    for path in here:
        (package / path).parent.mkdir(parents=True, exist_ok=True)
        (shutil.copytree if (project.root / path).is_dir() else shutil.copy)(project.root / path, package / path)
    folders = [package / build[key] for key in ("includeDir", "srcDir") if key in build]
    for folder in folders:
        if not folder.is_dir():
            find(name, f"no such path in the package: {folder.relative_to(package)}")
    for source in [path for folder in folders for path in folder.rglob("*") if path.suffix in {".c", ".cpp", ".S"}]:
        find(name, f"{source.relative_to(package)} would be compiled into the library")
    program = place / "program"
    if runs(name, "g++", "-std=gnu++17", *(f"-I{folder}" for folder in folders), CONSUMERS / "chip.cpp", "-o", program):
        runs(name, program)


# ---- Arduino ------------------------------------------------------------------------------

ARDUINO_CATEGORIES = {"Display", "Communication", "Signal Input/Output", "Sensors", "Device Control", "Timing",
                      "Data Storage", "Data Processing", "Other"}


def properties(text):
    lines = [line for line in text.split("\n") if line and not line.startswith("#")]
    if odd := [line for line in lines if "=" not in line]:
        raise ValueError(f"no property: {odd[0]}")
    return {key.strip(): value.strip() for key, value in (line.split("=", 1) for line in lines)}


def arduino(project, place):
    name = "ports/arduino/library.properties"
    said = loaded(project.root / name, properties)
    check_keys(name, said, {"name", "version", "author", "maintainer", "sentence", "paragraph", "category", "url", "architectures"},
               {"includes", "depends", "license", "dot_a_linkage", "precompiled", "ldflags"})
    project.compare(name, said, name="name", version="version", licence="license")
    # url is where a person may read on: whoever publishes the library has one.
    for key in sorted(key for key, value in said.items() if not value and key != "url"):
        find(name, f"{key} is empty")
    if said.get("category") not in ARDUINO_CATEGORIES:
        find(name, f"no such category: {said.get('category')}")
    if not said.get("sentence", "").startswith(project.description):
        find(name, f"sentence does not begin as the description in CMakeLists.txt: {project.description}")

    if findings or not runs(name, "cmake", f"-DOUT={place}", "-P", project.root / "ports/arduino/library.cmake"):
        return
    library = place / project.name
    for header in said.get("includes", "").split(","):
        if not (library / "src" / header.strip()).is_file():
            find(name, f"no such header in src: {header}")
    packed = {path for path in zipfile.ZipFile(place / f"{project.name}.zip").namelist() if not path.endswith("/")}
    if packed != {path.relative_to(place).as_posix() for path in library.rglob("*") if path.is_file()}:
        find(name, f"{project.name}.zip does not hold the library")
    sketches = sorted(library.glob("examples/*/*.ino"))
    if not sketches or any(sketch.stem != sketch.parent.name for sketch in sketches):
        find(name, "an example is examples/NAME/NAME.ino")
        return

    older = subprocess.run(["g++", "-std=gnu++14", "-fsyntax-only", "-x", "c++", library / "src/fovea.h"], capture_output=True, text=True)
    if older.stderr.count("error: ") != 1 or "fovea needs C++17" not in older.stderr:
        find(name, "fovea.h does not say that it needs C++17, and no more")
    hardware, build = CONSUMERS / "arduino/hardware", place / "build"
    build.mkdir()
    if runs(name, "arduino-builder", "-compile", "-quiet", "-hardware", "/usr/share/arduino-builder", "-hardware", hardware,
            "-tools", "/usr/bin", "-libraries", place, "-fqbn", "fovea:host:host", "-build-path", build, sketches[0]):
        runs(name, build / f"{sketches[0].name}.elf", output="parts: 2\n")
    core = hardware / "fovea/host/cores/host"
    runs(name, "arm-none-eabi-g++", "-c", "-Os", "-std=gnu++17", "-mcpu=cortex-m0plus", "-mthumb", "-fno-exceptions", "-fno-rtti",
         f"-I{core}", f"-I{library / 'src'}", "-include", "Arduino.h", "-x", "c++", sketches[0], "-o", place / "sketch.o")


# ---- All of them --------------------------------------------------------------------------

def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[2]).resolve()
    project = Project(root)
    checks = {function.__name__: function for function in (zephyr, esp_idf, platformio, arduino)}
    names = sys.argv[2:] or list(checks)
    for name in names:
        with tempfile.TemporaryDirectory() as place:
            checks[name](project, Path(place).resolve())
    print("\n".join(findings) if findings else f"manifests: {', '.join(names)} build with {project.name} {project.version}")
    return 1 if findings else 0


sys.exit(main())
