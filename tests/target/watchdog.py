#!/usr/bin/env python3
"""Looks on while a program feeds its watchdog, then hangs, and must start anew: watchdog.py BOARD PROGRAM"""
import subprocess
import sys
import threading
import time
from pathlib import Path

# Of a program that feeds for 4 seconds and then is bitten after 3 of the emulator's.
PATIENCE_SECONDS = 30


def main():
    board, program = sys.argv[1:]
    emulate = Path(__file__).resolve().parent / "emulate"
    process = subprocess.Popen([emulate, board, program], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True, errors="replace")
    patience = threading.Timer(PATIENCE_SECONDS, process.terminate)
    patience.start()
    try:
        for wanted in ("start", "fed", "start"):
            seen = process.stdout.readline().strip()
            if seen != wanted:
                sys.exit(f"watchdog: '{wanted}' was expected, '{seen}' came")
            if wanted == "fed":
                hung = time.monotonic()
    finally:
        patience.cancel()
        process.terminate()
    print(f"watchdog: {board}: a program that hangs starts anew, here after {time.monotonic() - hung:.1f} s")


if __name__ == "__main__":
    main()
