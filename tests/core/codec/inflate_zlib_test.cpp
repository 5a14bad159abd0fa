// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include <fovea/base/random.hpp>

#include "inflating.hpp"
#include "lossless_files.hpp"

#if defined(FOVEA_HAVE_LIBPNG)
#include <zlib.h>
#endif

namespace fovea::test {
namespace {

// ---- The format around it ---------------------------------------------------------

TEST(InflateZlib, ReadsStoredData) {
    for (const std::size_t length : {0u, 1u, 100u, 32768u, 65535u, 65536u, 99999u}) {
        Bytes data(length);
        for (std::size_t i = 0; i < length; ++i) data[i] = static_cast<std::uint8_t>(i * i >> 3);
        const Inflated read = inflate_whole(zlib_stored(data));
        EXPECT_EQ(read.status, Status::ok);
        EXPECT_EQ(read.data, data);
    }
}

TEST(InflateZlib, SaysWhatIsWrong) {
    const Bytes data = bytes_of("integers only");
    const Bytes file = zlib_stored(data);
    Bytes scratch = zeros(inflate_scratch());
    Bytes little_scratch = zeros(inflate_scratch() - 1);
    Bytes dst(data.size(), 77);
    EXPECT_EQ(inflate_zlib(view_of(file), room_in(little_scratch), room_in(dst)).status(),
              Status::scratch_too_small);
    EXPECT_EQ(dst, Bytes(data.size(), 77));
    EXPECT_EQ(inflate_whole(file, data.size()).data, data);
    EXPECT_EQ(inflate_whole(file, data.size() - 1).status, Status::buffer_too_small);

    Bytes wrong = file;
    wrong[0] = 0x77;
    EXPECT_EQ(inflate_whole(wrong).status, Status::malformed);
    wrong[0] = 0x88;  // a window of 64 KiB, with a right check
    wrong[1] = 0x1c;
    EXPECT_EQ(inflate_whole(wrong).status, Status::malformed);
    wrong[0] = 0x78;
    wrong[1] = 0x02;
    EXPECT_EQ(inflate_whole(wrong).status, Status::malformed);
    wrong[1] = 0x20;  // a preset dictionary, with a right check
    EXPECT_EQ(inflate_whole(wrong).status, Status::unsupported);
    wrong = file;
    wrong.back() ^= 1;
    EXPECT_EQ(inflate_whole(wrong).status, Status::malformed);
    wrong = file;
    wrong.push_back(0);
    EXPECT_EQ(inflate_whole(wrong).status, Status::malformed);
    for (std::size_t length = 0; length < file.size(); ++length)
        EXPECT_EQ(inflate_whole(first_bytes(file, length)).status, Status::truncated) << length;
}

TEST(InflateZlib, AnswersTheSameForEverAfterAFault) {
    Bytes file = zlib_stored(bytes_of("abc"));
    file.back() ^= 1;
    Bytes scratch = zeros(inflate_scratch());
    OnePiece source(view_of(file));
    ZlibReader<OnePiece> reader(source, room_in(scratch));
    Bytes dst(10);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(reader.read(room_in(dst)).status(), Status::malformed);
}

#if defined(FOVEA_HAVE_LIBPNG)

// ---- Against zlib -----------------------------------------------------------------

Bytes deflated(const Bytes& data, int level, int strategy, int window_bits) {
    z_stream stream{};
    EXPECT_EQ(deflateInit2(&stream, level, Z_DEFLATED, window_bits, 8, strategy), Z_OK);
    Bytes file(deflateBound(&stream, data.size()) + 100);
    stream.next_in = const_cast<Bytef*>(data.data());
    stream.avail_in = static_cast<uInt>(data.size());
    stream.next_out = file.data();
    stream.avail_out = static_cast<uInt>(file.size());
    EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
    file.resize(stream.total_out);
    deflateEnd(&stream);
    return file;
}

/// Data that have literals, short and long matches, near and far.
Bytes mixed_data(Random& random, std::size_t length) {
    Bytes data;
    const std::uint32_t alphabet = 1 + random.below(256);
    while (data.size() < length) {
        if (data.size() > 3 && random.below(3) == 0) {
            const std::size_t distance =
                1 + random.below(static_cast<std::uint32_t>(std::min<std::size_t>(data.size(), 32768)));
            for (std::uint32_t run = random.below(400); run > 0; --run)
                data.push_back(data[data.size() - distance]);
        } else {
            for (std::uint32_t run = random.below(60); run > 0; --run)
                data.push_back(static_cast<std::uint8_t>(random.below(alphabet)));
        }
    }
    data.resize(length);
    return data;
}

TEST(InflateZlib, ReadsWhatZlibWritesAtEveryLevelStrategyAndWindow) {
    Random random(1);
    for (const int level : {0, 1, 5, 9})
        for (const int strategy : {Z_DEFAULT_STRATEGY, Z_FILTERED, Z_HUFFMAN_ONLY, Z_RLE, Z_FIXED})
            for (const int window_bits : {9, 12, 15}) {
                const Bytes data = mixed_data(random, random.below(90000));
                const Inflated read = inflate_whole(deflated(data, level, strategy, window_bits));
                ASSERT_EQ(read.status, Status::ok) << level << " " << strategy << " " << window_bits;
                ASSERT_EQ(read.data, data);
            }
}

/// Hands out the data in pieces of random lengths, single bytes among them.
class RandomPieces {
public:
    RandomPieces(Span<const std::uint8_t> bytes, Random& random) : bytes_(bytes), random_(random) {}
    Span<const std::uint8_t> next() {
        const int most = random_.below(2) == 0 ? 1 : 40;
        const std::ptrdiff_t length = minimum<std::ptrdiff_t>(random_.between(1, most), bytes_.size());
        const Span<const std::uint8_t> piece = bytes_.first(length);
        bytes_ = bytes_.from(length);
        return piece;
    }

private:
    Span<const std::uint8_t> bytes_;
    Random& random_;
};

TEST(Inflate, DoesNotCareHowDataAreCutGoingInOrComingOut) {
    Random random(2);
    for (int round = 0; round < 60; ++round) {
        const Bytes data = mixed_data(random, 70000);
        const Bytes file = deflated(data, random.between(0, 9), round % 5, 15);
        RandomPieces source(view_of(file), random);
        Bytes scratch = zeros(inflate_scratch());
        ZlibReader<RandomPieces> reader(source, room_in(scratch));
        Bytes read;
        for (;;) {
            Bytes piece(random.below(random.below(2) == 0 ? 4 : 9000) + 1);
            const Result<std::ptrdiff_t> done = reader.read(room_in(piece));
            ASSERT_TRUE(done.ok()) << describe(done.status());
            piece.resize(static_cast<std::size_t>(*done));
            append(read, piece);
            if (piece.empty()) break;
        }
        ASSERT_EQ(read, data);
    }
}

/// What zlib says: the whole file is one right stream, or not.
bool zlib_accepts(const Bytes& file, Bytes& data) {
    z_stream stream{};
    inflateInit(&stream);
    stream.next_in = const_cast<Bytef*>(file.data());
    stream.avail_in = static_cast<uInt>(file.size());
    stream.next_out = data.data();
    stream.avail_out = static_cast<uInt>(data.size());
    const bool ended = inflate(&stream, Z_FINISH) == Z_STREAM_END && stream.avail_in == 0;
    data.resize(stream.total_out);
    inflateEnd(&stream);
    return ended;
}

TEST(InflateZlib, AcceptsOfDamagedDataExactlyWhatZlibAccepts) {
    // The checksum would refuse nearly all of them; it is made right again, so that the codes decide.
    Random random(3);
    int accepted = 0;
    for (int round = 0; round < 10000; ++round) {
        const Bytes data = mixed_data(random, 40 + random.below(400));
        Bytes file = deflated(data, 9, round % 2 == 0 ? Z_DEFAULT_STRATEGY : Z_FIXED, 15);
        for (std::uint32_t changes = random.below(3); changes > 0; --changes)
            file[2 + random.below(static_cast<std::uint32_t>(file.size()) - 6)] ^=
                static_cast<std::uint8_t>(1 << random.below(8));
        const Inflated raw = inflate_raw(Bytes(file.begin() + 2, file.end()));
        Adler32 sum;
        sum.add(view_of(raw.data));
        file.resize(file.size() - 4);
        append_big(file, sum.value(), 4);

        Bytes expected(100000);
        const bool right = zlib_accepts(file, expected);
        const Inflated read = inflate_whole(file);
        ASSERT_EQ(read.status == Status::ok, right) << "round " << round;
        if (!right) continue;
        ASSERT_EQ(read.data, expected);
        ++accepted;
    }
    EXPECT_GT(accepted, 3500);
    EXPECT_LT(accepted, 8500);
}

TEST(InflateZlib, EveryTruncationIsTruncatedAndEveryChangedByteIsSeen) {
    Random random(4);
    const Bytes data = mixed_data(random, 600);
    const Bytes file = deflated(data, 9, Z_DEFAULT_STRATEGY, 15);
    for (std::size_t length = 0; length < file.size(); ++length)
        ASSERT_EQ(inflate_whole(first_bytes(file, length)).status, Status::truncated) << length;
    for (std::size_t at = 0; at < file.size(); ++at)
        for (int bit = 0; bit < 8; ++bit) {
            Bytes changed = file;
            changed[at] ^= static_cast<std::uint8_t>(1 << bit);
            const Inflated read = inflate_whole(changed);
            // The level in the header's second byte means nothing.
            ASSERT_TRUE(read.status != Status::ok || read.data == data) << at;
        }
}

#endif

}  // namespace
}  // namespace fovea::test
