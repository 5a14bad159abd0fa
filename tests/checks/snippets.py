#!/usr/bin/env python3
"""README.md and the pages of docs/: their C++ compiles and prints what they say, their links lead somewhere, and every
operator stands on a page of docs/operators.

usage: snippets.py [ROOT]     prints one line a finding and fails if there is one

    ```cpp            compiled as it stands; a block with a main() is also linked and run, and must answer 0
    ```cpp fragment   not compiled: a signature, a shape of code
    ```text output    what the block before it prints, exactly
    ```cpp file PATH  lines of a file, as they stand there one after the other; in any language
"""
import os
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.dont_write_bytecode = True  # the tree stays as it is
from declarations import FOUNDATIONS, declared, interface_of, without_comments

COMPILER = ["g++", "-std=c++17", "-Wall", "-Wextra", "-Wconversion", "-Werror"]
PATIENCE_SECONDS = 20
PLAIN_WORDS = {**os.environ, "LC_ALL": "C"}  # of the compiler

LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
LISTING = re.compile(r"\w+ file (\S+)")
MAIN = re.compile(r"^int main\(", re.MULTILINE)

findings = []


def find(path, line, text):
    findings.append(f"{path}:{line}: {text}" if line else f"{path}: {text}")


class Block:
    """A fenced block of a page, and what stands behind the three ticks in front of it."""

    def __init__(self, page, line, kind):
        self.page, self.line, self.kind = page, line, kind
        self.lines = []
        self.output = None

    def text(self):
        return "".join(line + "\n" for line in self.lines)


class Page:
    def __init__(self, root, path):
        self.path = path.relative_to(root)
        self.folder = path.parent
        self.blocks, prose, block = [], [], None
        for number, line in enumerate(path.read_text().split("\n"), 1):
            if not line.startswith("```"):
                (prose if block is None else block.lines).append(line)
                if block is not None:
                    prose.append("")
            else:
                prose.append("")
                if block is None:
                    block = Block(self.path, number, line[3:].strip())
                    self.blocks.append(block)
                else:
                    block = None
        if block is not None:
            find(self.path, block.line, "this block has no end")
        self.anchors = anchors_of(prose)
        self.text = "\n".join(prose)
        # Code in a line may look like a link.
        self.links = re.sub(r"`[^`\n]*`", "", self.text)


def anchors_of(lines):
    """The names under which a heading can be reached, as GitHub makes them."""
    anchors = set()
    for line in lines:
        if heading := re.match(r"#+ (.*)", line):
            words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading[1]).strip().lower()
            name = re.sub(r"[^\w\- ]", "", words).replace(" ", "-")
            again = sum(a == name or re.fullmatch(re.escape(name) + r"-\d+", a) is not None for a in anchors)
            anchors.add(f"{name}-{again}" if again else name)
    return anchors


# ---- Code ---------------------------------------------------------------------------------

def programs_of(page):
    """The blocks to compile, each with the output that the page states."""
    programs, before = [], None
    for block in page.blocks:
        if block.kind == "text output":
            if before is None or before.kind != "cpp" or not MAIN.search(before.text()):
                find(page.path, block.line, "an output without a program in front of it")
            else:
                before.output = block
        elif block.kind == "cpp":
            programs.append(block)
        elif block.kind.startswith(("c++", "cpp")) and block.kind != "cpp fragment" and not LISTING.fullmatch(block.kind):
            find(page.path, block.line, f"no such kind of block: {block.kind}")
        before = block
    return programs


def picture_in(folder):
    """The picture for a program that takes one: a dark square on bright ground, 640 x 480 pixels."""
    path = folder / "picture.pgm"
    rows = [bytes(20 if 200 <= x < 300 and 100 <= y < 200 else 220 for x in range(640)) for y in range(480)]
    path.write_bytes(b"P5\n640 480\n255\n" + b"".join(rows))
    return str(path)


def check_program(block, folder, includes):
    """What is wrong with a block: (line, text), or None."""
    source, program = folder / "snippet.cpp", folder / "snippet"
    source.write_text(f'#line {block.line + 1} "{block.page}"\n{block.text()}')
    runs = MAIN.search(block.text()) is not None
    goal = ["-o", str(program)] if runs else ["-fsyntax-only"]
    compiled = subprocess.run([*COMPILER, *includes, str(source), *goal], cwd=folder, env=PLAIN_WORDS,
                              capture_output=True, text=True)
    if compiled.returncode != 0:
        error = re.search(r":(\d+):\d+: (?:fatal )?error: (.*)", compiled.stderr)
        undefined = re.search(r"undefined reference.*", compiled.stderr)
        words = error[2] if error else undefined[0] if undefined else compiled.stderr.strip().split("\n")[-1]
        return int(error[1]) if error else block.line, f"does not compile: {words}"
    if not runs:
        return None
    try:
        arguments = [picture_in(folder)] if "argv[1]" in block.text() else []
        ran = subprocess.run([str(program), *arguments], cwd=folder, capture_output=True, text=True, timeout=PATIENCE_SECONDS)
    except subprocess.TimeoutExpired:
        return block.line, f"runs for more than {PATIENCE_SECONDS} s"
    if ran.returncode != 0:
        return block.line, f"ends with {ran.returncode}"
    if block.output is None or ran.stdout == block.output.text():
        return None
    stated, printed = block.output.lines, ran.stdout.split("\n")
    row = next(i for i in range(len(stated) + 1) if stated[i:i + 1] != printed[i:i + 1])
    return block.output.line + 1 + row, f"the program prints '{''.join(printed[row:row + 1])}'"


def check_code(root, pages):
    includes = [f"-I{p}" for part in ("core", "hal", "ports") for p in sorted((root / part).rglob("include")) if p.is_dir()]
    programs = [block for page in pages for block in programs_of(page)]
    with tempfile.TemporaryDirectory() as place, ThreadPoolExecutor(2) as pool:
        folders = [Path(place) / str(number) for number in range(len(programs))]
        for folder in folders:
            folder.mkdir()
        verdicts = list(pool.map(check_program, programs, folders, [includes] * len(programs)))
    for block, verdict in zip(programs, verdicts):
        if verdict:
            find(block.page, *verdict)
    return len(programs)


def check_listings(root, pages):
    """A listing must stand in its file; where it does not, the first line that is not there."""
    count = 0
    for block in (block for page in pages for block in page.blocks):
        if not (listing := LISTING.fullmatch(block.kind)):
            continue
        count += 1
        path = root / listing[1]
        if not path.is_file():
            find(block.page, block.line, f"no such file: {listing[1]}")
        elif "\n" + block.text() not in "\n" + (text := path.read_text()):
            lines = text.split("\n")
            row = next((i for i, line in enumerate(block.lines) if line not in lines), 0)
            find(block.page, block.line + 1 + row, f"this is not what {listing[1]} says")
    return count


# ---- Links --------------------------------------------------------------------------------

def check_links(root, pages):
    anchors = {(root / page.path): page.anchors for page in pages}
    count = 0
    for page in pages:
        for link in LINK.finditer(page.links):
            target, _, heading = link[1].partition("#")
            if re.match(r"[a-z]+:", target):
                continue
            count += 1
            line = page.links.count("\n", 0, link.start()) + 1
            path = (page.folder / target).resolve() if target else root / page.path
            if not path.is_relative_to(root) or not path.exists():
                find(page.path, line, f"a dead link: {link[1]}")
            elif heading and path in anchors and heading not in anchors[path]:
                find(page.path, line, f"no such heading: {link[1]}")
    return count


# ---- Operators ----------------------------------------------------------------------------

def check_operators(root, pages):
    """Every header and every function of the operators is named, and no page names a header that is not there."""
    include = root / "core/include/fovea"
    text = "\n".join(page.text for page in pages if page.path.parts[:2] == ("docs", "operators"))
    code = " ".join(re.findall(r"`([^`\n]*)`", text))
    named = set(re.findall(r"[a-z_0-9]+/[a-z_0-9]+\.hpp", code))
    words = set(re.findall(r"\w+", code))
    folders = {path.name for path in include.iterdir() if path.is_dir()}
    count = 0
    for header in sorted(include.rglob("*.hpp")):
        name = header.relative_to(include).as_posix()
        if header.parent.name in FOUNDATIONS:
            continue
        if name not in named:
            find(header.relative_to(root), None, "no page of docs/operators names this header")
        functions = [f for f in declared(without_comments(interface_of(header.read_text()))) if "::" not in f]
        for function in sorted(set(functions)):
            count += 1
            if function not in words:
                find(header.relative_to(root), None, f"no page of docs/operators names {function}()")
    for page in pages:
        for found in re.finditer(r"`([a-z_]+)/([a-z_0-9]+\.hpp)`", page.text):
            if found[1] in folders and not (include / found[1] / found[2]).exists():
                find(page.path, page.text.count("\n", 0, found.start()) + 1, f"no such header: {found[1]}/{found[2]}")
    return count


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[2]).resolve()
    pages = [Page(root, path) for path in [root / "README.md", *sorted((root / "docs").rglob("*.md"))]]
    links = check_links(root, pages)
    operators = check_operators(root, pages)
    programs = check_code(root, pages)
    listings = check_listings(root, pages)
    print("\n".join(findings) if findings else
          f"snippets: {programs} compile, {listings} are lines of files, {links} links lead somewhere, "
          f"{operators} functions are told of")
    return 1 if findings else 0


sys.exit(main())
