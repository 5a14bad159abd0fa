#!/usr/bin/env python3
"""Plots of what code_robustness has measured: read rates of codes under disturbances.

usage: code_plots.py CSV FOLDER     writes code_blur.svg and code_disturbances.svg
"""
import csv
import sys
from pathlib import Path
from xml.sax.saxutils import escape

COLOURS = {"fovea": "#0b6e4f", "zxing-cpp": "#d1495b", "zbar": "#3066be", "libdmtx": "#c28f00"}
# Who is drawn last lies on top; dashes leave equal lines visible.
DASHES = {"fovea": "", "zxing-cpp": "5 2", "zbar": "2 2", "libdmtx": "7 2 2 2"}
WIDTH, HEIGHT = 104, 62  # of the field of a plot, px
LEFT, TOP = 148, 52      # of the first field
ACROSS, DOWN = WIDTH + 20, HEIGHT + 30


def text(x, y, words, size=10, anchor="middle", weight="normal"):
    return (f'<text x="{x:g}" y="{y:g}" font-size="{size}" text-anchor="{anchor}" font-weight="{weight}">'
            f'{escape(words)}</text>\n')


def plot(x, y, lines, levels, even):
    """One field with its lines: {reader: {level: (rate, misread)}}. Levels stand evenly apart, or where they are."""
    low, high = min(levels), max(levels)
    places = {level: x + WIDTH * (i / (len(levels) - 1) if even else (level - low) / (high - low))
              for i, level in enumerate(levels)}
    out = f'<rect x="{x}" y="{y}" width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="#999"/>\n'
    out += f'<path d="M{x} {y + HEIGHT / 2:g}h{WIDTH}" stroke="#ddd"/>\n'
    # Levels that have room for their number, from the left.
    free = x - 99
    for level in levels:
        at = places[level]
        if at - free >= 18:
            out += f'<path d="M{at:.1f} {y + HEIGHT}v3" stroke="#999"/>\n' + text(round(at, 1), y + HEIGHT + 12, f"{level:g}", 8)
            free = at
    for reader in sorted(lines, key=list(COLOURS).index, reverse=True):
        points = [(places[level], y + HEIGHT * (1 - rate), misread) for level, (rate, misread) in sorted(lines[reader].items())]
        path = " ".join(f"{px:.1f},{py:.1f}" for px, py, _ in points)
        dash = f' stroke-dasharray="{DASHES[reader]}"' if DASHES[reader] else ""
        out += f'<polyline points="{path}" fill="none" stroke="{COLOURS[reader]}" stroke-width="1.6"{dash}/>\n'
        for px, py, misread in points:
            if misread:
                out += f'<circle cx="{px:.1f}" cy="{py:.1f}" r="3.2" fill="#fff" stroke="{COLOURS[reader]}" stroke-width="1.6"/>\n'
    return out


def sheet(title, rows, columns, cells, even):
    """rows: codes; columns: [(disturbance, caption)]; cells: {(code, disturbance): lines}."""
    width, height = LEFT + ACROSS * len(columns), TOP + DOWN * len(rows) + 6
    out = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
           f'font-family="sans-serif">\n<rect width="{width}" height="{height}" fill="#fff"/>\n')
    out += text(8, 17, title, 12, "start", "bold")
    x = 8
    for reader, colour in COLOURS.items():
        dash = f' stroke-dasharray="{DASHES[reader]}"' if DASHES[reader] else ""
        out += f'<path d="M{x} 32h24" stroke="{colour}" stroke-width="2"{dash}/>\n' + text(x + 29, 35, reader, 10, "start")
        x += 110
    out += f'<circle cx="{x + 5}" cy="32" r="3.2" fill="#fff" stroke="#555" stroke-width="1.6"/>\n'
    out += text(x + 14, 35, "something was misread", 10, "start")
    for column, (_, caption) in enumerate(columns):
        out += text(LEFT + ACROSS * column + WIDTH / 2, TOP - 4, caption, 9)
    for row, code in enumerate(rows):
        y = TOP + DOWN * row
        out += text(LEFT - 26, y + HEIGHT / 2 + 3, code, 10, "end", "bold")
        out += text(LEFT - 4, y + 8, "100 %", 8, "end") + text(LEFT - 4, y + HEIGHT, "0", 8, "end")
        for column, (disturbance, _) in enumerate(columns):
            lines = cells[code, disturbance]
            levels = sorted({level for line in lines.values() for level in line})
            if disturbance == "contrast":
                levels.reverse()
            out += plot(LEFT + ACROSS * column, y, lines, levels, even)
    return out + "</svg>\n"


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    cells, units, codes = {}, {}, []
    with open(sys.argv[1], newline="") as lines:
        for row in csv.DictReader(lines):
            code, disturbance, pictures = row["code"], row["disturbance"], int(row["pictures"])
            units[disturbance] = row["unit"]
            # Of bars that are no code nothing can be read.
            if code.startswith("bars"):
                continue
            codes += [] if code in codes else [code]
            of_reader = cells.setdefault((code, disturbance), {}).setdefault(row["reader"], {})
            of_reader[float(row["level"])] = (int(row["read"]) / pictures, int(row["misread"]))
    blurs = [name for name in units if name.startswith("blur at ")]
    others = [name for name in units if name not in blurs]
    folder = Path(sys.argv[2])
    (folder / "code_blur.svg").write_text(sheet(
        "Codes that are read, against the deviation of a Gaussian blur in modules", codes,
        [(name, f"modules of {name[len('blur at '):]}") for name in blurs], cells, False))
    (folder / "code_disturbances.svg").write_text(sheet(
        "Codes that are read, modules of 2 px, against the strength of a disturbance", codes,
        [(name, f"{name}, {units[name]}") for name in others], cells, True))


main()
