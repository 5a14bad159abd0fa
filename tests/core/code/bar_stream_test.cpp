// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <fovea/code/bar_stream.hpp>
#include <support/bars.hpp>

namespace fovea::test {
namespace {

struct StreamAnswer {
    Status status = Status::ok;
    std::string text;
    List<Code, 4> codes;
};
StreamAnswer stream(const BarPicture& picture, const BarStreamOptions& options = {}) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(bar_stream_scratch(picture.size.width)));
    BarStream bars(picture.size.width, options,
                   {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())});
    for (int y = 0; y < picture.size.height; ++y) {
        EXPECT_EQ(bars.take({picture.view().row(y), picture.size.width}), Status::ok);
    }
    std::uint8_t room[200];
    CodeText text{Span<std::uint8_t>(room)};
    StreamAnswer answer;
    answer.status = bars.finish(text, answer.codes);
    answer.text.assign(room, room + text.size());
    return answer;
}

TEST(BarStream, ReadsEverySymbologyFromRows) {
    Random random(3191);
    for (const BarSample& sample : bar_samples) {
        BarPicture picture({640, 120});
        BarScene scene;
        scene.degrees = 4;
        scene.height = 90;
        scene.module = 2;
        draw_bars(picture, bars_of(sample.symbology, sample.text), scene, random);
        const StreamAnswer answer = stream(picture);
        EXPECT_EQ(answer.status, Status::ok) << sample.text;
        EXPECT_EQ(answer.text, sample.text);
        ASSERT_EQ(answer.codes.size(), 1);
        EXPECT_EQ(answer.codes[0].symbology, sample.symbology);
        EXPECT_GE(answer.codes[0].agreeing_lines, 20);
    }
}

TEST(BarStream, ReadsUpsideDownAndLightOnDark) {
    Random random(3192);
    BarPicture picture({400, 200});
    BarScene scene;
    scene.degrees = 180;
    scene.y = -50;
    draw_bars(picture, bars_of(Symbology::ean_13, "9780905705712"), scene, random);
    scene.degrees = 0;
    scene.y = 50;
    scene.dark = 200;
    scene.light = 40;
    draw_bars(picture, bars_of(Symbology::ean_8, "55123457"), scene, random);
    const StreamAnswer answer = stream(picture);
    EXPECT_EQ(answer.text, "978090570571255123457");
    ASSERT_EQ(answer.codes.size(), 2);
    EXPECT_GT(answer.codes[0].corners[0].x, answer.codes[0].corners[1].x);
    EXPECT_GT(answer.codes[0].corners[0].y, answer.codes[0].corners[3].y);
    EXPECT_FALSE(answer.codes[0].inverted);
    EXPECT_TRUE(answer.codes[1].inverted);
}

TEST(BarStream, RowsMayArriveInItsIdleScratch) {
    Random random(3195);
    BarPicture picture({420, 60});
    draw_bars(picture, bars_of(Symbology::ean_13, "9780905705712"), {}, random);
    const StreamAnswer wanted = stream(picture);
    ASSERT_EQ(wanted.text, "9780905705712");
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(bar_stream_scratch(420)));
    const Span<std::uint8_t> span(scratch.data(), static_cast<std::ptrdiff_t>(scratch.size()));
    BarStream bars(420, {}, span);
    const Span<std::uint8_t> idle = bars.idle_scratch();
    ASSERT_EQ(idle.size(), 8 * 420);
    EXPECT_GE(idle.begin(), span.begin());
    EXPECT_LE(idle.end(), span.end());
    for (int y = 0; y < 60; ++y) {
        for (int x = 0; x < 8 * 420; ++x) idle[x] = static_cast<std::uint8_t>(x + y);
        // At its end and at its beginning.
        const std::ptrdiff_t first = y % 4 == 0 ? 7 * 420 : 0;
        for (int x = 0; x < 420; ++x) idle[first + x] = picture.view()(x, y);
        EXPECT_EQ(bars.take(idle.from(first).first(420)), Status::ok);
    }
    for (std::uint8_t& byte : idle) byte = 7;
    std::uint8_t room[20];
    CodeText text{Span<std::uint8_t>(room)};
    List<Code, 4> codes;
    EXPECT_EQ(bars.finish(text, codes), Status::ok);
    EXPECT_EQ(std::string(room, room + text.size()), wanted.text);
    ASSERT_EQ(codes.size(), 1);
    EXPECT_EQ(codes[0].agreeing_lines, wanted.codes[0].agreeing_lines);
    EXPECT_TRUE(BarStream(0, {}, span).idle_scratch().empty());
}

TEST(BarStream, FitsAChipAtVga) { static_assert(bar_stream_scratch(640) < 16 * 1024, "16 KiB at VGA"); }

TEST(BarStream, FlatRowsHaveNothing) { EXPECT_EQ(stream(BarPicture({100, 10})).status, Status::not_found); }

TEST(BarStream, ASingleLineIsUndecided) {
    Random random(3193);
    BarPicture picture({400, 3});
    BarScene scene;
    scene.height = 1;
    draw_bars(picture, bars_of(Symbology::ean_13, "9780905705712"), scene, random);
    BarStreamOptions options;
    options.row_step = 1;
    EXPECT_EQ(stream(picture, options).status, Status::undecided);
}

TEST(BarStream, ChecksItsArguments) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(bar_stream_scratch(100)));
    const Span<std::uint8_t> span(scratch.data(), static_cast<std::ptrdiff_t>(scratch.size()));
    const std::vector<Gray8> row(100);
    const auto first = [&](int width, const BarStreamOptions& options, Span<std::uint8_t> bytes) {
        BarStream bars(width, options, bytes);
        std::uint8_t room[8];
        CodeText text{Span<std::uint8_t>(room)};
        List<Code, 1> codes;
        const Status status = bars.take({row.data(), 100});
        if (status != Status::ok && status != Status::size_mismatch) {
            EXPECT_EQ(bars.finish(text, codes), status);
        }
        return status;
    };
    EXPECT_EQ(first(100, {}, span), Status::ok);
    EXPECT_EQ(first(99, {}, span), Status::size_mismatch);
    EXPECT_EQ(first(0, {}, span), Status::empty_image);
    EXPECT_EQ(first(max_image_side + 1, {}, span), Status::image_too_large);
    EXPECT_EQ(first(100, {}, span.first(span.size() - 1)), Status::scratch_too_small);
    BarStreamOptions options;
    options.row_step = 0;
    EXPECT_EQ(first(100, options, span), Status::bad_argument);
    options = {};
    options.agreeing_lines = 13;
    EXPECT_EQ(first(100, options, span), Status::bad_argument);
    options = {};
    options.rules.interleaved_longest = 7;
    EXPECT_EQ(first(100, options, span), Status::bad_argument);
}

TEST(BarStream, LeavesTextAndListWhereThereIsNoRoom) {
    Random random(3194);
    BarPicture picture({400, 60});
    draw_bars(picture, bars_of(Symbology::ean_13, "9780905705712"), {}, random);
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(bar_stream_scratch(400)));
    BarStream bars(400, {}, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())});
    for (int y = 0; y < 60; ++y) EXPECT_EQ(bars.take({picture.view().row(y), 400}), Status::ok);
    std::uint8_t room[12];
    CodeText text{Span<std::uint8_t>(room)};
    List<Code, 1> codes;
    EXPECT_EQ(bars.finish(text, codes), Status::buffer_too_small);
    EXPECT_EQ(text.size() + codes.size(), 0);
}

}  // namespace
}  // namespace fovea::test
