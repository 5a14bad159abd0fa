// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/linux/frame_stream.hpp>

namespace fovea::linux_port {
namespace {

using hal::PixelFormat;

/// What a stream says of bytes that come in pieces: a frame as its bytes, anything else as its status.
std::vector<std::string> heard(const StreamFormat& format, const std::string& bytes, std::ptrdiff_t room,
                               std::size_t piece, bool* between_frames = nullptr) {
    std::vector<std::uint8_t> memory(static_cast<std::size_t>(room));
    FrameStream stream;
    EXPECT_EQ(stream.begin(format, {memory.data(), room}), Status::ok);
    std::vector<std::string> events;
    std::size_t at = 0;
    for (;;) {
        const Status status = stream.look();
        if (status == Status::ok) {
            const auto frame = stream.bytes();
            events.emplace_back(reinterpret_cast<const char*>(frame.data()),
                                static_cast<std::size_t>(frame.size()));
            stream.drop();
        } else if (status != Status::timeout) {
            events.push_back(std::string("? ") + describe(status));
        } else if (at == bytes.size()) {
            break;
        } else {
            const Span<std::uint8_t> into = stream.room();
            if (into.empty()) {
                ADD_FAILURE() << "no room for more";
                break;
            }
            const std::size_t now =
                std::min({piece, bytes.size() - at, static_cast<std::size_t>(into.size())});
            std::copy_n(bytes.data() + at, now, into.data());
            stream.filled(static_cast<std::ptrdiff_t>(now));
            at += now;
        }
    }
    if (between_frames != nullptr) *between_frames = stream.between_frames();
    return events;
}

const std::string small = "P5\n2 2\n255\nabcd";
const std::string colour = "P6 1 2 255\nrgbRGB";
const std::string deep = "P5 1 2 1000\n\1\2\3\1";
const std::string malformed = std::string("? ") + describe(Status::malformed);
const std::string too_small = std::string("? ") + describe(Status::buffer_too_small);

TEST(FrameStream, TellsPicturesApartWhateverTheirPieces) {
    const std::string noted = "P5 # a note\n2 2 # and another\n255\nEFGH";
    const std::string all = small + colour + "\n \r\n" + deep + noted + small;
    for (std::size_t piece = 1; piece <= all.size(); ++piece) {
        bool between_frames = false;
        EXPECT_EQ(heard({}, all, 512, piece, &between_frames),
                  (std::vector<std::string>{small, colour, deep, noted, small}))
            << piece;
        EXPECT_TRUE(between_frames);
    }
}

TEST(FrameStream, FindsTheNextPictureBehindDamageAndTellsOfItOnce) {
    const std::vector<std::string> expected = {small, malformed, colour, small};
    for (const std::string damage :
         {"x", "P5P5P5", "P5 P6 12", "P", "P9", "some words P and P7 more", "P5 2 x 255\n"})
        for (const std::size_t piece : {std::size_t{1}, std::size_t{2}, std::size_t{7}, std::size_t{1000}})
            EXPECT_EQ(heard({}, small + damage + colour + small, 512, piece), expected)
                << damage << " " << piece;
    const std::vector<std::string> text = {std::string("? ") + describe(Status::unsupported), small};
    EXPECT_EQ(heard({}, "P2 2 2 9\n1 2 3 4\n" + small, 512, 3), text);
}

TEST(FrameStream, LooksNoFurtherThanTheLongestHeader) {
    for (const int length : {400, 600, 100000}) {
        const std::string noted =
            "P5 #" + std::string(static_cast<std::size_t>(length), 'x') + "\n2 2 255\nabcd";
        const auto events = heard({}, noted + small, 2000, 100);
        ASSERT_EQ(events.size(), 2u) << length;
        EXPECT_EQ(events[0], length == 400 ? noted : malformed);
        EXPECT_EQ(events[1], small);
    }
}

TEST(FrameStream, PassesOverAPictureThatHasNoRoom) {
    const std::string large = "P5 100 100 255\n" + std::string(10000, 'P');
    for (const std::size_t piece : {std::size_t{1}, std::size_t{13}, std::size_t{5000}})
        EXPECT_EQ(heard({}, small + large + colour, 512, piece),
                  (std::vector<std::string>{small, too_small, colour}));
    const std::string fits = "P5 100 100 255\n" + std::string(10000, 'P');
    EXPECT_EQ(heard({}, small + fits + colour, static_cast<std::ptrdiff_t>(fits.size()), 999),
              (std::vector<std::string>{small, fits, colour}));
}

TEST(FrameStream, CutsRawFramesByTheirSize) {
    const StreamFormat yuyv{PixelFormat::yuyv, {3, 2}, 0};
    EXPECT_EQ(yuyv.frame_bytes(), 16);
    const std::string one = "0123456789abcdef";
    const std::string two = "ghijklmnopqrstuv";
    for (std::size_t piece = 1; piece < 40; ++piece) {
        bool between_frames = true;
        EXPECT_EQ(heard(yuyv, one + two + "x", 16, piece, &between_frames),
                  (std::vector<std::string>{one, two}));
        EXPECT_FALSE(between_frames);
    }
}

TEST(FrameStream, TakesTheLumaOfYuv420) {
    const StreamFormat luma = luma_of_yuv420({3, 3});
    EXPECT_EQ(luma.frame_bytes(), 9);
    EXPECT_EQ(luma.behind, 8);
    for (std::size_t piece = 1; piece < 40; ++piece)
        EXPECT_EQ(heard(luma, "abcdefghiuuuuvvvvABCDEFGHIuuuuvvv", 9, piece),
                  (std::vector<std::string>{"abcdefghi", "ABCDEFGHI"}));
}

TEST(FrameStream, PlacesThePlanesOneBehindTheOther) {
    std::uint8_t memory[9 + 8] = {};
    FrameStream stream;
    ASSERT_EQ(stream.begin({PixelFormat::nv12, {3, 3}, 0}, memory), Status::ok);
    hal::FrameInfo info;
    stream.place(memory, info);
    EXPECT_EQ(info.planes[0].stride_bytes, 3);
    EXPECT_EQ(info.planes[0].bytes.size(), 9);
    EXPECT_EQ(info.planes[1].bytes.data(), memory + 9);
    EXPECT_EQ(info.planes[1].bytes.size(), 8);
    EXPECT_EQ(info.planes[1].stride_bytes, 4);
    EXPECT_EQ(info.size, (Size{3, 3}));
}

TEST(FrameStream, RefusesWhatItCannotCut) {
    std::uint8_t memory[512];
    FrameStream stream;
    EXPECT_EQ(stream.begin({PixelFormat::mjpeg, {8, 8}, 0}, memory), Status::unsupported);
    EXPECT_EQ(stream.begin({PixelFormat::gray8, {0, 8}, 0}, memory), Status::bad_argument);
    EXPECT_EQ(stream.begin({PixelFormat::gray8, {8, 8}, -1}, memory), Status::bad_argument);
    EXPECT_EQ(stream.begin({PixelFormat::gray8, {40000, 1}, 0}, memory), Status::image_too_large);
    EXPECT_EQ(stream.begin({PixelFormat::gray8, {513, 1}, 0}, memory), Status::buffer_too_small);
    EXPECT_EQ(stream.begin({PixelFormat::gray8, {512, 1}, 0}, memory), Status::ok);
    EXPECT_EQ(stream.begin({}, Span<std::uint8_t>(memory).first(511)), Status::buffer_too_small);
}

/// Any bytes at all: the stream comes to its end, and the pieces do not matter.
TEST(FrameStream, SaysTheSameOfRandomBytesWhateverTheirPieces) {
    Random random(88);
    const std::string alphabet = "P56 1290\n#ab";
    for (int round = 0; round < 300; ++round) {
        std::string bytes;
        for (int i = random.between(0, 200); i > 0; --i)
            bytes += random.below(8) == 0 ? small : std::string(1, alphabet[random.below(12)]);
        const auto whole = heard({}, bytes, 512, 10000);
        for (const std::size_t piece : {std::size_t{1}, std::size_t{3}, std::size_t{64}})
            ASSERT_EQ(heard({}, bytes, 512, piece), whole) << bytes;
    }
}

}  // namespace
}  // namespace fovea::linux_port
