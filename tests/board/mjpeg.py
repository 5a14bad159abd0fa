"""Pictures as a webcam compresses them: baseline JPEG of 4:2:2 without its Huffman tables, which are the standard's."""
import math
import struct

# Annex K of ITU-T T.81: codes of the DC and AC coefficients of brightness; of colour only zeros are needed.
DC_LENGTHS = [0, 1, 5, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0]
AC_LENGTHS = [0, 2, 1, 3, 3, 2, 4, 3, 5, 5, 4, 4, 0, 0, 1, 125]
AC_SYMBOLS = bytes.fromhex(
    "01020300041105122131410613516107227114328191a1082342b1c11552d1f02433627282090a161718191a25262728292a3435363738393a"
    "434445464748494a535455565758595a636465666768696a737475767778797a838485868788898a92939495969798999aa2a3a4a5a6a7a8a9"
    "aab2b3b4b5b6b7b8b9bac2c3c4c5c6c7c8c9cad2d3d4d5d6d7d8d9dae1e2e3e4e5e6e7e8e9eaf1f2f3f4f5f6f7f8f9fa")
COLOUR_BLOCK = "00" + "00"  # no difference, and the end of the block
STEP = 4  # of every coefficient


def codes(lengths, symbols):
    """{symbol: its bits}"""
    found, code, symbols = {}, 0, iter(symbols)
    for length, count in enumerate(lengths, 1):
        for _ in range(count):
            found[next(symbols)] = f"{code:0{length}b}"
            code += 1
        code <<= 1
    return found


DC, AC = codes(DC_LENGTHS, range(12)), codes(AC_LENGTHS, AC_SYMBOLS)
ZIGZAG = sorted(((x, y) for x in range(8) for y in range(8)),
                key=lambda at: (at[0] + at[1], at[0] if (at[0] + at[1]) % 2 == 0 else at[1]))
WAVES = [[math.cos((2 * place + 1) * number * math.pi / 16) * (0.5 if number else math.sqrt(0.125))
          for place in range(8)] for number in range(8)]


def bits(value):
    """How many bits a coefficient has, and these."""
    size = abs(value).bit_length()
    return size, f"{value if value > 0 else value + (1 << size) - 1:0{size}b}" if size else ""


def coefficients(block):
    """Of 64 levels, in the order in which they are sent."""
    rows = [[sum(block[8 * y + x] * WAVES[u][x] for x in range(8)) for u in range(8)] for y in range(8)]
    return [round(sum(rows[y][u] * WAVES[v][y] for y in range(8)) / STEP) for u, v in ZIGZAG]


def ac_bits(values):
    text, zeros = "", 0
    for value in values:
        if value == 0:
            zeros += 1
            continue
        text += AC[0xF0] * (zeros // 16)
        size, raw = bits(value)
        text += AC[zeros % 16 << 4 | size] + raw
        zeros = 0
    return text + (AC[0] if zeros else "")


def segment(marker, data):
    return struct.pack(">BBH", 0xFF, marker, len(data) + 2) + data


def encode(pixels, width, height):
    """Gray pixels, whose width is a multiple of 16 and height of 8."""
    known, text, last = {}, [], 0
    for top in range(0, height, 8):
        for left in range(0, width, 8):
            block = bytes(pixels[(top + y) * width + left + x] for y in range(8) for x in range(8))
            if block not in known:
                dc, *ac = coefficients([level - 128 for level in block])
                known[block] = dc, ac_bits(ac)
            dc, rest = known[block]
            size, raw = bits(dc - last)
            last = dc
            text += [DC[size], raw, rest]
            if left % 16:
                text += [COLOUR_BLOCK, COLOUR_BLOCK]
    stream = "".join(text)
    stream += "1" * (-len(stream) % 8)
    scan = int(stream, 2).to_bytes(len(stream) // 8, "big").replace(b"\xff", b"\xff\x00")
    frame = struct.pack(">BHHB", 8, height, width, 3) + bytes([1, 0x21, 0, 2, 0x11, 0, 3, 0x11, 0])
    return (b"\xff\xd8" + segment(0xDB, bytes([0]) + bytes([STEP] * 64)) + segment(0xC0, frame)
            + segment(0xDA, bytes([3, 1, 0x00, 2, 0x11, 3, 0x11, 0, 63, 0])) + scan + b"\xff\xd9")
