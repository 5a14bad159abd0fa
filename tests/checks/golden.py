#!/usr/bin/env python3
"""Golden vectors: every public function has one, and every processor computes the same.

usage: golden.py [--root ROOT]              each function in the Interface part of a core header is called by
                                            tests/golden/*_vectors.hpp or stands in tests/golden/without_vector.txt
       golden.py --table FILE COMMAND...    the command prints the table in FILE
"""
import argparse
import difflib
import fnmatch
import re
import subprocess
import sys
from pathlib import Path

# In front of these no function or type is declared.
NO_DECLARATION = re.compile(r"^\s*(using|static_assert|typedef|friend|#|template\s*<[^>]*>\s*using)\b")
FUNCTION = re.compile(r"(?<![\w.>~])(~?[A-Za-z_]\w*)\s*\(")
NOT_FUNCTIONS = {"decltype", "sizeof", "alignof", "noexcept", "static_assert", "operator"}
INTERNAL = {"detail", "kernels"}


def without_comments(text):
    text = re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.DOTALL)
    text = re.sub(r'"(\\.|[^"\\])*"|\'(\\.|[^\'\\])*\'', '""', text)
    text = re.sub(r"\[\[.*?\]\]", "", text)
    return re.sub(r"^\s*#(?:[^\n]*\\\n)*[^\n]*", "", text, flags=re.MULTILINE)


def interface_of(text):
    """The part between the two headings; all of a header without them."""
    start, end = text.find("// ---- Interface"), text.find("// ---- Implementation")
    return text[max(start, 0):end if end >= 0 else len(text)]


def opened_scope(statement):
    """What a brace opens behind these words: (kind, name)."""
    words = re.sub(r"template\s*<.*?>\s*(?=class|struct|inline|constexpr|friend|void|\w)", "", statement, flags=re.DOTALL).strip()
    if found := re.match(r"(?:inline\s+)?namespace\s+([\w:]+)", words):
        return "namespace", found[1].split("::")[-1]
    if found := re.match(r"(class|struct|union)\s+(\w+)(?:\s+final)?\s*(?::[^:].*)?$", words, re.DOTALL):
        return found[1], found[2]
    if found := re.match(r"enum\s+(?:class\s+|struct\s+)?(\w+)", words):
        return "enum", found[1]
    return "body", ""


def declared(text):
    """The public functions: of namespaces by name, of classes as Class::member."""
    scopes, public, statement, names = [], [True], "", []

    def function_in(words):
        before = words.split("=")[0] if "operator" not in words else ""
        if NO_DECLARATION.match(before) or not public[-1]:
            return
        plain = re.sub(r"template\s*<[^;{}]*?>\s+(?=\w)", "", before, count=1, flags=re.DOTALL)
        for found in FUNCTION.finditer(plain):
            # What ends in _ is a member that a constructor sets.
            if found[1] not in NOT_FUNCTIONS and not found[1].startswith("~") and not found[1].endswith("_"):
                owner = scopes[-1][1] + "::" if scopes and scopes[-1][0] in ("class", "struct", "union") else ""
                names.append(owner + found[1])
                return

    for character in text:
        inside_body = any(kind == "body" for kind, _ in scopes)
        if character == "{":
            kind, name = opened_scope(statement) if not inside_body else ("body", "")
            if kind == "body" and not inside_body:
                function_in(statement)
            hidden = not public[-1] or (kind == "namespace" and name in INTERNAL)
            scopes.append((kind, name))
            public.append(not hidden and kind != "class")
            statement = ""
        elif character == "}":
            if scopes:
                scopes.pop()
                public.pop()
            statement = ""
        elif character == ";":
            if not inside_body and not (scopes and scopes[-1][0] == "enum"):
                function_in(statement)
            statement = ""
        else:
            statement += character
            if found := re.search(r"\b(public|private|protected)\s*:$", statement):
                if scopes and scopes[-1][0] in ("class", "struct", "union") and all(
                        kind != "namespace" or name not in INTERNAL for kind, name in scopes):
                    public[-1] = found[1] == "public"
                statement = ""
    return sorted(set(names))


def is_used(name, vectors):
    last = name.split("::")[-1]
    # Called; or, for a function, handed over by its name; or, for a constructor, its type named.
    called = rf"\b{last}\b\s*(<[^;()]*>)?\s*[({{]"
    return bool(re.search(called if "::" in name and not last[0].isupper() else rf"\b{last}\b", vectors))


def check_coverage(root):
    include = root / "core/include/fovea"
    vectors = "".join(without_comments(path.read_text()) for path in sorted((root / "tests/golden").glob("*.hpp")))
    lines = [line for line in (root / "tests/golden/without_vector.txt").read_text().split("\n")
             if line and not line.startswith("#")]
    entries = [line.split(maxsplit=1) for line in lines]
    findings = [f"without_vector.txt: no reason for {entry[0]}" for entry in entries if len(entry) < 2]
    useful, count = set(), 0
    for header in sorted(include.rglob("*.hpp")):
        place = header.relative_to(include).as_posix()
        names = declared(without_comments(interface_of(header.read_text())))
        count += len(names)
        for name in names:
            excuses = {entry[0] for entry in entries if entry[0] == place or fnmatch.fnmatchcase(name, entry[0])}
            useful |= excuses
            if not excuses and not is_used(name, vectors):
                findings.append(f"{place}: no golden vector for {name}")
    findings += [f"without_vector.txt: nothing is called {entry[0]}" for entry in entries if entry[0] not in useful]
    if count == 0:
        findings.append("no public functions found")
    print("\n".join(findings) if findings else f"golden: {count} public functions, all of them in vectors or excused")
    return 1 if findings else 0


def check_table(table, command):
    expected = [line for line in Path(table).read_text().split("\n") if line and not line.startswith("#")]
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode != 0:
        print(f"golden: {' '.join(command)} ended with {run.returncode}\n{run.stderr}")
        return 1
    printed = run.stdout.split("\n")[:-1]
    different = [line for line in difflib.unified_diff(expected, printed, table, "computed here", n=0, lineterm="")]
    print("\n".join(different) if different else f"golden: {len(printed)} checksums as in the table")
    if different:
        print("golden: the bits differ")
    return 1 if different or not printed else 0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--root", type=Path, default=Path(__file__).parents[2])
    parser.add_argument("--table")
    parser.add_argument("command", nargs=argparse.REMAINDER)
    options = parser.parse_args()
    return check_table(options.table, options.command) if options.table else check_coverage(options.root)


if __name__ == "__main__":
    sys.exit(main())
