#!/usr/bin/env python3
"""Writes codec_files.hpp: the small picture files that the golden vectors of codec/ decode.

The JPEG files are those that fuzzing starts from; the others are written here, bit by bit or with zlib.

usage: make_codec_files.py > codec_files.hpp
"""
import struct
import zlib
from pathlib import Path

JPEG = Path(__file__).parents[1] / "fuzz/codec/jpeg_corpus"

state = 12345


def draw(bound):
    """A linear congruential generator: the same numbers with every version of Python."""
    global state
    state = (state * 1103515245 + 12345) % 2**31
    return (state >> 8) % bound


def samples(width, height, channels, most):
    """Soft shading, a bright box and a little noise, row by row."""
    rows = []
    for y in range(height):
        row = []
        for x in range(width):
            for c in range(channels):
                value = most * (x + 2 * y + c * 5) // (width + 2 * height + 10) + draw(max(most // 64, 1))
                row.append(most - c if 3 <= x < 8 and 4 <= y < 9 else min(value, most))
        rows.append(row)
    return rows


def big(rows, bytes_each):
    return b"".join(value.to_bytes(bytes_each, "big") for row in rows for value in row)


# ---- PNG ----------------------------------------------------------------------------------

def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def filtered(rows, step):
    """Every row with another of the five filters."""
    out, above = b"", [0] * len(rows[0])
    for number, row in enumerate(rows):
        kind = number % 5
        out += bytes([kind])
        for i, value in enumerate(row):
            a = row[i - step] if i >= step else 0
            b, c = above[i], above[i - step] if i >= step else 0
            pa, pb, pc = abs(b - c), abs(a - c), abs(a + b - 2 * c)
            paeth = a if pa <= pb and pa <= pc else b if pb <= pc else c
            out += bytes([(value - [0, a, b, (a + b) // 2, paeth][kind]) % 256])
        above = row
    return out


def png(width, height, bits, colour, raw_rows, step, level, strategy=zlib.Z_DEFAULT_STRATEGY, palette=b"", pieces=1):
    packer = zlib.compressobj(level, zlib.DEFLATED, 15, 9, strategy)
    data = packer.compress(filtered(raw_rows, step)) + packer.flush()
    size = -(-len(data) // pieces)
    parts = [data[i:i + size] for i in range(0, len(data), size)]
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, bits, colour, 0, 0, 0)) +
            (chunk(b"PLTE", palette) if palette else b"") + b"".join(chunk(b"IDAT", part) for part in parts) +
            chunk(b"IEND", b""))


def packed(rows, bits):
    """Samples of less than a byte, the first one highest."""
    out = []
    for row in rows:
        text = "".join(f"{value:0{bits}b}" for value in row)
        text += "0" * (-len(text) % 8)
        out.append([int(text[i:i + 8], 2) for i in range(0, len(text), 8)])
    return out


def wide(rows):
    return [[byte for value in row for byte in value.to_bytes(2, "big")] for row in rows]


def png_files():
    yield "gray", png(19, 21, 8, 0, samples(19, 21, 1, 255), 1, 9)
    yield "rgb_in_pieces", png(13, 11, 8, 2, samples(13, 11, 3, 255), 3, 6, zlib.Z_FIXED, pieces=5)
    yield "gray_two_bits", png(17, 9, 2, 0, packed(samples(17, 9, 1, 3), 2), 1, 0)
    yield "palette", png(15, 11, 4, 3, packed(samples(15, 11, 1, 11), 4), 1, 9,
                         palette=bytes(draw(256) for _ in range(36)))
    yield "gray_16", png(9, 12, 16, 0, wide(samples(9, 12, 1, 65535)), 2, 9, zlib.Z_HUFFMAN_ONLY)
    yield "rgb_16_alpha", png(7, 6, 16, 6, wide(samples(7, 6, 4, 65535)), 8, 9)
    yield "gray_alpha", png(8, 7, 8, 4, samples(8, 7, 2, 255), 2, 1)


# ---- BMP, PNM -----------------------------------------------------------------------------

def bmp(width, height, bits, compression, between, rows):
    """between: masks or palette. A negative height: from the top down."""
    stride = (width * bits + 31) // 32 * 4
    start = 54 + len(between)
    body = b"".join(bytes(row).ljust(stride, b"\0") for row in rows)
    colours = len(between) // 4 if bits == 8 else 0
    return (struct.pack("<2sIHHI", b"BM", start + len(body), 0, 0, start) +
            struct.pack("<IiiHHIIiiII", 40, width, height, 1, bits, compression, len(body), 2835, 2835, colours, 0) +
            between + body)


def bmp_files():
    yield "palette", bmp(9, 7, 8, 0, bytes(draw(256) for _ in range(4 * 20)), samples(9, 7, 1, 19))
    yield "rgb_top_down", bmp(7, -6, 24, 0, b"", samples(7, 6, 3, 255))
    yield "masks", bmp(6, 5, 32, 3, struct.pack("<III", 0xff, 0xff00, 0xff0000), samples(6, 5, 4, 255))


def pnm_files():
    yield "gray", b"P5\n# a comment\n11 9\n200\n" + big(samples(11, 9, 1, 200), 1)
    yield "rgb", b"P6 7 5 255\n" + big(samples(7, 5, 3, 255), 1)
    yield "gray_16", b"P5\n6 4\n1023\n" + big(samples(6, 4, 1, 1023), 2)
    yield "rgb_16", b"P6\n5 3\n65535\n" + big(samples(5, 3, 3, 65535), 2)


# ---- The header ---------------------------------------------------------------------------

def main():
    files = {"png": list(png_files()), "bmp": list(bmp_files()), "pnm": list(pnm_files())}
    files["jpeg"] = [(f"sampled_{path.stem}" if path.stem[0].isdigit() else path.stem, path.read_bytes())
                     for path in sorted(JPEG.glob("*.jpg"))]
    print("// SPDX-License-Identifier: MIT\n//\n// Small picture files of every kind that the decoders read."
          " Written by make_codec_files.py.\n#pragma once\n\n#include <cstdint>\n\n#include <fovea/base/span.hpp>\n\n"
          "namespace fovea::golden {")
    for family, members in files.items():
        print()
        for name, data in members:
            print(f"inline constexpr std::uint8_t {family}_{name}[] = {{")
            for i in range(0, len(data), 18):
                print("    " + " ".join(f"0x{byte:02x}," for byte in data[i:i + 18]))
            print("};")
        print(f"inline constexpr Span<const std::uint8_t> {family}_files[] = {{" +
              ", ".join(f"{family}_{name}" for name, _ in members) + "};")
    print("\n}  // namespace fovea::golden")


main()
