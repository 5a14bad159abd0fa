// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/morphology/morphology.hpp>
#include <fovea/morphology/shaped_morphology.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

using Operator = Status (*)(ImageView<const Gray8>, const StructuringElement&, Span<std::uint8_t>,
                            ImageView<Gray8>);
using Scratch = std::int64_t (*)(Size, const StructuringElement&);

void run(Operator op, Scratch needed, const GuardedImage<Gray8>& src, const StructuringElement& element,
         GuardedImage<Gray8>& dst) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(needed(src.view().size(), element)));
    ASSERT_EQ(
        op(src.view(), element, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, dst.view()),
        Status::ok);
}

StructuringElement random_element(Random& random) {
    const int width = 2 * random.between(0, 15) + 1;
    const int height = 2 * random.between(0, 15) + 1;
    std::string text;
    const int density = random.between(10, 95);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) text += random.between(0, 99) < density ? '#' : '.';
        if (y + 1 < height) text += '\n';
    }
    text[static_cast<std::size_t>(random.between(0, width - 1))] = '#';
    return StructuringElement::from_text(text.c_str());
}

int naive(const GuardedImage<Gray8>& src, const StructuringElement& element, int x, int y, bool lowest) {
    int extreme = lowest ? 255 : 0;
    const Size size = element.size();
    for (int j = 0; j < size.height; ++j)
        for (int i = 0; i < size.width; ++i) {
            if (!element.contains(i, j)) continue;
            const int dx = i - size.width / 2, dy = j - size.height / 2;
            const Point p = lowest ? Point{x + dx, y + dy} : Point{x - dx, y - dy};
            if (!src.view().contains(p)) continue;
            extreme = lowest ? std::min<int>(extreme, src(p.x, p.y)) : std::max<int>(extreme, src(p.x, p.y));
        }
    return extreme;
}

TEST(StructuringElement, MakersDrawTheirShapes) {
    const auto text = [](const StructuringElement& element) {
        std::string rows;
        for (int y = 0; y < element.size().height; ++y) {
            for (int x = 0; x < element.size().width; ++x) rows += element.contains(x, y) ? '#' : '.';
            rows += '\n';
        }
        return rows;
    };
    EXPECT_EQ(text(StructuringElement::cross({5, 3})), "..#..\n#####\n..#..\n");
    EXPECT_EQ(text(StructuringElement::disc(3)), "###\n###\n###\n");
    EXPECT_EQ(text(StructuringElement::disc(5)), ".###.\n#####\n#####\n#####\n.###.\n");
    EXPECT_EQ(text(StructuringElement::rectangle({3, 1})), "###\n");
    EXPECT_EQ(text(StructuringElement::line({3, 1})), "##.....\n..###..\n.....##\n");
    EXPECT_EQ(text(StructuringElement::line({0, -1})), "#\n#\n#\n");
    EXPECT_EQ(text(StructuringElement::line({0, 0})), "#\n");
    EXPECT_EQ(text(StructuringElement::from_text("#..\n.#.\n.#.")), "#..\n.#.\n.#.\n");
    EXPECT_EQ(text(StructuringElement::from_text("#..\n.#.\n.#.").reflected()), ".#.\n.#.\n..#\n");
    static_assert(StructuringElement::disc(31).count() == 749, "made by the compiler");
}

TEST(StructuringElement, WhatDoesNotFitIsEmpty) {
    for (const StructuringElement& element :
         {StructuringElement::rectangle({2, 3}), StructuringElement::cross({33, 3}),
          StructuringElement::disc(0), StructuringElement::disc(-3), StructuringElement::line({16, 0}),
          StructuringElement::line({0, -2000000000}), StructuringElement::from_text(""),
          StructuringElement::from_text("##"), StructuringElement::from_text("###\n##\n###"),
          StructuringElement::from_text("#x#"), StructuringElement::from_text("..."),
          StructuringElement::from_text("#\n#\n#\n")})
        EXPECT_TRUE(element.empty());
}

TEST(ShapedErode, LeavesTheMiddleOfAPlus) {
    GuardedImage<Gray8> src({7, 7}), dst({7, 7});
    src.fill(Gray8{0});
    for (int i = 2; i <= 4; ++i) src(3, i) = src(i, 3) = 255;
    run(erode, erode_scratch, src, StructuringElement::cross({3, 3}), dst);
    for (int y = 0; y < 7; ++y)
        for (int x = 0; x < 7; ++x) EXPECT_EQ(dst(x, y), x == 3 && y == 3 ? 255 : 0);
    run(dilate, dilate_scratch, dst, StructuringElement::cross({3, 3}), src);
    EXPECT_EQ(src(3, 2), 255);
    EXPECT_EQ(src(2, 2), 0);
}

TEST(ShapedMorphology, EqualsTheReferenceOnEverySizeAndManyElements) {
    Random random(15);
    for (const Size size : test_sizes())
        for (int round = 0; round < 6; ++round) {
            const StructuringElement element = round == 0   ? StructuringElement::disc(31)
                                               : round == 1 ? StructuringElement::cross({3, 3})
                                                            : random_element(random);
            GuardedImage<Gray8> src(size), low(size), high(size);
            src.fill(random);
            run(erode, erode_scratch, src, element, low);
            run(dilate, dilate_scratch, src, element, high);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x<size.width; x += size.width> 200 ? 7 : 1) {
                    ASSERT_EQ(low(x, y), naive(src, element, x, y, true)) << size.width << "x" << size.height;
                    ASSERT_EQ(high(x, y), naive(src, element, x, y, false))
                        << size.width << "x" << size.height;
                }
        }
}

TEST(ShapedMorphology, ARectangleGivesWhatTheRectangleOperatorsGive) {
    Random random(16);
    const Size size{83, 29};
    GuardedImage<Gray8> src(size), a(size), b(size);
    src.fill(random);
    for (const Size element : {Size{3, 3}, Size{7, 5}, Size{31, 31}, Size{1, 9}}) {
        std::vector<std::uint8_t> scratch(static_cast<std::size_t>(opening_scratch(size)));
        const Span<std::uint8_t> bytes{scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())};
        ASSERT_EQ(opening(src.view(), element, bytes, a.view()), Status::ok);
        run(opening, opening_scratch, src, StructuringElement::rectangle(element), b);
        EXPECT_TRUE(equal(a.view(), b.view()));
        ASSERT_EQ(closing(src.view(), element, bytes, a.view()), Status::ok);
        run(closing, closing_scratch, src, StructuringElement::rectangle(element), b);
        EXPECT_TRUE(equal(a.view(), b.view()));
    }
}

TEST(ShapedMorphology, OpeningIsBelowAndClosingAboveTheSourceForAnyShapeAndTwiceIsOnce) {
    Random random(17);
    const Size size{60, 30};
    for (int round = 0; round < 20; ++round) {
        const StructuringElement element = random_element(random);
        GuardedImage<Gray8> src(size), open(size), close(size), twice(size);
        src.fill(random);
        run(opening, opening_scratch, src, element, open);
        run(closing, closing_scratch, src, element, close);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                ASSERT_LE(open(x, y), src(x, y));
                ASSERT_GE(close(x, y), src(x, y));
            }
        run(opening, opening_scratch, open, element, twice);
        EXPECT_TRUE(equal(open.view(), twice.view()));
    }
}

}  // namespace
}  // namespace fovea::test
