// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <gauge/labels.hpp>

namespace fovea::test {
namespace {

using apps::Labels;
using apps::Picture;
using apps::wrapped;

constexpr Rgb888 red{255, 0, 0};
constexpr Rgb888 paper{0, 0, 40};

Picture<Rgb888> grey(Size size) {
    Picture<Rgb888> picture(size);
    std::fill(picture.pixels.begin(), picture.pixels.end(), Rgb888{90, 90, 90});
    return picture;
}
Size size_of(const std::string& text, int scale = 1) { return label_size(apps::span_of(text), scale); }
bool overlap(const Rectangle& a, const Rectangle& b) {
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}
bool inside(const Rectangle& box, Size size) {
    return box.x >= 0 && box.y >= 0 && box.x + box.width <= size.width && box.y + box.height <= size.height;
}

TEST(Wrapped, BreaksAtSpacesOnly) {
    EXPECT_EQ(wrapped("", 10), "");
    EXPECT_EQ(wrapped("one two three", 13), "one two three");
    EXPECT_EQ(wrapped("one two three", 12), "one two\nthree");
    EXPECT_EQ(wrapped("one two three", 7), "one two\nthree");
    EXPECT_EQ(wrapped("one two three", 6), "one\ntwo\nthree");
    EXPECT_EQ(wrapped("unbreakable a b", 3), "unbreakable\na b");
}

TEST(Labels, StandWhereThereIsRoom) {
    const Picture<Rgb888> picture = grey({300, 200});
    Labels labels(picture, 1, paper);
    const Size size = size_of("part 0");
    // Above a corner, and right of a point.
    EXPECT_EQ(labels.put_above({50, 60}, {{"part 0", red}}),
              (Rectangle{50, 60 - size.height, size.width, size.height}));
    const Rectangle beside = labels.put_beside({150, 100}, {"part 0", red});
    EXPECT_GT(beside.x, 150);
    EXPECT_LT(beside.x, 160);
    EXPECT_TRUE(beside.y < 100 && beside.y + beside.height > 100);
}

TEST(Labels, StackTheLinesOfATitle) {
    const Picture<Rgb888> picture = grey({300, 200});
    Labels labels(picture, 1, paper);
    const Rectangle box = labels.put_above({50, 60}, {{"part 0 OK", red}, {"n 2", red}});
    EXPECT_EQ(box.height, 2 * size_of("n 2").height + 1);
    EXPECT_EQ(box.y + box.height, 60);
    EXPECT_EQ(box.width, size_of("part 0 OK").width);
}

TEST(Labels, StayInsideThePicture) {
    const Size size{120, 60};
    const Picture<Rgb888> picture = grey(size);
    for (const Point point :
         {Point{0, 0}, Point{119, 0}, Point{0, 59}, Point{119, 59}, Point{-5000, 30}, Point{60, 1 << 29}}) {
        Labels labels(picture, 1, paper);
        const Rectangle above = labels.put_above(point, {{"length", red}});
        EXPECT_TRUE(!above.empty() && inside(above, size)) << point.x << ' ' << point.y;
        const Rectangle beside = labels.put_beside(point, {"length", red});
        EXPECT_TRUE(!beside.empty() && inside(beside, size)) << point.x << ' ' << point.y;
    }
}

TEST(Labels, NeverLieOverEachOtherWhereverTheyBelong) {
    Random random(1101);
    for (const int scale : {1, 2})
        for (int round = 0; round < 30; ++round) {
            const Size size{random.between(40, 400), random.between(20, 300)};
            const Picture<Rgb888> picture = grey(size);
            Labels labels(picture, scale, paper);
            std::vector<Rectangle> boxes;
            for (int i = 0; i < 40; ++i) {
                const Point point{random.between(-20, size.width + 20),
                                  random.between(-20, size.height + 20)};
                const std::string text(static_cast<std::size_t>(random.between(1, 20)), 'x');
                const Rectangle box = random.below(3) == 0 ? labels.put_above(point, {{text, red}})
                                                           : labels.put_beside(point, {text, red});
                if (box.empty()) continue;
                EXPECT_TRUE(inside(box, size));
                for (const Rectangle& other : boxes) EXPECT_FALSE(overlap(box, other));
                boxes.push_back(box);
            }
            Picture<Rgb888> drawn = picture;
            labels.draw(drawn);
            EXPECT_EQ(boxes.empty(), drawn.pixels == picture.pixels);
        }
}

TEST(Labels, ShowTwelveAtOnePointWithoutCoveringOne) {
    const Picture<Rgb888> picture = grey({400, 300});
    Labels labels(picture, 1, paper);
    for (int i = 0; i < 12; ++i)
        EXPECT_FALSE(labels.put_beside({200, 150}, {"feature 12.345 mm", red}).empty()) << i;
}

TEST(Labels, KeepOffTheLinesOfTheDrawingWhereTheyCan) {
    Picture<Rgb888> picture = grey({300, 200});
    for (int y = 80; y < 120; ++y)
        for (int x = 150; x < 300; ++x) picture.view()(x, y) = red;
    Labels labels(picture, 1, paper);
    const Rectangle box = labels.put_beside({150, 100}, {"length", red});
    EXPECT_FALSE(overlap(box, {150, 80, 150, 40}));
    // Where all is drawn on, they lie on it.
    Picture<Rgb888> full = grey({100, 50});
    std::fill(full.pixels.begin(), full.pixels.end(), red);
    EXPECT_FALSE(Labels(full, 1, paper).put_beside({50, 25}, {"length", red}).empty());
}

TEST(Labels, AreTiedToTheirPointWhenTheyAreFarFromIt) {
    Picture<Rgb888> picture = grey({300, 200});
    Labels labels(picture, 1, paper);
    // A title lies on the point and around it.
    labels.put_above({100, 130}, {{"aaaaaaaaaaaaaaa\na\na\na\na", red}});
    const Rectangle box = labels.put_beside({145, 110}, {"length", Rgb888{0, 255, 0}});
    const Picture<Rgb888> before = picture;
    labels.draw(picture);
    bool tied = false;
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 300; ++x)
            if (!overlap(box, {x, y, 1, 1}) && picture.view()(x, y) == Rgb888{0, 255, 0}) tied = true;
    EXPECT_TRUE(tied);
}

TEST(Labels, AreNotShownWithoutRoom) {
    const Picture<Rgb888> picture = grey({40, 12});
    Labels labels(picture, 1, paper);
    EXPECT_FALSE(labels.put_above({0, 12}, {{"aaaaaaaaaaaaaaaaaaa", red}}).empty());
    EXPECT_TRUE(labels.put_above({0, 12}, {{"b", red}}).empty());
    EXPECT_TRUE(labels.put_beside({0, 12}, {"b", red}).empty());
    EXPECT_TRUE(Labels(grey({200, 100}), 1, paper).put_above({50, 50}, {}).empty());
}

}  // namespace
}  // namespace fovea::test
