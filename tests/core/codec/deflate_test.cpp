// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/codec/deflate.hpp>
#include <fovea/codec/inflate.hpp>

#include "lossless_files.hpp"

#if defined(FOVEA_HAVE_LIBPNG)
#include <zlib.h>
#endif

namespace fovea::test {
namespace {

/// Writes data in pieces of at most `piece` bytes into a file of at most `most` bytes.
Result<std::ptrdiff_t> deflate_into(const Bytes& data, std::ptrdiff_t piece, Bytes& file) {
    // Scratch begins with whatever was there.
    Bytes scratch(static_cast<std::size_t>(deflate_scratch()), 0xa5);
    ZlibWriter writer(room_in(scratch), room_in(file));
    for (std::ptrdiff_t at = 0; at < static_cast<std::ptrdiff_t>(data.size());) {
        const Span<std::uint8_t> room = writer.room();
        EXPECT_GT(room.size(), 0);
        const std::ptrdiff_t run =
            std::min({room.size(), piece, static_cast<std::ptrdiff_t>(data.size()) - at});
        std::copy_n(data.data() + at, run, room.data());
        writer.add(run);
        at += run;
    }
    return writer.finish();
}

Bytes deflated(const Bytes& data, std::ptrdiff_t piece = 1 << 20) {
    Bytes file = zeros(deflated_bytes(static_cast<std::int64_t>(data.size())));
    const Result<std::ptrdiff_t> length = deflate_into(data, piece, file);
    EXPECT_TRUE(length.ok());
    file.resize(length ? static_cast<std::size_t>(*length) : 0);
    return file;
}

Bytes inflated(const Bytes& file, std::size_t length) {
    Bytes scratch = zeros(inflate_scratch());
    Bytes data(length);
    const Result<std::ptrdiff_t> read = inflate_zlib(view_of(file), room_in(scratch), room_in(data));
    EXPECT_EQ(read.status(), Status::ok);
    data.resize(read ? static_cast<std::size_t>(*read) : 0);
    return data;
}

Bytes random_bytes(Random& random, std::size_t length, std::uint32_t alphabet) {
    Bytes data(length);
    for (std::uint8_t& byte : data) byte = static_cast<std::uint8_t>(random.below(alphabet));
    return data;
}

TEST(Deflate, WritesNothingAtAllAsOneEmptyBlock) {
    // The header of an 8 KiB window, a last block with the fixed code and its end alone, the sum of nothing.
    EXPECT_EQ(deflated({}), (Bytes{0x58, 0x09, 0x03, 0x00, 0, 0, 0, 1}));
}

TEST(Deflate, WritesASingleByteWithTheFixedCode) {
    // Last, fixed: 1, 1, 0; 'a' is 10010001 of the fixed code; the end is 0000000.
    EXPECT_EQ(deflated(bytes_of("a")), (Bytes{0x58, 0x09, 0x4b, 0x04, 0x00, 0x00, 0x62, 0x00, 0x62}));
}

TEST(Deflate, StoresWhatCannotBeShortened) {
    Random random(1);
    for (const std::size_t length : {100u, 8191u, 8192u, 8193u, 16384u, 50000u}) {
        const Bytes data = random_bytes(random, length, 256);
        const Bytes file = deflated(data);
        EXPECT_LE(static_cast<std::int64_t>(file.size()), deflated_bytes(static_cast<std::int64_t>(length)));
        EXPECT_GE(file.size(), length);
        EXPECT_EQ(inflated(file, length), data);
    }
}

TEST(Deflate, FitsIntoExactlyItsBoundAndSaysWhenItDoesNotFit) {
    Random random(2);
    for (const std::size_t length : {1u, 600u, 8192u, 20000u}) {
        const Bytes data = random_bytes(random, length, 256);
        const Bytes file = deflated(data);
        Bytes exact(file.size());
        ASSERT_TRUE(deflate_into(data, 1000, exact).ok());
        EXPECT_EQ(exact, file);
        for (const std::size_t less : {1u, 4u, 5u, 30u}) {
            Bytes little(file.size() > less ? file.size() - less : 0);
            EXPECT_EQ(deflate_into(data, 1000, little).status(), Status::buffer_too_small);
        }
    }
    for (std::size_t room = 0; room < 9; ++room) {
        Bytes little(room);
        EXPECT_EQ(deflate_into(bytes_of("a"), 1, little).status(), Status::buffer_too_small) << room;
    }
}

TEST(Deflate, IsReadBackWhateverTheData) {
    Random random(3);
    for (int round = 0; round < 200; ++round) {
        Bytes data;
        const std::size_t length = random.below(60000);
        const std::uint32_t alphabet = 1 + random.below(random.below(2) == 0 ? 4 : 256);
        while (data.size() < length) {
            if (data.empty() || random.below(2) == 0) {
                append(data, random_bytes(random, random.below(50), alphabet));
                continue;
            }
            const auto distance =
                1 + random.below(static_cast<std::uint32_t>(std::min<std::size_t>(data.size(), 9000)));
            for (std::uint32_t run = random.below(600); run > 0; --run)
                data.push_back(data[data.size() - distance]);
        }
        const Bytes file = deflated(data, random.between(1, 9000));
        ASSERT_LE(static_cast<std::int64_t>(file.size()),
                  deflated_bytes(static_cast<std::int64_t>(data.size())));
        ASSERT_EQ(inflated(file, data.size()), data) << "round " << round;
#if defined(FOVEA_HAVE_LIBPNG)
        Bytes theirs(data.size() + 1);
        uLongf count = theirs.size();
        ASSERT_EQ(uncompress(theirs.data(), &count, file.data(), file.size()), Z_OK);
        theirs.resize(count);
        ASSERT_EQ(theirs, data);
#endif
    }
}

TEST(Deflate, DoesNotCareHowTheDataAreCut) {
    Random random(4);
    Bytes data = random_bytes(random, 30000, 3);
    const Bytes whole = deflated(data);
    EXPECT_EQ(deflated(data, 1), whole);
    EXPECT_EQ(deflated(data, 777), whole);
}

TEST(Deflate, KeepsCodesWithinFifteenBits) {
    // Frequencies like Fibonacci numbers, in an order without matches, would make a code of 18 bits.
    Bytes data;
    int older = 1;
    int newer = 1;
    for (int symbol = 0; data.size() < 6000; ++symbol) {
        data.insert(data.end(), static_cast<std::size_t>(older), static_cast<std::uint8_t>(symbol));
        newer = std::exchange(older, newer) + newer;
    }
    Random random(5);
    for (std::size_t i = data.size(); i > 1; --i)
        std::swap(data[i - 1], data[random.below(static_cast<std::uint32_t>(i))]);
    EXPECT_EQ(inflated(deflated(data), data.size()), data);
}

TEST(Deflate, MakesLittleOfLongRuns) {
    const Bytes file = deflated(Bytes(1000000, 7));
    EXPECT_EQ(inflated(file, 1000000), Bytes(1000000, 7));
    // 123 blocks of 32 matches: at most 2 bits each, and 20 bytes of codes.
    EXPECT_LT(file.size(), 123u * (32 * 2 / 8 + 20));
}

}  // namespace
}  // namespace fovea::test
