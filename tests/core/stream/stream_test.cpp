// SPDX-License-Identifier: MIT
//
// Streams: accumulators, errors and memory. Pipelines drawn by lot are in random_streams_test.cpp.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/filter/box.hpp>
#include <fovea/filter/gaussian.hpp>
#include <fovea/filter/gaussian_sigma.hpp>
#include <fovea/filter/laplacian.hpp>
#include <fovea/filter/median.hpp>
#include <fovea/filter/sobel.hpp>
#include <fovea/image/image_storage.hpp>
#include <fovea/morphology/morphology.hpp>
#include <fovea/morphology/morphology_stages.hpp>
#include <fovea/morphology/shaped_morphology.hpp>
#include <fovea/morphology/structuring_element.hpp>
#include <fovea/morphology/top_hat.hpp>
#include <fovea/pixelwise/colour_stages.hpp>
#include <fovea/pixelwise/point_stages.hpp>
#include <fovea/segment/adaptive_threshold.hpp>
#include <fovea/stream/stream.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

using View = ImageView<const Gray8>;
using Scratch = Span<std::uint8_t>;
using Bytes = std::vector<std::uint8_t>;

Scratch span_of(Bytes& bytes) { return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())}; }
Bytes bytes_of(std::int64_t count) { return Bytes(static_cast<std::size_t>(count), 0xee); }

// ---- Pipelines ----------------------------------------------------------------------------

TEST(Stream, TurnsPackedColourIntoEdgesInOnePass) {
    const Size size{45, 17};
    Random random(4);
    GuardedImage<Yuyv> src(size);
    src.fill(random);
    GuardedImage<Gray8> gray(size), smooth(size), edges(size), expected(size), out(size);
    ASSERT_EQ(to_gray(std::as_const(src).view(), gray.view()), Status::ok);
    Bytes scratch = bytes_of(1 << 16);
    ASSERT_EQ(gaussian_5x5(gray.view(), Border::reflect_101, span_of(scratch), smooth.view()), Status::ok);
    ASSERT_EQ(sobel_magnitude(smooth.view(), Border::reflect_101, span_of(scratch), edges.view()),
              Status::ok);
    ASSERT_EQ(threshold(edges.view(), 40, expected.view()), Status::ok);
    auto program = stream(stages::gray_from_yuyv, stages::gaussian_5x5, stages::sobel_magnitude,
                          stages::threshold{40}, into(out.view()));
    Bytes memory = bytes_of(program.scratch(size.width));
    ASSERT_EQ(program.run(std::as_const(src).view(), Border::reflect_101, span_of(memory)), Status::ok);
    EXPECT_TRUE(equal(out.view(), expected.view()));
}

TEST(Stream, FindsWhatIsNotInTheBackgroundInOnePass) {
    const Size size{45, 17};
    Random random(8);
    GuardedImage<Gray8> background(size), src(size), difference(size), level(size), expected(size), out(size);
    background.fill(random);
    src = background;
    for (int y = 5; y < 12; ++y)
        for (int x = 20; x < 31; ++x) src(x, y) = static_cast<Gray8>(src(x, y) + 100);
    src(3, 3) = static_cast<Gray8>(src(3, 3) + 100);
    Bytes work = bytes_of(1 << 16);
    ASSERT_EQ(absolute_difference(src.view(), background.view(), difference.view()), Status::ok);
    ASSERT_EQ(threshold(difference.view(), 60, level.view()), Status::ok);
    ASSERT_EQ(opening(level.view(), {3, 3}, span_of(work), expected.view()), Status::ok);
    auto program = stream(stages::absolute_difference{background.view()}, stages::threshold{60},
                          stages::opening{{3, 3}}, into(out.view()));
    Bytes memory = bytes_of(program.scratch(size.width));
    ASSERT_EQ(program.run(src.view(), Border::replicate, span_of(memory)), Status::ok);
    EXPECT_TRUE(equal(out.view(), expected.view()));
    EXPECT_EQ(out(25, 8), 255);
    EXPECT_EQ(out(3, 3), 0);
}

TEST(Stream, TakesTheTallestWindows) {
    Random random(9);
    Bytes work = bytes_of(1 << 16);
    for (const Size size : {Size{7, 5}, Size{70, 80}}) {
        GuardedImage<Gray8> image(size), expected(size), out(size);
        image.fill(random);
        const View src = std::as_const(image).view();
        const auto expect = [&](const auto& stage, Status status) {
            ASSERT_EQ(status, Status::ok);
            auto program = stream(stage, into(out.view()));
            Bytes memory = bytes_of(program.scratch(size.width));
            ASSERT_EQ(program.run(src, Border::zero, span_of(memory)), Status::ok);
            EXPECT_TRUE(equal(out.view(), expected.view()));
            const int cut = size.height / 3;
            ASSERT_EQ(program.run_strip(src, Border::zero, 0, cut, span_of(memory)), Status::ok);
            ASSERT_EQ(program.run_strip(src, Border::zero, cut + 1, size.height - 1, span_of(memory)),
                      Status::ok);
            EXPECT_TRUE(equal(out.view(), expected.view()));
        };
        const Size element{63, 63};
        expect(stages::erode{element}, erode(src, element, span_of(work), expected.view()));
        expect(stages::closing{element}, closing(src, element, span_of(work), expected.view()));
        expect(stages::top_hat{element}, top_hat(src, element, span_of(work), expected.view()));
        expect(stages::morphological_gradient{{1, 63}},
               morphological_gradient(src, {1, 63}, span_of(work), expected.view()));
        expect(stages::adaptive_threshold{63, 2},
               adaptive_threshold(src, 63, 2, span_of(work), expected.view()));
        const StructuringElement disc = StructuringElement::disc(31);
        expect(stages::opening_shaped{disc}, opening(src, disc, span_of(work), expected.view()));
    }
}

TEST(Stream, RefusesASecondImageOfAnotherSize) {
    GuardedImage<Gray8> src({16, 4}), out({16, 4}), narrow({15, 4}), high({16, 5});
    src.fill(Gray8{1});
    out.fill(Gray8{77});
    Bytes memory = bytes_of(1 << 14);
    for (const View other : {std::as_const(narrow).view(), std::as_const(high).view(), View()}) {
        auto program = stream(stages::gaussian_3x3, stages::subtract{other}, into(out.view()));
        EXPECT_EQ(program.run(src.view(), Border::replicate, span_of(memory)), Status::size_mismatch);
        EXPECT_EQ(program.push(src.view().row(0)), Status::out_of_range);
        auto mixed = stream(stages::blend{other, 3}, into(out.view()));
        EXPECT_EQ(mixed.start({16, 4}, Border::replicate, span_of(memory)), Status::size_mismatch);
    }
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 16; ++x) EXPECT_EQ(out(x, y), 77);
}

TEST(Stream, EndsInPixelsOfAnotherKind) {
    const Size size{40, 9};
    Random random(5);
    GuardedImage<Gray8> src(size), smooth(size);
    GuardedImage<Gradient16> expected(size), out(size);
    src.fill(random);
    Bytes scratch = bytes_of(1 << 16);
    ASSERT_EQ(gaussian_3x3(src.view(), Border::zero, span_of(scratch), smooth.view()), Status::ok);
    ASSERT_EQ(laplacian_4(smooth.view(), Border::zero, span_of(scratch), expected.view()), Status::ok);
    auto program = stream(stages::gaussian_3x3, stages::laplacian_4, into(out.view()));
    Bytes memory = bytes_of(program.scratch(size.width));
    ASSERT_EQ(program.run(std::as_const(src).view(), Border::zero, span_of(memory)), Status::ok);
    EXPECT_TRUE(equal(out.view(), expected.view()));
}

// ---- Accumulators -------------------------------------------------------------------------

/// Remembers which rows came, in which order.
struct RowNumbers {
    using Input = Gray8;
    std::vector<int> rows;
    std::int64_t sum = 0;
    Size size;

    Status begin(Size of) {
        rows.clear();
        sum = 0;
        size = of;
        return of.width > 100 ? Status::image_too_large : Status::ok;
    }
    void add_row(const Gray8* row, int width, int y) {
        rows.push_back(y);
        for (int x = 0; x < width; ++x) sum += row[x];
    }
};

TEST(Stream, ShowsAnAccumulatorEveryRowOnceFromTopToBottom) {
    GuardedImage<Gray8> src({10, 6});
    src.fill(Gray8{3});
    auto program = stream(stages::gaussian_5x5, RowNumbers());
    Bytes memory = bytes_of(program.scratch(10));
    ASSERT_EQ(program.run(src.view(), Border::replicate, span_of(memory)), Status::ok);
    EXPECT_EQ(program.accumulator().rows, (std::vector<int>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(program.accumulator().sum, 180);
    EXPECT_EQ(program.accumulator().size, (Size{10, 6}));
    ASSERT_EQ(program.run_strip(src.view(), Border::replicate, 2, 3, span_of(memory)), Status::ok);
    EXPECT_EQ(program.accumulator().rows, (std::vector<int>{2, 3}));
    RowNumbers elsewhere;
    auto other = stream(tap(elsewhere), stages::gaussian_5x5, RowNumbers());
    ASSERT_EQ(other.run_strip(src.view(), Border::replicate, 2, 3, span_of(memory)), Status::ok);
    EXPECT_EQ(elsewhere.rows, (std::vector<int>{2, 3}));
}

TEST(Stream, OfAnAccumulatorAloneTakesTheRowsAsTheyAre) {
    GuardedImage<Gray8> src({3, 4});
    src.fill(Gray8{7});
    auto program = stream(RowNumbers());
    Bytes memory = bytes_of(program.scratch(3));
    ASSERT_EQ(program.run(src.view(), Border::replicate, span_of(memory)), Status::ok);
    EXPECT_EQ(program.accumulator().sum, 84);
}

TEST(Stream, SaysWhatIsWrong) {
    GuardedImage<Gray8> src({16, 4}), out({16, 4}), other({15, 4});
    src.fill(Gray8{1});
    out.fill(Gray8{77});
    auto program = stream(stages::gaussian_5x5, into(out.view()));
    Bytes memory = bytes_of(program.scratch(16));
    const Scratch scratch = span_of(memory);
    EXPECT_EQ(program.push(src.view().row(0)), Status::out_of_range);
    EXPECT_EQ(program.run({}, Border::replicate, scratch), Status::empty_image);
    EXPECT_EQ(program.start({0, 4}, Border::replicate, scratch), Status::empty_image);
    EXPECT_EQ(program.start({16, 40000}, Border::replicate, scratch), Status::image_too_large);
    EXPECT_EQ(program.run(src.view(), Border::replicate, scratch.first(scratch.size() - 1)),
              Status::scratch_too_small);
    EXPECT_EQ(program.push(src.view().row(0)), Status::out_of_range);
    for (const auto& rows : {std::pair<int, int>{-1, 2}, {2, 1}, {0, 4}})
        EXPECT_EQ(program.run_strip(src.view(), Border::replicate, rows.first, rows.second, scratch),
                  Status::out_of_range);
    auto wrong = stream(stages::gaussian_5x5, into(other.view()));
    EXPECT_EQ(wrong.run(src.view(), Border::replicate, scratch), Status::size_mismatch);
    auto refusing = stream(stages::gaussian_3x3, RowNumbers());
    Bytes large = bytes_of(refusing.scratch(101));
    EXPECT_EQ(refusing.start({101, 1}, Border::replicate, span_of(large)), Status::image_too_large);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 16; ++x) EXPECT_EQ(out(x, y), 77);
}

/// Whatever the stages before it do, it may be reached only by valid ones.
template <class Stage>
void expect_refused(const Stage& stage) {
    GuardedImage<Gray8> src({16, 4}), out({16, 4});
    src.fill(Gray8{1});
    out.fill(Gray8{77});
    auto program = stream(stages::gaussian_5x5, stage, stages::median_3x3, into(out.view()));
    Bytes memory = bytes_of(1 << 16);
    EXPECT_EQ(program.run(src.view(), Border::replicate, span_of(memory)), Status::bad_argument);
    EXPECT_EQ(program.start({16, 4}, Border::zero, span_of(memory)), Status::bad_argument);
    EXPECT_EQ(memory, bytes_of(1 << 16));
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 16; ++x) EXPECT_EQ(out(x, y), 77);
}

TEST(Stream, RefusesAStageWhoseOperatorWouldRefuseItsParameters) {
    for (const Size element :
         {Size{2, 3}, Size{3, 2}, Size{65, 3}, Size{3, 65}, Size{0, 0}, Size{3, -3}, Size{-3, 3}}) {
        expect_refused(stages::box{element});
        expect_refused(stages::erode{element});
        expect_refused(stages::dilate{element});
        expect_refused(stages::opening{element});
        expect_refused(stages::closing{element});
        expect_refused(stages::morphological_gradient{element});
        expect_refused(stages::top_hat{element});
        expect_refused(stages::black_hat{element});
    }
    expect_refused(stages::erode_shaped(StructuringElement()));
    expect_refused(stages::closing_shaped{StructuringElement::cross({2, 3})});
    expect_refused(stages::threshold_range{3, 2});
    expect_refused(stages::gray_from_luma{static_cast<YuvRange>(2)});
    for (const int weight : {-1, 257}) expect_refused(stages::blend{View(), weight});
    for (const int side : {-1, 0, 2, 65}) expect_refused(stages::adaptive_threshold{side, 0});
    for (const int offset : {-256, 256}) expect_refused(stages::adaptive_threshold_inverse{3, offset});
    for (const int reach : {-1, 32, 1 << 30}) {
        GaussianTaps taps;
        taps.reach = reach;
        expect_refused(stages::gaussian{taps});
    }
}

TEST(Stream, RefusesParametersOfConversionsToo) {
    GuardedImage<Rgb888> colours({5, 2});
    GuardedImage<Gradient16> slopes({5, 2});
    GuardedImage<Gray8> out({5, 2});
    Random random(1);
    colours.fill(random);
    slopes.fill(random);
    Bytes memory = bytes_of(1 << 12);
    const auto answer = [&](const auto& stage, const auto& src) {
        auto program = stream(stage, into(out.view()));
        return program.run(src.view(), Border::replicate, span_of(memory));
    };
    HsvRange crossed;
    crossed.value_low = 1;
    crossed.value_high = 0;
    EXPECT_EQ(answer(stages::hsv_range<Rgb888>{crossed}, colours), Status::bad_argument);
    EXPECT_EQ(answer(stages::extract_plane{static_cast<ColourChannel>(3)}, colours), Status::bad_argument);
    for (const int shift : {-1, 16}) {
        EXPECT_EQ(answer(stages::narrow<Gradient16>{shift}, slopes), Status::bad_argument);
        EXPECT_EQ(answer(stages::narrow_about_128{shift}, slopes), Status::bad_argument);
    }
}

TEST(Stream, KnowsItsScratchWhenItIsCompiled) {
    static ImageStorage<Gray8, 64, 8> out;
    static constexpr std::int64_t bytes =
        Stream(stages::gaussian_5x5, stages::sobel_magnitude, IntoImage<Gray8>(ImageView<Gray8>()))
            .scratch(64);
    auto program = stream(stages::gaussian_5x5, stages::sobel_magnitude, into(out.view()));
    EXPECT_EQ(program.scratch(64), bytes);
    // Two windows of 5 and 3 rows, their lines, zeros and alignment: far less than the frame of a camera.
    EXPECT_LT(bytes, 64 * 48);
}

}  // namespace
}  // namespace fovea::test
