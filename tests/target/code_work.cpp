// SPDX-License-Identifier: MIT
//
// Pictures for readers of codes, ordinary ones and such as are made to keep them busy. code_work.py runs this
// under QEMU and counts the instructions of each reader between fovea_region_begin() and fovea_region_end().
//
// usage: code_work         prints "kind picture reader codes", a line a region
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/code/code_128_encoder.hpp>
#include <fovea/code/data_matrix_encode.hpp>
#include <fovea/code/ean_encoder.hpp>
#include <fovea/code/qr_encode.hpp>
#include <fovea/code/read_codes.hpp>

extern "C" {
[[gnu::noinline]] void fovea_region_begin() { asm volatile(""); }
[[gnu::noinline]] void fovea_region_end() { asm volatile(""); }
}

namespace {

using namespace fovea;

constexpr Size picture_size{320, 240};

struct Canvas {
    std::vector<std::uint8_t> pixels = std::vector<std::uint8_t>(picture_size.area(), 255);

    std::uint8_t& operator()(int x, int y) {
        return pixels[static_cast<std::size_t>(y) * picture_size.width + static_cast<std::size_t>(x)];
    }
    template <class Level>
    void fill(Level level) {
        for (int y = 0; y < picture_size.height; ++y)
            for (int x = 0; x < picture_size.width; ++x)
                (*this)(x, y) = static_cast<std::uint8_t>(clamp<int>(level(x, y), 0, 255));
    }
    /// The mean of 3x3.
    void blur() {
        const Canvas from = *this;
        const auto at = [&](int x, int y) {
            return int{from.pixels[static_cast<std::size_t>(clamp(y, 0, picture_size.height - 1)) *
                                       picture_size.width +
                                   static_cast<std::size_t>(clamp(x, 0, picture_size.width - 1))]};
        };
        fill([&](int x, int y) {
            int sum = 4;
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i) sum += at(x + i, y + j);
            return sum / 9;
        });
    }
};

// ---- Ordinary pictures ------------------------------------------------------------

/// Things on a table: uneven light, shapes at all angles, some of them grained, noise, a lens that blurs.
Canvas table(std::uint32_t seed) {
    Random random(seed);
    Canvas canvas;
    const int slope = random.between(-60, 60);
    canvas.fill(
        [&](int x, int y) { return 140 + slope * x / picture_size.width + 30 * y / picture_size.height; });
    for (int i = 0; i < 26; ++i) {
        const double turn = random.between(0, 628) / 100.0;
        const double c = std::cos(turn), s = std::sin(turn);
        const int cx = random.between(0, picture_size.width), cy = random.between(0, picture_size.height);
        const int half_width = random.between(4, 60), half_height = random.between(3, 40);
        const int level = random.between(20, 235),
                  grain = random.between(0, 3) == 0 ? random.between(5, 50) : 0;
        const bool round = random.between(0, 1) == 0;
        for (int y = 0; y < picture_size.height; ++y)
            for (int x = 0; x < picture_size.width; ++x) {
                const double u = (c * (x - cx) + s * (y - cy)) / half_width;
                const double v = (c * (y - cy) - s * (x - cx)) / half_height;
                if (round ? u * u + v * v > 1 : std::abs(u) > 1 || std::abs(v) > 1) continue;
                canvas(x, y) =
                    static_cast<std::uint8_t>(clamp(level + random.between(-grain, grain), 0, 255));
            }
    }
    canvas.blur();
    canvas.fill([&](int x, int y) { return canvas(x, y) + random.between(-4, 4); });
    return canvas;
}

/// Bars or modules on a white label, turned about its middle.
template <class Dark>
void stick(Canvas& canvas, int width, int height, double module, double turn, Dark dark) {
    const double c = std::cos(turn), s = std::sin(turn);
    for (int y = 0; y < picture_size.height; ++y)
        for (int x = 0; x < picture_size.width; ++x) {
            int light = 0, covered = 0;
            for (int k = 0; k < 9; ++k) {
                const double px = x + (k % 3 - 1) / 3.0 - picture_size.width / 2.0;
                const double py = y + (k / 3 - 1) / 3.0 - picture_size.height / 2.0;
                const double u = (c * px + s * py) / module + width / 2.0,
                             v = (c * py - s * px) / module + height / 2.0;
                if (u < -10 || v < -4 || u >= width + 10 || v >= height + 4) continue;
                ++covered;
                const bool inside = u >= 0 && v >= 0 && u < width && v < height;
                light += inside && dark(static_cast<int>(u), static_cast<int>(v)) ? 30 : 225;
            }
            if (covered > 0)
                canvas(x, y) = static_cast<std::uint8_t>((light + canvas(x, y) * (9 - covered)) / 9);
        }
}
void stick_bars(Canvas& canvas, const List<std::uint8_t, 64>& widths, double module, double turn) {
    std::vector<bool> bars;
    for (int i = 0; i < widths.size(); ++i) bars.insert(bars.end(), widths[i], i % 2 == 0);
    stick(canvas, static_cast<int>(bars.size()), 40, module, turn,
          [&](int x, int) { return bars[static_cast<std::size_t>(x)]; });
}
void stick_ean(Canvas& canvas, double module, double turn) {
    const std::uint8_t digits[12] = {'9', '7', '8', '0', '9', '0', '5', '7', '0', '5', '7', '1'};
    List<std::uint8_t, 64> widths;
    if (encode_ean_13(digits, widths) == Status::ok) stick_bars(canvas, widths, module, turn);
}
Span<const std::uint8_t> bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), static_cast<std::ptrdiff_t>(text.size())};
}
void stick_data_matrix(Canvas& canvas, const std::string& text, double module, double turn) {
    static BitStorage<max_data_matrix_side, max_data_matrix_side> modules;
    std::vector<std::uint8_t> scratch(
        static_cast<std::size_t>(data_matrix_encode_scratch(static_cast<std::int64_t>(text.size()))));
    const Result<Size> made = data_matrix_encode(
        bytes_of(text), {}, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, modules.view());
    if (made)
        stick(canvas, made->width, made->height, module, turn,
              [](int x, int y) { return modules.view()(x, y); });
}
/// A QR code; a share of its modules, in 1/100, turned about but for those of finder and timing patterns.
void stick_qr(Canvas& canvas, const std::string& text, double module, double turn, int spoilt,
              std::uint32_t seed) {
    static BitStorage<max_qr_size, max_qr_size> room;
    std::vector<std::uint8_t> scratch(
        static_cast<std::size_t>(qr_encode_scratch(static_cast<std::int64_t>(text.size()))));
    const Result<BitView<BitWord>> made = qr_encode(
        bytes_of(text), {}, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, room.view());
    if (!made) return;
    Random random(seed);
    const int size = made->width();
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const bool finder = (x < 8 && (y < 8 || y >= size - 8)) || (x >= size - 8 && y < 8);
            if (finder || x == 6 || y == 6 || random.between(1, 100) > spoilt) continue;
            made->set(x, y, !(*made)(x, y));
        }
    stick(canvas, size, size, module, turn, [&](int x, int y) { return (*made)(x, y); });
}

// ---- Pictures that keep readers busy ----------------------------------------------

Canvas noise(std::uint32_t seed, int low, int high, int blurs) {
    Random random(seed);
    Canvas canvas;
    canvas.fill([&](int, int) { return random.between(low, high); });
    for (int i = 0; i < blurs; ++i) canvas.blur();
    return canvas;
}
Canvas checkers(int side) {
    Canvas canvas;
    canvas.fill([&](int x, int y) { return (x / side + y / side) % 2 == 0 ? 20 : 230; });
    return canvas;
}
Canvas module_field(std::uint32_t seed, int side) {
    Random random(seed);
    Canvas canvas;
    for (int y = 0; y < picture_size.height; y += side)
        for (int x = 0; x < picture_size.width; x += side) {
            const int level = random.between(0, 1) == 0 ? 20 : 230;
            for (int j = y; j < y + side && j < picture_size.height; ++j)
                for (int i = x; i < x + side && i < picture_size.width; ++i)
                    canvas(i, j) = static_cast<std::uint8_t>(level);
        }
    return canvas;
}
/// Finder patterns of QR in rows, with modules at random between them or without.
Canvas finders(std::uint32_t seed, int module, int pitch, bool between) {
    Canvas canvas = between ? module_field(seed, module) : Canvas();
    for (int top = 0; top + 9 <= picture_size.height / module; top += pitch)
        for (int left = 0; left + 9 <= picture_size.width / module; left += pitch)
            for (int y = 0; y < 9 * module; ++y)
                for (int x = 0; x < 9 * module; ++x) {
                    const int away = maximum(std::abs(x / module - 4), std::abs(y / module - 4));
                    canvas(left * module + x, top * module + y) = away == 4 || away == 2 ? 230 : 20;
                }
    return canvas;
}
/// Frames of Data Matrix, two solid lines and two dashed ones, with modules at random in them.
Canvas frames(std::uint32_t seed, int module, int side, int contrast) {
    Canvas canvas = module_field(seed, module);
    canvas.fill([&](int x, int y) {
        const int cell = side + 2;
        const int column = x / module % cell - 1, row = y / module % cell - 1;
        if (column < 0 || row < 0 || column >= side || row >= side) return 230;
        if (column == 0 || row == side - 1) return 230 - contrast;
        if (row == 0) return column % 2 == 0 ? 230 - contrast : 230;
        if (column == side - 1) return row % 2 == 1 ? 230 - contrast : 230;
        return canvas(x, y) < 128 ? 230 - contrast : 230;
    });
    return canvas;
}
/// Bars of widths at random; slant in 1/100 px a row.
Canvas stripes(std::uint32_t seed, int narrow, int wide, int slant, int blurs) {
    Random random(seed);
    std::vector<int> level;
    for (int bar = 0; static_cast<int>(level.size()) < 2 * picture_size.width + 800; ++bar)
        level.insert(level.end(), static_cast<std::size_t>(random.between(narrow, wide)),
                     bar % 2 == 0 ? 20 : 230);
    Canvas canvas;
    canvas.fill([&](int x, int y) { return level[static_cast<std::size_t>(x + slant * y / 100)]; });
    for (int i = 0; i < blurs; ++i) canvas.blur();
    return canvas;
}
/// Stripes in blocks that end in quiet zones, as codes out of focus do.
Canvas striped_blocks(std::uint32_t seed, int blurs) {
    Canvas canvas = stripes(seed, 1, 4, 0, 0);
    canvas.fill(
        [&](int x, int y) { return x % 150 < 14 || x % 150 > 136 || y % 60 < 8 ? 240 : canvas(x, y); });
    for (int i = 0; i < blurs; ++i) canvas.blur();
    return canvas;
}
Canvas spiral(double pitch) {
    Canvas canvas;
    canvas.fill([&](int x, int y) {
        const double u = x - picture_size.width / 2.0, v = y - picture_size.height / 2.0;
        const double turn = std::sqrt(u * u + v * v) / pitch + std::atan2(v, u) / 6.2831853;
        return turn - std::floor(turn) < 0.5 ? 20 : 230;
    });
    return canvas;
}
Canvas rings(double pitch) {
    Canvas canvas;
    canvas.fill([&](int x, int y) {
        const double u = x - picture_size.width / 2.0, v = y - picture_size.height / 2.0;
        return static_cast<int>(128 + 110 * std::sin(std::sqrt(u * u + v * v) * 6.2831853 / pitch));
    });
    return canvas;
}
/// Strokes of letters in lines.
Canvas letters(std::uint32_t seed, int stroke) {
    Random random(seed);
    Canvas canvas;
    for (int top = stroke; top + 8 * stroke < picture_size.height; top += 10 * stroke)
        for (int left = stroke; left + 6 * stroke < picture_size.width; left += 7 * stroke)
            for (int part = 0; part < 5; ++part) {
                const bool upright = random.between(0, 1) == 0;
                const int x = left + stroke * random.between(0, upright ? 4 : 1),
                          y = top + stroke * random.between(0, upright ? 2 : 6);
                for (int j = 0; j < stroke * (upright ? 5 : 1); ++j)
                    for (int i = 0; i < stroke * (upright ? 1 : 4); ++i) canvas(x + i, y + j) = 30;
            }
    canvas.blur();
    return canvas;
}

// ---- Readers ----------------------------------------------------------------------

template <class Read>
void count(const char* kind, const char* name, const char* reader, Read read) {
    static std::uint8_t room[8192];
    CodeText text({room, sizeof room});
    List<Code, 32> codes;
    ListView<Code> list = codes.view();
    fovea_region_begin();
    static_cast<void>(read(text, list));
    fovea_region_end();
    std::printf("%s %s %s %d\n", kind, name, reader, codes.size());
}

void measure(const char* kind, const std::string& name, const Canvas& canvas) {
    const ImageView<const Gray8> image(canvas.pixels.data(), picture_size, picture_size.width);
    static std::vector<std::uint8_t> room(static_cast<std::size_t>(read_codes_scratch(picture_size)));
    const Span<std::uint8_t> scratch(room.data(), static_cast<std::ptrdiff_t>(room.size()));
    const char* picture = name.c_str();
    count(kind, picture, "read_codes", [&](CodeText& text, ListView<Code>& codes) {
        return read_codes(image, ReadCodesOptions(), scratch, text, codes);
    });
    count(kind, picture, "read_qr", [&](CodeText& text, ListView<Code>& codes) {
        return read_qr(image, ReadQrOptions(), scratch, text, codes);
    });
    count(kind, picture, "read_bars", [&](CodeText& text, ListView<Code>& codes) {
        return read_bars(image, ReadBarsOptions(), scratch, text, codes);
    });
    count(kind, picture, "read_data_matrix", [&](CodeText& text, ListView<Code>& codes) {
        return read_data_matrix(image, ReadDataMatrixOptions(), scratch, text, codes);
    });
    count(kind, picture, "read_blurred_bars", [&](CodeText& text, ListView<Code>& codes) {
        return read_blurred_bars(image, SymbologySet::all(), 1, scratch, text, codes);
    });
}

}  // namespace

int main() {
    // As many ordinary pictures without a code as with one, and one more.
    for (std::uint32_t seed = 1; seed <= 9; ++seed)
        measure("without", "table_" + std::to_string(seed), table(seed));
    Canvas canvas = table(11);
    stick_ean(canvas, 2, 0.1);
    measure("with", "ean_13", canvas);
    canvas = table(12);
    stick_ean(canvas, 1.6, 1.2);
    measure("with", "ean_13_turned", canvas);
    canvas = table(13);
    stick_ean(canvas, 1.7, 0.02);
    for (int i = 0; i < 4; ++i) canvas.blur();
    measure("with", "ean_13_blurred", canvas);
    canvas = table(14);
    stick_qr(canvas, "https://fovea.example", 4, 0.3, 0, 1);
    measure("with", "qr", canvas);
    canvas = table(15);
    stick_qr(canvas, "A longer text that needs more modules than the others do, and has them.", 3, -0.6, 0,
             1);
    measure("with", "qr_larger", canvas);
    canvas = table(16);
    stick_data_matrix(canvas, "fovea 16022", 4, 0.4);
    measure("with", "data_matrix", canvas);
    canvas = table(17);
    stick_data_matrix(canvas, "P/N 4711, and some more about the part", 3, -0.2);
    measure("with", "data_matrix_larger", canvas);
    canvas = table(18);
    stick_ean(canvas, 2.2, -0.4);
    measure("with", "ean_13_slanted", canvas);

    measure("busy", "noise", noise(1, 0, 255, 0));
    measure("busy", "noise_blurred", noise(2, 0, 255, 1));
    measure("busy", "noise_blurred_more", noise(3, 0, 255, 3));
    measure("busy", "noise_faint", noise(4, 100, 150, 0));
    for (const int side : {1, 2, 3, 5, 8})
        measure("busy", "checkers_" + std::to_string(side), checkers(side));
    for (const int side : {1, 2, 3, 5, 8})
        measure("busy", "modules_" + std::to_string(side), module_field(7, side));
    for (const int module : {1, 2, 3})
        for (const int pitch : {9, 14, 25}) {
            const std::string name = std::to_string(module) + "_" + std::to_string(pitch);
            measure("busy", "finders_" + name, finders(8, module, pitch, false));
            measure("busy", "finders_and_modules_" + name, finders(9, module, pitch, true));
        }
    for (const int module : {1, 2, 3, 5})
        for (const int side : {10, 24, 44}) {
            const std::string name = std::to_string(module) + "_" + std::to_string(side);
            measure("busy", "frames_" + name, frames(10, module, side, 200));
            measure("busy", "frames_faint_" + name, frames(10, module, side, 40));
        }
    for (const int slant : {0, 30, 100}) {
        measure("busy", "stripes_1_" + std::to_string(slant), stripes(11, 1, 2, slant, 0));
        measure("busy", "stripes_2_" + std::to_string(slant), stripes(12, 2, 5, slant, 0));
        measure("busy", "stripes_blurred_" + std::to_string(slant), stripes(13, 1, 5, slant, 3));
    }
    for (const int blurs : {0, 2, 5})
        measure("busy", "striped_blocks_" + std::to_string(blurs), striped_blocks(14, blurs));
    for (const int pitch : {3, 6, 12}) {
        measure("busy", "spiral_" + std::to_string(pitch), spiral(pitch));
        measure("busy", "rings_" + std::to_string(pitch), rings(pitch));
    }
    for (const int stroke : {1, 2, 3})
        measure("busy", "letters_" + std::to_string(stroke), letters(15, stroke));
    for (const int length : {20, 120, 400}) {
        canvas = Canvas();
        stick_qr(canvas, std::string(static_cast<std::size_t>(length), 'f'),
                 length < 50    ? 5
                 : length < 200 ? 3.5
                                : 2.5,
                 0.05, 50, 16);
        measure("busy", "qr_spoilt_" + std::to_string(length), canvas);
    }
    return 0;
}
