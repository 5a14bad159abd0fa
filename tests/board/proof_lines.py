#!/usr/bin/env python3
"""What programs with a proof.hpp say: which figures, and whether they have failed.

proof_lines.py COMMAND... runs a command here and judges it so.
"""
import re
import subprocess
import sys


def figures(status, said, prefix=""):
    """{name: value and unit}; an error where something failed, or nothing was proved."""
    lines = said.splitlines()
    failed = [line for line in lines if line.startswith("FAILED")]
    ends = [match for line in lines if (match := re.fullmatch(r"(\d+) checks, (\d+) failed", line))]
    proved = sum(line.startswith("ok ") for line in lines)
    counted = sum(int(end[1]) for end in ends)
    if failed or status != 0 or not ends or not proved or proved != counted or any(end[2] != "0" for end in ends):
        told = "\n".join(failed or lines[-5:])
        raise AssertionError(f"status {status}, {proved} of {counted} checks passed:\n{told}")
    found = {}
    for line in lines:
        if match := re.fullmatch(r"figure (.+) = (-?\d+ ?\S*?) *", line):
            name = prefix + match[1]
            if name in found:
                raise AssertionError(f"two figures have the name {name}")
            found[name] = match[2].strip()
    return found


def main():
    done = subprocess.run(sys.argv[1:], stdout=subprocess.PIPE, text=True)
    try:
        found = figures(done.returncode, done.stdout)
    except AssertionError as error:
        print(f"proof_lines: {error}")
        return 1
    print(f"proof_lines: {len(found)} figures, nothing failed")
    return 0


if __name__ == "__main__":
    sys.exit(main())
