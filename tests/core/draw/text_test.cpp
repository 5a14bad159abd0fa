// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include <core/draw/draw_reference.hpp>
#include <fovea/base/random.hpp>
#include <fovea/draw/text.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

Span<const char> span_of(const std::string& text) {
    return {text.data(), static_cast<std::ptrdiff_t>(text.size())};
}

GuardedImage<Gray8> written(Size size, Point top_left, const std::string& text, int scale = 1) {
    GuardedImage<Gray8> image = black(size);
    EXPECT_EQ(draw_text(image.view(), top_left, span_of(text), 255, scale), Status::ok);
    return image;
}

/// Asks every pixel which pixel of which glyph it lies on. Each element of a line is a code point.
GuardedImage<Gray8> naive_text(Size size, Point top_left,
                               const std::vector<std::vector<std::uint32_t>>& lines, int scale) {
    return naive_shape(size, [&](int x, int y) {
        const std::int64_t right = std::int64_t{x} - top_left.x;
        const std::int64_t down = std::int64_t{y} - top_left.y;
        if (right < 0 || down < 0) return false;
        const std::int64_t column = right / (6 * scale);
        const std::int64_t line = down / (10 * scale);
        if (line >= static_cast<std::int64_t>(lines.size())) return false;
        const auto& characters = lines[static_cast<std::size_t>(line)];
        if (column >= static_cast<std::int64_t>(characters.size())) return false;
        const int glyph_x = static_cast<int>(right % (6 * scale) / scale);
        const int glyph_y = static_cast<int>(down % (10 * scale) / scale);
        if (glyph_x >= glyph_width || glyph_y >= glyph_height) return false;
        const int glyph = glyph_of(characters[static_cast<std::size_t>(column)]);
        return (glyph_row(glyph, glyph_y) >> (4 - glyph_x) & 1) != 0;
    });
}

TEST(DrawText, WritesHi) {
    GuardedImage<Gray8> image = written({12, 9}, {1, 1}, "Hi");
    EXPECT_EQ(picture(image),
              (Picture{"............", ".#...#...#..", ".#...#......", ".#...#..##..", ".#####...#..",
                       ".#...#...#..", ".#...#...#..", ".#...#..###.", "............"}));
}

TEST(DrawText, MagnifiesByWholePixels) {
    GuardedImage<Gray8> image = written({6, 9}, {0, 0}, "-", 2);
    EXPECT_EQ(picture(image), (Picture{"......", "......", "......", "......", "......", "......", "######",
                                       "######", "......"}));
    GuardedImage<Gray8> once = written({30, 20}, {0, 0}, "5g", 1);
    for (int scale = 2; scale <= max_text_scale; ++scale) {
        GuardedImage<Gray8> large = written({30 * scale, 20 * scale}, {0, 0}, "5g", scale);
        for (int y = 0; y < 20 * scale; ++y)
            for (int x = 0; x < 30 * scale; ++x) ASSERT_EQ(large(x, y), once(x / scale, y / scale));
    }
}

TEST(DrawText, BeginsANewLine) {
    GuardedImage<Gray8> image = written({20, 40}, {2, 1}, "a\n\nbc\n");
    EXPECT_TRUE(equal(image.view(), naive_text({20, 40}, {2, 1}, {{'a'}, {}, {'b', 'c'}, {}}, 1).view()));
}

TEST(DrawText, ShowsTheSignsOfMeasuring) {
    GuardedImage<Gray8> image = written({60, 12}, {0, 0}, "\u00b0\u00b1\u00b2\u00b3\u00b5\u03bc\u2300\u00d8");
    EXPECT_TRUE(equal(
        image.view(),
        naive_text({60, 12}, {0, 0}, {{0xb0, 0xb1, 0xb2, 0xb3, 0xb5, 0xb5, 0x2300, 0x2300}}, 1).view()));
}

TEST(DrawText, ShowsAReplacementForWhatItCannotWrite) {
    // An umlaut and a face the font lacks, a tab, a byte that never stands in UTF-8, a character cut short.
    GuardedImage<Gray8> image = written({60, 12}, {0, 0},
                                        "\u00e4\U0001f600\t\xff"
                                        "A\xe2\x8c");
    EXPECT_TRUE(equal(image.view(), naive_text({60, 12}, {0, 0}, {{1, 1, 1, 1, 'A', 1}}, 1).view()));
    EXPECT_EQ(picture(image)[0].substr(0, 6), "#####.");
}

TEST(DrawText, EndsAtAZeroByte) {
    GuardedImage<Gray8> literal = black({20, 10});
    ASSERT_EQ(draw_text<Gray8>(literal.view(), {0, 0}, "ab", 255), Status::ok);
    EXPECT_TRUE(equal(literal.view(), written({20, 10}, {0, 0}, "ab").view()));
    char buffer[8] = {'a', 'b', '\0', 'c'};
    GuardedImage<Gray8> buffered = black({20, 10});
    ASSERT_EQ(draw_text<Gray8>(buffered.view(), {0, 0}, Span<char>(buffer), 255), Status::ok);
    EXPECT_TRUE(equal(literal.view(), buffered.view()));
}

TEST(DrawText, EqualsTheReferenceInsideAndClipped) {
    Random random(171);
    for (const Size size : drawing_sizes())
        for (const int reach : {0, 20, 100, (1 << 30) - 64})
            for (int round = 0; round < 120; ++round) {
                const Point corner = random_point(random, size, reach);
                const int scale = random.between(1, max_text_scale);
                std::string text;
                std::vector<std::vector<std::uint32_t>> lines(1);
                for (std::uint32_t left = random.below(12); left > 0; --left) {
                    const std::uint32_t c = 31 + random.below(96);
                    if (c == 31) {
                        text += '\n';
                        lines.emplace_back();
                    } else {
                        text += static_cast<char>(c);
                        lines.back().push_back(c);
                    }
                }
                GuardedImage<Gray8> image = written(size, corner, text, scale);
                ASSERT_EQ(picture(image), picture(naive_text(size, corner, lines, scale)))
                    << corner.x << "," << corner.y << " scale " << scale << " \"" << text << "\"";
            }
}

TEST(DrawText, LongTextRunsIntoTheImageFromAfar) {
    const std::string text(5000, '-');
    GuardedImage<Gray8> image = written({7, 10}, {-6 * 4000, 0}, text);
    EXPECT_EQ(picture(image)[3], "#####.#");
    GuardedImage<Gray8> down = written({7, 10}, {0, -10 * 3000}, std::string(3000, '\n') + "-");
    EXPECT_EQ(picture(down)[3], "#####..");
}

TEST(DrawText, HoldsAtTheEndsOfInt) {
    const int least = std::numeric_limits<int>::min();
    const int most = std::numeric_limits<int>::max();
    for (const Point corner : {Point{least, 0}, Point{most, 0}, Point{0, least}, Point{most, most}}) {
        GuardedImage<Gray8> image = written({9, 9}, corner, "ABC\nDEF", 8);
        EXPECT_EQ(picture(image), Picture(9, "........."));
        GuardedImage<Gray8> label = black({9, 9});
        EXPECT_EQ(draw_label<Gray8>(label.view(), corner, "ABC\nDEF", 255, 255, 8), Status::ok);
        EXPECT_EQ(picture(label), Picture(9, "........."));
    }
}

TEST(TextSize, IsWhatIsCovered) {
    static_assert(text_size("") == Size{0, 0});
    static_assert(text_size("A") == Size{5, 9});
    static_assert(text_size("AB") == Size{11, 9});
    static_assert(text_size("AB", 3) == Size{33, 27});
    static_assert(text_size("A\nBCD\n") == Size{17, 29});
    static_assert(text_size("\n\n") == Size{0, 0});
    static_assert(text_size("5 \xc2\xb5m") == Size{23, 9});
    static_assert(text_size("A", 0) == Size{0, 0} && text_size("A", 9) == Size{0, 0});
    static_assert(label_size("AB", 3) == Size{33 + 12, 27 + 12});
    static_assert(label_size("") == Size{0, 0} && label_size("A", 9) == Size{0, 0});
}

TEST(TextSize, IsHeldAtTheEndOfInt) {
    const std::string wide(std::size_t{50000000}, 'A');
    EXPECT_EQ(text_size(span_of(wide), 8), (Size{std::numeric_limits<int>::max(), 72}));
    EXPECT_EQ(label_size(span_of(wide), 8).width, std::numeric_limits<int>::max());
}

TEST(TextSize, BoundsWhatDrawTextSets) {
    Random random(172);
    for (int round = 0; round < 300; ++round) {
        std::string text;
        for (std::uint32_t left = random.below(9); left > 0; --left)
            text += random.below(5) == 0 ? '\n' : static_cast<char>(32 + random.below(95));
        const int scale = random.between(1, 3);
        const Size size = text_size(span_of(text), scale);
        GuardedImage<Gray8> image = written({200, 300}, {0, 0}, text, scale);
        for (int y = 0; y < 300; ++y)
            for (int x = 0; x < 200; ++x) {
                if (x < size.width && y < size.height) continue;
                ASSERT_EQ(image(x, y), 0);
            }
    }
}

TEST(DrawLabel, PutsTheTextOnABox) {
    GuardedImage<Gray8> image({20, 20});
    image.fill(Gray8{7});
    ASSERT_EQ(draw_label<Gray8>(image.view(), {3, 4}, "I.", 255, 0), Status::ok);
    const Size box = label_size("I.");
    EXPECT_EQ(box, (Size{15, 13}));
    GuardedImage<Gray8> text = written({20, 20}, {5, 6}, "I.");
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 20; ++x) {
            const bool on_box = x >= 3 && x < 18 && y >= 4 && y < 17;
            EXPECT_EQ(image(x, y), on_box ? text(x, y) : 7) << x << "," << y;
        }
}

TEST(DrawLabel, IsClippedLikeTheRest) {
    GuardedImage<Gray8> whole({60, 40});
    whole.fill(Gray8{7});
    ASSERT_EQ(draw_label<Gray8>(whole.view(), {5, 6}, "gap\n12", 255, 0, 2), Status::ok);
    GuardedImage<Gray8> part({17, 13});
    part.fill(Gray8{7});
    ASSERT_EQ(draw_label<Gray8>(part.view(), {5 - 11, 6 - 9}, "gap\n12", 255, 0, 2), Status::ok);
    const auto same_part = whole.view().crop({11, 9, 17, 13});
    ASSERT_TRUE(same_part.ok());
    EXPECT_TRUE(equal(*same_part, part.view()));
}

TEST(DrawLabel, OfNoCharactersHasNoBox) {
    GuardedImage<Gray8> image = black({9, 9});
    ASSERT_EQ(draw_label<Gray8>(image.view(), {0, 0}, "", 255, 255), Status::ok);
    ASSERT_EQ(draw_label<Gray8>(image.view(), {0, 0}, {}, 255, 255), Status::ok);
    EXPECT_EQ(picture(image), Picture(9, "........."));
}

TEST(DrawLabel, DrawsInColour) {
    GuardedImage<Rgb888> image({9, 13});
    image.fill(Rgb888{0, 0, 0});
    ASSERT_EQ(draw_label<Rgb888>(image.view(), {0, 0}, "I", Rgb888{1, 2, 3}, Rgb888{4, 5, 6}), Status::ok);
    EXPECT_EQ(image(0, 0), (Rgb888{4, 5, 6}));
    EXPECT_EQ(image(4, 4), (Rgb888{1, 2, 3}));
}

TEST(Text, SaysWhatIsWrongAndLeavesTheImage) {
    EXPECT_EQ(draw_text<Gray8>(ImageView<Gray8>(), {0, 0}, "A", 255, 0), Status::empty_image);
    EXPECT_EQ(draw_label<Gray8>(ImageView<Gray8>(), {0, 0}, "A", 255, 1, 0), Status::empty_image);
    GuardedImage<Gray8> image = black({9, 9});
    for (const int scale : {-1, 0, max_text_scale + 1}) {
        EXPECT_EQ(draw_text<Gray8>(image.view(), {0, 0}, "A", 255, scale), Status::bad_argument);
        EXPECT_EQ(draw_label<Gray8>(image.view(), {0, 0}, "A", 255, 1, scale), Status::bad_argument);
    }
    EXPECT_EQ(picture(image), Picture(9, "........."));
}

}  // namespace
}  // namespace fovea::test
