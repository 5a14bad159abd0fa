// SPDX-License-Identifier: MIT
//
// Golden vectors of codec/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include <fovea/base/arena.hpp>
#include <fovea/base/random.hpp>
#include <fovea/codec/any_picture.hpp>
#include <fovea/codec/bmp.hpp>
#include <fovea/codec/deflate.hpp>
#include <fovea/codec/deflate_bits.hpp>
#include <fovea/codec/inflate.hpp>
#include <fovea/codec/jpeg.hpp>
#include <fovea/codec/jpeg_colour.hpp>
#include <fovea/codec/jpeg_idct.hpp>
#include <fovea/codec/packet.hpp>
#include <fovea/codec/picture.hpp>
#include <fovea/codec/png_reader.hpp>
#include <fovea/codec/png_writer.hpp>
#include <fovea/codec/pnm.hpp>
#include <fovea/codec/toml.hpp>
#include <fovea/codec/zlib.hpp>
#include <golden/codec_files.hpp>
#include <golden/digest.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

inline void put(Digest& digest, const PictureInfo& info) {
    // Scratch differs by the width of a pointer.
    digest.add(info.size, info.content);
}

// ---- Pictures read ------------------------------------------------------------------------

/// A whole file decoded to each of the pixels, and what is said of halves of it.
template <class... Pixels, class Inspect, class Decode>
void add_file(Workspace& work, Digest& digest, Span<const std::uint8_t> file, Inspect inspect,
              Decode decode) {
    const Result<PictureInfo> info = inspect(file);
    digest.add(info, picture_format(file));
    if (!info) return;
    const auto decode_to = [&](auto pixel) {
        const auto dst = work.view<decltype(pixel)>(0, info->size);
        digest.add(decode(file, work.scratch_span(), dst), dst);
        const auto narrow = work.view<decltype(pixel)>(1, {info->size.width, info->size.height + 1});
        digest.add(decode(file, work.scratch_span(), narrow));
    };
    (decode_to(Pixels{}), ...);
    for (std::ptrdiff_t length = file.size(); length > 0; length = length * 3 / 4) {
        const auto dst = work.view<Gray8>(1, info->size);
        const Span<const std::uint8_t> part = file.first(length - 1);
        digest.add(inspect(part), decode(part, work.scratch_span(), dst));
    }
}

inline void codec_pnm(Workspace& work, Digest& digest) {
    const auto decode = [](auto file, auto, auto dst) { return decode_pnm(file, dst); };
    for (const Span<const std::uint8_t> file : pnm_files)
        add_file<Gray8, Gray16, Rgb888>(work, digest, file, inspect_pnm, decode);
}

inline void codec_bmp(Workspace& work, Digest& digest) {
    const auto decode = [](auto file, auto, auto dst) { return decode_bmp(file, dst); };
    for (const Span<const std::uint8_t> file : bmp_files)
        add_file<Gray8, Rgb888>(work, digest, file, inspect_bmp, decode);
}

inline void codec_png(Workspace& work, Digest& digest) {
    const auto decode = [](auto file, auto scratch, auto dst) { return decode_png(file, scratch, dst); };
    for (const Span<const std::uint8_t> file : png_files)
        add_file<Gray8, Gray16, Rgb888>(work, digest, file, inspect_png, decode);
    digest.add(png_reader_scratch({640, 480}) > 0);
}

inline void codec_jpeg(Workspace& work, Digest& digest) {
    const auto decode = [](auto file, auto scratch, auto dst) { return decode_jpeg(file, scratch, dst); };
    for (const Span<const std::uint8_t> file : jpeg_files)
        add_file<Gray8, Rgb888>(work, digest, file, inspect_jpeg, decode);
    digest.add(jpeg_scratch({640, 480}) > 0);
}

inline void codec_any_picture(Workspace& work, Digest& digest) {
    const auto decode = [](auto file, auto scratch, auto dst) { return decode_picture(file, scratch, dst); };
    constexpr std::uint8_t other[] = {'G', 'I', 'F', '8'};
    for (const Span<const std::uint8_t> file :
         {pnm_files[0], bmp_files[0], png_files[0], jpeg_files[0], Span<const std::uint8_t>(other)}) {
        add_file<Gray8, Rgb888>(work, digest, file, inspect_picture, decode);
        put_text(digest, describe(picture_format(file)));
    }
    for (std::uint32_t sample = 0; sample < 300; sample += 7)
        for (const std::uint32_t most : {1u, 15u, 200u, 255u, 1023u, 65535u})
            digest.add(pixel_of_gray<Gray8>(sample, most), pixel_of_gray<Gray16>(sample, most),
                       pixel_of_gray<Rgb888>(sample, most));
    digest.add(pixel_of_colour<Gray8>({9, 99, 199}), pixel_of_colour<Gray16>({9, 99, 199}),
               pixel_of_colour<Rgb888>({9, 99, 199}));
}

// ---- Pictures written ---------------------------------------------------------------------

/// visit(src, out) for pictures of both pixels, calm and restless ones.
template <class Visit>
void for_each_source(Workspace& work, Visit visit) {
    const Span<std::uint8_t> out = work.image[2];
    Random random(31);
    for (const Size size : {Size{1, 1}, Size{9, 1}, Size{1, 9}, Size{33, 7}, Size{70, 50}}) {
        const ImageView<Gray8> gray = work.view<Gray8>(0, size);
        for (const Filling filling : fillings) {
            fill(gray, filling, random);
            visit(ImageView<const Gray8>(gray), out);
        }
        draw_plate(gray, Plate{});
        visit(ImageView<const Gray8>(gray), out);
        const Size narrow{size.width, size.height / 2 + 1};
        const ImageView<Rgb888> colour = work.view<Rgb888>(1, narrow);
        for (int y = 0; y < narrow.height; ++y)
            for (int x = 0; x < narrow.width; ++x) {
                const Gray8 level = gray(x, y);
                colour(x, y) = {level, static_cast<Gray8>(x), static_cast<Gray8>(255 - level)};
            }
        visit(ImageView<const Rgb888>(colour), out);
    }
}
inline void add_encoded(Digest& digest, const Result<std::ptrdiff_t>& length, Span<std::uint8_t> out) {
    digest.add(length);
    if (length) digest.add(out.first(*length));
}

inline void codec_encode_pnm(Workspace& work, Digest& digest) {
    for_each_source(work, [&](auto src, Span<std::uint8_t> out) {
        add_encoded(digest, encode_pnm(src, out), out);
        const auto bytes = encoded_pnm_bytes<typename decltype(src)::value_type>(src.size());
        digest.add(bytes, encode_pnm(src, out.first(static_cast<std::ptrdiff_t>(bytes) - 1)));
    });
    const ImageView<Gray16> wide = work.view<Gray16>(0, {5, 3});
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 5; ++x) wide(x, y) = static_cast<Gray16>(4321 * (y * 5 + x));
    const Span<std::uint8_t> out = work.image[2];
    add_encoded(digest, encode_pnm(wide, out), out);
}

inline void codec_encode_bmp(Workspace& work, Digest& digest) {
    for_each_source(work, [&](auto src, Span<std::uint8_t> out) {
        add_encoded(digest, encode_bmp(src, out), out);
        const auto bytes = encoded_bmp_bytes<typename decltype(src)::value_type>(src.size());
        digest.add(bytes, encode_bmp(src, out.first(static_cast<std::ptrdiff_t>(bytes) - 1)));
    });
}

inline void codec_encode_png(Workspace& work, Digest& digest) {
    for_each_source(work, [&](auto src, Span<std::uint8_t> out) {
        const auto scratch =
            work.scratch_span().first(static_cast<std::ptrdiff_t>(png_writer_scratch(src.size())));
        add_encoded(digest, encode_png(src, scratch, out), out);
        digest.add(encoded_png_bytes<typename decltype(src)::value_type>(src.size()),
                   encode_png(src, scratch, out.first(60)).status());
    });
}

// ---- What they are made of ----------------------------------------------------------------

/// Sentences that repeat themselves, with a number now and then, written and read in pieces.
inline void codec_zlib(Workspace& work, Digest& digest) {
    constexpr int total = 20000;
    constexpr int period = 97;
    const auto text = [](int i) {
        return static_cast<std::uint8_t>(i % 1000 < 30 ? i * 7 / 3 : 'a' + i % period * (i % period) % 23);
    };
    const Span<std::uint8_t> out = work.image[0];
    ZlibWriter writer(work.scratch_span().first(static_cast<std::ptrdiff_t>(deflate_scratch())), out);
    Adler32 adler;
    for (int done = 0; done < total;) {
        const Span<std::uint8_t> room = writer.room();
        const auto count = minimum<std::ptrdiff_t>(minimum<std::ptrdiff_t>(room.size(), 3000), total - done);
        for (std::ptrdiff_t i = 0; i < count; ++i) room[i] = text(done++);
        adler.add(room.first(count));
        writer.add(count);
    }
    const Result<std::ptrdiff_t> length = writer.finish();
    add_encoded(digest, length, out);
    digest.add(adler.value(), deflated_bytes(total));
    if (!length) return;

    OnePiece source(out.first(*length));
    ZlibReader<OnePiece> reader(source, work.scratch_span());
    const Span<std::uint8_t> piece = Span<std::uint8_t>(work.image[1]).first(777);
    for (Result<std::ptrdiff_t> read = piece.size(); read && *read == piece.size();) {
        read = reader.read(piece);
        digest.add(read);
        if (read) digest.add(piece.first(*read));
    }
    const Span<std::uint8_t> small = work.image[1];
    digest.add(inflate_zlib(out.first(*length), work.scratch_span(), small).status());
}

inline void codec_jpeg_parts(Workspace&, Digest& digest) {
    Random random(32);
    for (int i = 0; i < 200; ++i) {
        jpeg::Block block = {};
        for (int k = 0; k < 64; ++k) {
            if (random.below(64) > static_cast<std::uint32_t>(i)) continue;
            block.coefficient[k] = static_cast<std::int16_t>(random.between(-2048, 2047) >> random.below(8));
            if (block.coefficient[k] != 0) block.used |= k;
        }
        std::uint8_t samples[64] = {};
        jpeg::inverse_dct(block, samples, 8);
        digest.add(Span<const std::uint8_t>(samples));
    }
    std::uint8_t rows[3][40] = {};
    for (auto& row : rows)
        for (std::uint8_t& sample : row) sample = random_byte(random);
    std::uint8_t line[80] = {};
    Rgb888 colours[40] = {};
    for (int width = 1; width <= 40; ++width) {
        jpeg::upsample_across(rows[0], width, line);
        digest.add(Span<const std::uint8_t>(line).first(2 * width));
        for (const jpeg::Farther side : {jpeg::Farther::above, jpeg::Farther::below}) {
            jpeg::upsample_down(rows[0], rows[1], side, width, line);
            digest.add(Span<const std::uint8_t>(line).first(width));
        }
        jpeg::upsample_both(rows[0], rows[1], width, line);
        digest.add(Span<const std::uint8_t>(line).first(2 * width));
        jpeg::colour_row(rows[0], rows[1], rows[2], width, colours);
        digest.add(Span<const Rgb888>(colours).first(width));
    }
}

// ---- Texts --------------------------------------------------------------------------------

inline void put(Digest& digest, TextPlace place) { digest.add(place.line, place.column); }
inline void put(Digest& digest, const TomlValue& value) {
    digest.add(value.type, value.place, value.text, value.number, value.truth);
}

inline void codec_toml(Workspace&, Digest& digest) {
    constexpr char good[] =
        "# a recipe\nname = \"plate \\\"A\\\"\\n\"\nscale = 0.0125 # mm\n\n[locate]\nlevel = -12\n"
        "dark = true\r\nlist = [1, 2.5, \"x\", false ]\nempty = []\n[[feature]]\nkind = \"width\"\nfrom = [ "
        "-1.5, +2 ]";
    constexpr char unclosed[] = "a = \"b\nc\"";
    constexpr char twice[] = "a = 1 2";
    constexpr char nested[] = "a = [[1]]";
    constexpr char zeros[] = "a = 01";
    constexpr char large[] = "a = 1000001";
    constexpr char table[] = "[a b]";
    for (const Span<const char> text :
         {Span<const char>(good), Span<const char>(unclosed), Span<const char>(twice),
          Span<const char>(nested), Span<const char>(zeros), Span<const char>(large),
          Span<const char>(table)}) {
        TomlReader reader(text.first(text.size() - 1));
        for (Result<TomlItem> item = reader.next();; item = reader.next()) {
            digest.add(item.status());
            if (!item) break;
            digest.add(item->kind, item->place, item->name, item->value);
            if (item->kind == TomlKind::end) break;
            char copy[20] = {};
            const Result<int> length = toml_string(item->value, copy);
            digest.add(length);
            if (length) digest.add(Span<const char>(copy).first(*length));
            if (item->value.type != TomlType::array) continue;
            TomlArrayReader elements(item->value);
            for (Result<TomlValue> element = elements.next(); element; element = elements.next())
                digest.add(element);
        }
        digest.add(reader.place());
        put_text(digest, reader.problem());
    }
}

// ---- Packets ------------------------------------------------------------------------------

/// Packets of every length, some with a byte changed, added, left out; read into rooms of several sizes.
inline void codec_packet(Workspace& work, Digest& digest) {
    Random random(77);
    const Span<std::uint8_t> line = work.image[2];
    std::uint8_t content[40];
    std::uint8_t room[40];
    for (const int room_size : {12, 29, 40}) {
        PacketReader reader(Span<std::uint8_t>(room, room_size));
        for (std::ptrdiff_t size = 0; size <= 40; ++size) {
            constexpr std::uint8_t some[] = {0xC0, 0xDB, 0xDC, 0xDD, 0, 17};
            for (std::uint8_t& byte : content) byte = some[random.below(6)];
            const Span<const std::uint8_t> filled(content, size);
            digest.add(packet_bytes(size));
            const Result<std::ptrdiff_t> length = encode_packet(filled, line);
            digest.add(length, encode_packet(filled, line.first(2 * size)));
            if (!length) continue;
            digest.add(line.first(*length));
            const auto place = static_cast<std::ptrdiff_t>(random.below(static_cast<std::uint32_t>(*length)));
            const std::uint32_t fault = random.below(4);
            for (std::ptrdiff_t i = 0; i < *length; ++i) {
                if (i == place && fault == 1) line[i] ^= 1;
                if (i == place && fault == 2) continue;
                if (i == place && fault == 3) reader.drop();
                const Result<bool> whole = reader.add(line[i]);
                digest.add(whole);
                digest.add(reader.in_packet());
                if (whole.status() == Status::capacity_exceeded) digest.add(reader.beginning());
            }
            digest.add(reader.content());
        }
    }
}

}  // namespace fovea::golden
